#pragma once

#include <span>
#include <vector>

#include "nade/draw/scene.h"
#include "nade/flatten_skin.h"
#include "nade/hand_mesh.h"
#include "nade/surface.h"

namespace nade::draw {

/// A hand in its bind pose, painted as skin: redder in the palm, at fingertips and knuckles, with
/// nails and creases, all found from its bones. Painted into a texture where the mesh has texture
/// coordinates of its own for every spot, else at the vertices.
[[nodiscard]] DrawnMesh paint_skin(const HandMesh& mesh);

/// A hand in its bind pose without colours of its own, as for a ghost.
[[nodiscard]] DrawnMesh plain_hand(const HandMesh& mesh);

/// Poses a hand's skin as `pose_skin` does, with normals that run smoothly over the seams of the
/// mesh. Keep one for each hand that is drawn.
class SkinPoser {
 public:
  explicit SkinPoser(const HandMesh& mesh);

  void pose(const HandPose& hand, double scale);
  /// Of the hand as last posed; `flattener` is of the same mesh.
  void flatten(SkinFlattener& flattener, const Object& object, const HandPose& hand, double scale,
               double give_m);
  [[nodiscard]] std::span<const Eigen::Vector3f> positions() const { return positions_; }
  [[nodiscard]] std::span<const Eigen::Vector3f> normals();

  /// Colours by the depth of each vertex as last posed: white outside, red from 10 mm deep.
  [[nodiscard]] const std::vector<Color>& penetration_colors(const Object& object);

 private:
  void compute_normals();

  const HandMesh* mesh_;
  std::vector<std::uint32_t> twin_;  ///< the first vertex at the same place
  std::vector<Eigen::Vector3f> positions_;
  std::vector<Eigen::Vector3f> normals_;
  bool has_normals_ = false;  ///< of `positions_`
  std::vector<Color> colors_;
  std::vector<SurfaceHint> hints_;
};

}  // namespace nade::draw
