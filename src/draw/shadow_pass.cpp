#include "shadow_pass.h"

namespace nade::draw {
namespace {

constexpr GLint kMapUniform = 1;

GlFramebuffer make_pass(const GlTexture& maps, GLint layer) {
  GlFramebuffer pass = make_framebuffer();
  glNamedFramebufferTextureLayer(pass.get(), GL_DEPTH_ATTACHMENT, maps.get(), 0, layer);
  glNamedFramebufferDrawBuffer(pass.get(), GL_NONE);
  glNamedFramebufferReadBuffer(pass.get(), GL_NONE);
  return pass;
}

}  // namespace

Result<ShadowPass> ShadowPass::create() {
  Result<GlProgram> program =
      make_program({{"frame.glsl", "shadow.vert.glsl"}, {"depth_only.frag.glsl"}});
  if (!program) return program.error();
  ShadowPass pass;
  pass.program_ = std::move(*program);
  pass.maps_ = make_texture(GL_TEXTURE_2D_ARRAY);
  const GLuint maps = pass.maps_.get();
  glTextureStorage3D(maps, 1, GL_DEPTH_COMPONENT32F, kShadowMapSize, kShadowMapSize, 2);
  glTextureParameteri(maps, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(maps, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  pass.near_pass_ = make_pass(pass.maps_, 0);
  pass.wide_pass_ = make_pass(pass.maps_, 1);
  return pass;
}

void ShadowPass::draw(const std::vector<DrawItem>& solids) {
  constexpr float kFar = 1.0F;
  glUseProgram(program_.get());
  glViewport(0, 0, kShadowMapSize, kShadowMapSize);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  // What stands between the light and the box still casts its shadow into it.
  glEnable(GL_DEPTH_CLAMP);
  for (const auto* const pass : {&near_pass_, &wide_pass_}) {
    glBindFramebuffer(GL_FRAMEBUFFER, pass->get());
    glClearNamedFramebufferfv(pass->get(), GL_DEPTH, 0, &kFar);
    glUniform1i(kMapUniform, pass == &near_pass_ ? 0 : 1);
    for (const DrawItem& item : solids) draw_triangles(item);
  }
  glDisable(GL_DEPTH_CLAMP);
}

void ShadowPass::bind() const { glBindTextureUnit(kShadowUnit, maps_.get()); }

}  // namespace nade::draw
