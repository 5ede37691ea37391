#pragma once

#include <array>
#include <vector>

#include "draw_list.h"

namespace nade::draw {

/// Surfaces in the studio's light, into the framebuffer that is bound.
class SurfacePass {
 public:
  [[nodiscard]] static Result<SurfacePass> create();
  /// Backdrop, floor and solids. Needs what the occlusion pass leaves bound.
  void draw_solids(const std::vector<DrawItem>& solids, const Scene& scene);
  /// Over what is drawn already.
  void draw_ghosts(const std::vector<DrawItem>& ghosts);

 private:
  SurfacePass() = default;

  GlProgram backdrop_;
  GlProgram floor_depth_;
  std::array<GlProgram, 8> surfaces_;  ///< by what a material asks for
  GlProgram ghost_;
  GlVertexArray nothing_;
};

}  // namespace nade::draw
