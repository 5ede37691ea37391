#include "draw_list.h"

#include <algorithm>
#include <cmath>

namespace nade::draw {
namespace {

Eigen::Matrix4f matrix_of(const Placement& placement) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = placement.scale * placement.pose.rotation.toRotationMatrix();
  matrix.topRightCorner<3, 1>() = placement.pose.position;
  return matrix.cast<float>();
}

Vec3 center_of(const DrawItem& item) {
  const Eigen::Vector3f center = item.mesh->box.center();
  return item.instance->placement.to_world(center.cast<double>());
}

}  // namespace

void DrawList::gather(const Scene& scene, const MeshStore& meshes, const Camera& camera) {
  solids_.clear();
  ghosts_.clear();
  for (const Instance& instance : scene.instances) {
    const StoredMesh& mesh = meshes.at(instance.mesh);
    if (mesh.index_count == 0) continue;
    std::vector<DrawItem>& list = instance.look == Look::solid ? solids_ : ghosts_;
    list.push_back({&mesh, &instance, matrix_of(instance.placement)});
  }
  solid_corners_.clear();
  for (const DrawItem& item : solids_) {
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector3f corner =
          item.mesh->box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(i));
      const Vec3 world = item.instance->placement.to_world(corner.cast<double>());
      if (world.allFinite()) solid_corners_.push_back(world);
    }
  }
  const Vec3 eye = camera.pose.position;
  std::sort(ghosts_.begin(), ghosts_.end(), [&eye](const DrawItem& a, const DrawItem& b) {
    const double to_a = (center_of(a) - eye).squaredNorm();
    const double to_b = (center_of(b) - eye).squaredNorm();
    return to_a != to_b ? to_a > to_b : a.instance < b.instance;
  });
}

void draw_triangles(const DrawItem& item) {
  glUniformMatrix4fv(0, 1, GL_FALSE, item.model.data());
  glBindVertexArray(item.mesh->layout.get());
  glDrawElements(GL_TRIANGLES, item.mesh->index_count, GL_UNSIGNED_INT, nullptr);
}

}  // namespace nade::draw
