#pragma once

#include <vector>

#include "draw_list.h"
#include "nade/draw/renderer.h"

namespace nade::draw {

/// Depth maps of solids and ghosts, to be measured on.
class DepthProbe {
 public:
  [[nodiscard]] static Result<DepthProbe> create();
  [[nodiscard]] DepthMap draw(const DrawList& list, int width, int height, Faces faces);

 private:
  DepthProbe() = default;

  GlProgram program_;
};

}  // namespace nade::draw
