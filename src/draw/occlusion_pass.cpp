#include "occlusion_pass.h"

#include <array>

#include "shadow_pass.h"

namespace nade::draw {

Result<OcclusionPass> OcclusionPass::create() {
  OcclusionPass pass;
  const std::array<Status, 4> built{
      make_program({{"frame.glsl", "mesh.vert.glsl"}, {"normals.glsl", "depths.frag.glsl"}},
                   pass.depths_),
      make_program({{"frame.glsl", "floor.vert.glsl"}, {"normals.glsl", "depths.frag.glsl"}},
                   pass.floor_depths_),
      make_program({{"screen.vert.glsl"},
                    {"frame.glsl", "normals.glsl", "shadow.glsl", "visibility.frag.glsl"}},
                   pass.visibility_),
      make_program({{"screen.vert.glsl"}, {"frame.glsl", "normals.glsl", "smoothing.frag.glsl"}},
                   pass.smoothing_)};
  for (const Status& status : built) {
    if (!status) return status.error();
  }
  pass.nothing_ = make_vertex_array();
  return pass;
}

void OcclusionPass::draw_depths(const std::vector<DrawItem>& solids, const Scene& scene,
                                const RenderTargets& targets) {
  constexpr std::array<float, 4> kNothing{0.0F, 0.0F, 0.0F, 0.0F};
  constexpr float kFar = 1.0F;
  const GLuint pass = targets.depth_pass.get();
  glBindFramebuffer(GL_FRAMEBUFFER, pass);
  glViewport(0, 0, targets.width, targets.height);
  glClearNamedFramebufferfv(pass, GL_COLOR, 0, kNothing.data());
  glClearNamedFramebufferfv(pass, GL_COLOR, 1, kNothing.data());
  glClearNamedFramebufferfv(pass, GL_DEPTH, 0, &kFar);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glUseProgram(depths_.get());
  for (const DrawItem& item : solids) draw_triangles(item);
  if (!scene.floor) return;
  glUseProgram(floor_depths_.get());
  glBindVertexArray(nothing_.get());
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void OcclusionPass::draw(const std::vector<DrawItem>& solids, const Scene& scene,
                         const RenderTargets& targets) {
  draw_depths(solids, scene, targets);
  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(nothing_.get());
  glBindTextureUnit(kDepthUnit, targets.depth.get());
  glBindTextureUnit(kNormalUnit, targets.normal.get());
  glBindFramebuffer(GL_FRAMEBUFFER, targets.visibility_pass.get());
  glUseProgram(visibility_.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);

  glBindTextureUnit(kVisibilityUnit, targets.visibility.get());
  glBindFramebuffer(GL_FRAMEBUFFER, targets.smoothing_pass.get());
  glUseProgram(smoothing_.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindTextureUnit(kVisibilityUnit, targets.smooth_visibility.get());
}

}  // namespace nade::draw
