#pragma once

#include <vector>

#include "draw_list.h"
#include "render_targets.h"

namespace nade::draw {

/// How much of the key light and of the surroundings arrives at what is seen: soft shadows, and
/// the darkness where two surfaces come near each other.
class OcclusionPass {
 public:
  [[nodiscard]] static Result<OcclusionPass> create();
  /// Needs the shadow maps bound. Leaves `targets.smooth_visibility` bound with the depths.
  void draw(const std::vector<DrawItem>& solids, const Scene& scene, const RenderTargets& targets);

 private:
  OcclusionPass() = default;
  void draw_depths(const std::vector<DrawItem>& solids, const Scene& scene,
                   const RenderTargets& targets);

  GlProgram depths_;
  GlProgram floor_depths_;
  GlProgram visibility_;
  GlProgram smoothing_;
  GlVertexArray nothing_;  ///< for what the vertex shader makes by itself
};

}  // namespace nade::draw
