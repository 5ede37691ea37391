#pragma once

#include <vector>

#include "frame_uniforms.h"
#include "mesh_store.h"

namespace nade::draw {

/// An instance on its way to the picture.
struct DrawItem {
  const StoredMesh* mesh = nullptr;
  const Instance* instance = nullptr;
  Eigen::Matrix4f model;
};

/// What of a scene is to be drawn, in order.
class DrawList {
 public:
  void gather(const Scene& scene, const MeshStore& meshes, const Camera& camera);
  [[nodiscard]] const std::vector<DrawItem>& solids() const { return solids_; }
  /// Farthest from the eye first.
  [[nodiscard]] const std::vector<DrawItem>& ghosts() const { return ghosts_; }
  /// Of the boxes about the solids, in the world.
  [[nodiscard]] const std::vector<Vec3>& solid_corners() const { return solid_corners_; }

 private:
  std::vector<DrawItem> solids_;
  std::vector<DrawItem> ghosts_;
  std::vector<Vec3> solid_corners_;
};

/// Draws an item's triangles with the program that is in use; its model matrix is uniform 0.
void draw_triangles(const DrawItem& item);

}  // namespace nade::draw
