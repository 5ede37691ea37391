#include "depth_probe.h"

#include <algorithm>
#include <array>
#include <limits>

namespace nade::draw {

Result<DepthProbe> DepthProbe::create() {
  Result<GlProgram> program =
      make_program({{"frame.glsl", "mesh.vert.glsl"}, {"normals.glsl", "depths.frag.glsl"}});
  if (!program) return program.error();
  DepthProbe probe;
  probe.program_ = std::move(*program);
  return probe;
}

DepthMap DepthProbe::draw(const DrawList& list, int width, int height, Faces faces) {
  const GlTexture depth = make_target(GL_R32F, width, height);
  const GlRenderbuffer test = make_renderbuffer(GL_DEPTH_COMPONENT32F, 0, width, height);
  const GlFramebuffer pass = make_framebuffer();
  glNamedFramebufferTexture(pass.get(), GL_COLOR_ATTACHMENT0, depth.get(), 0);
  glNamedFramebufferRenderbuffer(pass.get(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, test.get());
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr std::array<float, 4> kNothing{kInfinity, 0.0F, 0.0F, 0.0F};
  constexpr float kFar = 1.0F;
  glClearNamedFramebufferfv(pass.get(), GL_COLOR, 0, kNothing.data());
  glClearNamedFramebufferfv(pass.get(), GL_DEPTH, 0, &kFar);
  glBindFramebuffer(GL_FRAMEBUFFER, pass.get());
  glViewport(0, 0, width, height);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glEnable(GL_CULL_FACE);
  glCullFace(faces == Faces::front ? GL_BACK : GL_FRONT);
  glUseProgram(program_.get());
  for (const auto* const items : {&list.solids(), &list.ghosts()}) {
    for (const DrawItem& item : *items) draw_triangles(item);
  }
  glCullFace(GL_BACK);
  glDisable(GL_CULL_FACE);

  const auto row = static_cast<std::size_t>(width);
  DepthMap map{width, height, std::vector<float>(row * static_cast<std::size_t>(height))};
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, width, height, GL_RED, GL_FLOAT, map.depth_m.data());
  for (std::size_t top = 0, bottom = static_cast<std::size_t>(height) - 1; top < bottom;
       ++top, --bottom) {
    float* const first = map.depth_m.data() + top * row;
    std::swap_ranges(first, first + row, map.depth_m.data() + bottom * row);
  }
  return map;
}

}  // namespace nade::draw
