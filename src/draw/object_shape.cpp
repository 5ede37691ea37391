#include "object_shape.h"

#include <algorithm>
#include <cmath>

namespace nade::draw {
namespace {

using Vec3f = Eigen::Vector3f;

/// How far a dent reaches beyond the edges of the mesh.
constexpr double kFalloff_m = 0.028;
constexpr double kLongestPlateau_m = 0.008;

/// The mean of the faces about each vertex, by area.
void normals_of(std::span<const Vec3f> positions,
                std::span<const std::array<std::uint32_t, 3>> triangles, std::span<Vec3f> normals) {
  std::fill(normals.begin(), normals.end(), Vec3f::Zero());
  for (const auto& [a, b, c] : triangles) {
    const Vec3f area = (positions[b] - positions[a]).cross(positions[c] - positions[a]);
    for (const std::uint32_t corner : {a, b, c}) normals[corner] += area;
  }
  for (Vec3f& normal : normals) {
    const float length = normal.norm();
    normal = length > 0.0F ? Vec3f(normal / length) : Vec3f(Vec3f::UnitY());
  }
}

/// `vector` turned as `from` is turned to become `to`, both unit.
Vec3f turned_along(const Vec3f& vector, const Vec3f& from, const Vec3f& to) {
  const float cosine = from.dot(to);
  if (cosine < -0.9F) return to;
  const Vec3f axis = from.cross(to);
  const Vec3f across = axis.cross(vector);
  return vector + across + axis.cross(across) / (1.0F + cosine);
}

}  // namespace

void ObjectShape::clear() { *this = {}; }

void ObjectShape::add(MeshId id, const DrawnMesh& mesh) {
  Part& part = parts_.emplace_back();
  part.id = id;
  part.base = part.positions = mesh.positions;
  part.sources = mesh.sources;
  part.triangles = mesh.triangles;
  part.rest_normals.resize(mesh.positions.size());
  normals_of(part.base, part.triangles, part.rest_normals);
  part.file_normals = mesh.normals.empty() ? part.rest_normals : mesh.normals;
  part.normals = part.file_normals;
  for (const auto& triangle : part.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3f edge = part.base[triangle[k]] - part.base[triangle[(k + 1) % 3]];
      longest_edge_m_ = std::max(longest_edge_m_, static_cast<double>(edge.norm()));
    }
  }
}

void ObjectShape::follow(const LoadedObject& object) {
  if (!object.animation || object.surface->shape() == shape_) return;
  shape_ = object.surface->shape();
  const std::vector<Vec3f>& vertices = object.soup->vertices;
  for (Part& part : parts_) {
    for (std::size_t i = 0; i < part.sources.size(); ++i) {
      if (part.sources[i] < vertices.size()) part.base[i] = vertices[part.sources[i]];
    }
  }
  moved_ = true;
}

void ObjectShape::press(const Object& object, std::span<const Vec3f> skin) {
  spots_.resize(std::max(spots_.size(), spot_count_ + skin.size()));
  spot_count_ += find_dent_spots(object, skin, std::span(spots_).subspan(spot_count_));
}

void ObjectShape::update(Renderer& renderer, const Placement& placement, double deepest_m) {
  const std::span<DentSpot> spots = std::span(spots_).first(spot_count_);
  spot_count_ = 0;
  const bool dents = !spots.empty();
  if (!moved_ && !dents && !dented_) return;
  for (DentSpot& spot : spots) {
    spot.point = placement.to_local(spot.point);
    spot.normal = placement.pose.rotation.conjugate() * spot.normal;
    spot.depth_m /= placement.scale;
  }
  DentOptions options;
  options.plateau_m = std::min(longest_edge_m_, kLongestPlateau_m / placement.scale);
  options.falloff_m = options.plateau_m + kFalloff_m / placement.scale;
  options.deepest_m = deepest_m / placement.scale;
  for (Part& part : parts_) {
    dent(spots, options, part.base, part.positions);
    show(part, renderer);
  }
  moved_ = false;
  dented_ = dents;
}

void ObjectShape::show(Part& part, Renderer& renderer) {
  normals_of(part.positions, part.triangles, part.normals);
  for (std::size_t i = 0; i < part.normals.size(); ++i) {
    part.normals[i] = turned_along(part.file_normals[i], part.rest_normals[i], part.normals[i]);
  }
  renderer.set_shape(part.id, part.positions, part.normals);
}

}  // namespace nade::draw
