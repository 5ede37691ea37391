#include "stage_skin.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "vertex_normals.h"

namespace nade::draw {

using Vec3f = Eigen::Vector3f;

DrawnMesh plain_hand(const HandMesh& mesh) {
  SkinPoser poser(mesh);
  poser.pose(mesh.bind, 1.0);
  DrawnMesh drawn;
  drawn.positions.assign(poser.positions().begin(), poser.positions().end());
  const std::span<const Vec3f> normals = poser.normals();
  drawn.normals.assign(normals.begin(), normals.end());
  drawn.triangles = mesh.triangles;
  drawn.material.base_color = Color::Ones();
  drawn.material.roughness = 0.5F;
  return drawn;
}

SkinPoser::SkinPoser(const HandMesh& mesh)
    : mesh_(&mesh),
      twin_(mesh.vertices.size()),
      positions_(mesh.vertices),
      normals_(mesh.vertices.size(), Vec3f::UnitY()),
      colors_(mesh.vertices.size(), Color::Ones()),
      hints_(mesh.vertices.size()) {
  std::map<Vec3f, std::uint32_t, ByPlace> first;
  for (std::uint32_t i = 0; i < twin_.size(); ++i) {
    twin_[i] = first.try_emplace(mesh.vertices[i], i).first->second;
  }
}

void SkinPoser::pose(const HandPose& hand, double scale) {
  pose_skin(*mesh_, hand, scale, positions_, {});
  has_normals_ = false;
}

void SkinPoser::flatten(SkinFlattener& flattener, const Object& object, const HandPose& hand,
                        double scale, double give_m) {
  flattener.flatten(object, hand, scale, give_m, positions_, positions_, {});
  has_normals_ = false;
}

std::span<const Vec3f> SkinPoser::normals() {
  if (!has_normals_) compute_normals();
  has_normals_ = true;
  return normals_;
}

void SkinPoser::compute_normals() {
  std::fill(normals_.begin(), normals_.end(), Vec3f::Zero());
  for (const auto& triangle : mesh_->triangles) {
    std::array<Vec3f, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = positions_[triangle[k]];
    const Vec3f cross = (p[1] - p[0]).cross(p[2] - p[0]);
    const float area = cross.norm();
    if (!(area > 0.0F)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const float angle = angle_between(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
      normals_[twin_[triangle[k]]] += angle / area * cross;
    }
  }
  for (std::size_t i = 0; i < normals_.size(); ++i) {
    // A twin comes first, so it is already of unit length.
    const Vec3f sum = normals_[twin_[i]];
    const float length = sum.norm();
    normals_[i] = length > 0.0F ? Vec3f(sum / length) : Vec3f(Vec3f::UnitY());
  }
}

const std::vector<Color>& SkinPoser::penetration_colors(const Object& object) {
  constexpr double kReach = 0.05;
  constexpr double kFull = 0.010;
  const Color deep(0.85F, 0.02F, 0.02F);
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    const auto near = object.closest_point(positions_[i].cast<double>(), kReach, hints_[i]);
    const double depth = near ? -near->signed_distance : 0.0;
    const auto share = static_cast<float>(std::clamp(depth / kFull, 0.0, 1.0));
    colors_[i] = Color::Ones() + share * (deep - Color::Ones());
  }
  return colors_;
}

}  // namespace nade::draw
