#include "mesh_normals.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

// Based on: Baerentzen, Aanaes. Signed Distance Computation Using the Angle Weighted
// Pseudonormal. 2005.

namespace nade::detail {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// Faces that meet at more than this are not shaded into each other: 40 degrees.
constexpr double kCreaseCosine = 0.766044443118978;

/// Corners that share a shading normal.
class CornerSets {
 public:
  explicit CornerSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  std::uint32_t find(std::uint32_t corner) {
    while (parent_[corner] != corner) {
      parent_[corner] = parent_[parent_[corner]];
      corner = parent_[corner];
    }
    return corner;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

std::uint32_t corner_at(const WeldedMesh& mesh, std::uint32_t triangle, std::uint32_t vertex) {
  const Corners& corners = mesh.triangles[triangle];
  const auto k = std::find(corners.begin(), corners.end(), vertex) - corners.begin();
  return 3 * triangle + static_cast<std::uint32_t>(k);
}

/// Of two edges with this cross product's length and this dot product, to 1e-7 radians: an odd
/// polynomial in the smaller over the larger (Abramowitz, Stegun 1964, 4.4.49), a fraction of what
/// the library's arc tangent costs.
double angle_of(double cross, double dot) {
  const double along = std::abs(dot);
  const double larger = std::max(cross, along);
  if (!(larger > 0.0)) return 0.0;
  const double x = std::min(cross, along) / larger;
  const double s = x * x;
  double sum = 0.0028662257;
  for (const double c : {-0.0161657367, 0.0429096138, -0.0752896400, 0.1065626393, -0.1420889944,
                         0.1999355085, -0.3333314528, 1.0}) {
    sum = sum * s + c;
  }
  const double acute = cross > along ? 0.5 * std::numbers::pi - sum * x : sum * x;
  return dot < 0.0 ? std::numbers::pi - acute : acute;
}

}  // namespace

Vector3d face_normal(const WeldedMesh& mesh, std::uint32_t triangle) {
  const Corners& corners = mesh.triangles[triangle];
  const Vector3d a = mesh.vertices[corners[0]].cast<double>();
  const Vector3d b = mesh.vertices[corners[1]].cast<double>();
  const Vector3d c = mesh.vertices[corners[2]].cast<double>();
  return (b - a).cross(c - a);
}

void MeshNormals::build(const WeldedMesh& mesh, const MeshTopology& topology) {
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  std::vector<Vector3f> normals(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    normals[t] = face_normal(mesh, t).normalized().cast<float>();
  }
  on_border_.assign(mesh.vertices.size(), 0);
  CornerSets sets(std::size_t{3} * count);
  for (std::uint32_t t = 0; t < count; ++t) {
    for (std::uint32_t e = 0; e < 3; ++e) {
      const std::uint32_t from = mesh.triangles[t][e];
      const std::uint32_t to = mesh.triangles[t][e == 2 ? 0 : e + 1];
      const std::uint32_t other = topology.neighbours[t][e];
      if (other == kBorder) on_border_[from] = on_border_[to] = 1;
      if (!is_triangle(other) || other < t) continue;
      if (static_cast<double>(normals[t].dot(normals[other])) < kCreaseCosine) continue;
      sets.join(corner_at(mesh, t, from), corner_at(mesh, other, from));
      sets.join(corner_at(mesh, t, to), corner_at(mesh, other, to));
    }
  }
  // A set's lowest corner stands for it, so that it is numbered before the others are met.
  shading_index_.resize(count);
  std::uint32_t sets_found = 0;
  for (std::uint32_t corner = 0; corner < 3 * count; ++corner) {
    const std::uint32_t root = sets.find(corner);
    shading_index_[corner / 3][corner % 3] =
        root == corner ? sets_found++ : shading_index_[root / 3][root % 3];
  }
  shading_.resize(sets_found);
  packed_.resize(sets_found);
  vertex_pseudonormals_.resize(mesh.vertices.size());
}

void MeshNormals::update(const WeldedMesh& mesh) noexcept {
  std::fill(vertex_pseudonormals_.begin(), vertex_pseudonormals_.end(), Vector3f::Zero());
  std::fill(shading_.begin(), shading_.end(), Vector3f::Zero());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Corners& corners = mesh.triangles[t];
    const Vector3d a = mesh.vertices[corners[0]].cast<double>();
    const Vector3d b = mesh.vertices[corners[1]].cast<double>();
    const Vector3d c = mesh.vertices[corners[2]].cast<double>();
    const Vector3d area = (b - a).cross(c - a);
    const double length = area.norm();
    const Vector3d normal = length > 1e-100 ? Vector3d(area / length) : area.stableNormalized();
    const double at_a = angle_of(length, (b - a).dot(c - a));
    const double at_b = angle_of(length, (c - b).dot(a - b));
    const std::array<double, 3> angles{at_a, at_b, std::max(0.0, std::numbers::pi - at_a - at_b)};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3f weighted = (angles[k] * normal).cast<float>();
      vertex_pseudonormals_[corners[k]] += weighted;
      shading_[shading_index_[t][k]] += weighted;
    }
  }
  // Where the faces around cancel out any normal is as good.
  for (std::size_t i = 0; i < shading_.size(); ++i) {
    const Vector3f normal = shading_[i].stableNormalized();
    packed_[i] = to_octahedral(normal.squaredNorm() > 0.5F ? normal : Vector3f::UnitY());
  }
}

}  // namespace nade::detail
