#include "mesh_normals.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "simd8.h"

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

/// Of two edges with this cross product's length and this dot product, not both 0, to 1e-6
/// radians: an odd polynomial in the smaller over the larger (Abramowitz, Stegun 1964, 4.4.49).
Float8 angle_of(Float8 cross, Float8 dot) {
  const Float8 along = abs8(dot);
  const Float8 x = min8(cross, along) / max8(cross, along);
  const Float8 s = x * x;
  Float8 sum = all8(0.0028662257F);
  for (const float c : {-0.0161657367F, 0.0429096138F, -0.0752896400F, 0.1065626393F,
                        -0.1420889944F, 0.1999355085F, -0.3333314528F, 1.0F}) {
    sum = fma8(sum, s, all8(c));
  }
  sum = sum * x;
  constexpr float kPi = std::numbers::pi_v<float>;
  const Float8 acute = select8(less8(along, cross), all8(0.5F * kPi) - sum, sum);
  return select8(less8(dot, all8(0.0F)), all8(kPi) - acute, acute);
}

/// Unit normals of triangles, weighted by the angle at each corner.
struct WeightedNormals {
  float at[3][3][kTreeWidth];  ///< corner, axis
};

/// Gives the triangles, as bits, whose shape is good enough for floats; only these are set.
unsigned weighted_normals(const TriangleBlock& block, WeightedNormals& normals) {
  const Vec8 a = load_vec8(block.a);
  const Vec8 ab = load_vec8(block.b) - a;
  const Vec8 ac = load_vec8(block.c) - a;
  const Vec8 bc = ac - ab;
  const Vec8 area = cross8(ab, ac);
  const Float8 area_squared = dot8(area, area);
  const Float8 ab_squared = dot8(ab, ab);
  const Float8 longest = max8(ab_squared, max8(dot8(ac, ac), dot8(bc, bc)));
  const Float8 longest_squared = longest * longest;
  const Float8 length = sqrt8(area_squared);
  const Float8 at_a = angle_of(length, dot8(ab, ac));
  const Float8 at_b = angle_of(length, all8(0.0F) - dot8(ab, bc));
  const Float8 at_c = all8(std::numbers::pi_v<float>) - at_a - at_b;
  const Float8 unit = all8(1.0F) / length;
  const Float8* const angles[] = {&at_a, &at_b, &at_c};
  for (std::size_t k = 0; k < 3; ++k) {
    const Float8 weight = *angles[k] * unit;
    store8(normals.at[k][0], area.x * weight);
    store8(normals.at[k][1], area.y * weight);
    store8(normals.at[k][2], area.z * weight);
  }
  // Twice the area over the square of the longest edge, and that one's square, metres^4.
  constexpr float kFlattest = 0.02F;
  constexpr float kSmallest = 1e-30F;
  return bits8(and8(less_equal8(all8(kFlattest * kFlattest) * longest_squared, area_squared),
                    less8(all8(kSmallest), longest_squared)));
}

/// The same in doubles, of any triangle.
void weighted_normals(const WeldedMesh& mesh, std::uint32_t triangle, std::uint32_t lane,
                      WeightedNormals& normals) {
  const Corners& corners = mesh.triangles[triangle];
  const Vector3d a = mesh.vertices[corners[0]].cast<double>();
  const Vector3d b = mesh.vertices[corners[1]].cast<double>();
  const Vector3d c = mesh.vertices[corners[2]].cast<double>();
  const Vector3d area = (b - a).cross(c - a);
  const double length = area.norm();
  const Vector3d normal = length > 1e-100 ? Vector3d(area / length) : area.stableNormalized();
  const double at_a = std::atan2(length, (b - a).dot(c - a));
  const double at_b = std::atan2(length, (c - b).dot(a - b));
  const double angles[] = {at_a, at_b, std::max(0.0, std::numbers::pi - at_a - at_b)};
  for (std::size_t k = 0; k < 3; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      normals.at[k][axis][lane] = static_cast<float>(angles[k] * normal[axis]);
    }
  }
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
  shading_vertex_.resize(sets_found);
  for (std::uint32_t corner = 0; corner < 3 * count; ++corner) {
    const std::uint32_t vertex = mesh.triangles[corner / 3][corner % 3];
    shading_vertex_[shading_index_[corner / 3][corner % 3]] = vertex;
  }
  packed_.resize(sets_found);
  vertex_pseudonormals_.resize(mesh.vertices.size());
}

void MeshNormals::update(const WeldedMesh& mesh, const TriangleTree& tree) noexcept {
  std::fill(shading_.begin(), shading_.end(), Vector3f::Zero());
  const std::span<const TriangleBlock> blocks = tree.blocks();
  const std::span<const std::uint32_t> begin = tree.block_begin();
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    WeightedNormals normals;
    const unsigned good = weighted_normals(blocks[i], normals);
    const std::uint32_t count = begin[i + 1] - begin[i];
    for (std::uint32_t lane = 0; lane < count; ++lane) {
      const std::uint32_t t = begin[i] + lane;
      if ((good >> lane & 1U) == 0) weighted_normals(mesh, t, lane, normals);
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& at = normals.at[k];
        shading_[shading_index_[t][k]] += Vector3f(at[0][lane], at[1][lane], at[2][lane]);
      }
    }
  }
  std::fill(vertex_pseudonormals_.begin(), vertex_pseudonormals_.end(), Vector3f::Zero());
  for (std::size_t i = 0; i < shading_.size(); ++i) {
    const Vector3f& sum = shading_[i];
    vertex_pseudonormals_[shading_vertex_[i]] += sum;
    // Where the faces around cancel out any normal is as good.
    packed_[i] = to_octahedral(sum.isZero(0.0F) ? Vector3f::UnitY() : sum);
  }
}

}  // namespace nade::detail
