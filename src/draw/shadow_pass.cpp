#include "shadow_pass.h"

#include <array>

namespace nade::draw {
namespace {

constexpr GLint kMapUniform = 1;

GlTexture make_map() {
  GlTexture map = make_texture(GL_TEXTURE_2D);
  glTextureStorage2D(map.get(), 1, GL_DEPTH_COMPONENT32F, kShadowMapSize, kShadowMapSize);
  return map;
}

GlFramebuffer make_pass(const GlTexture& map) {
  GlFramebuffer pass = make_framebuffer();
  glNamedFramebufferTexture(pass.get(), GL_DEPTH_ATTACHMENT, map.get(), 0);
  glNamedFramebufferDrawBuffer(pass.get(), GL_NONE);
  glNamedFramebufferReadBuffer(pass.get(), GL_NONE);
  return pass;
}

/// Beyond its border a map says that nothing stands in the light.
GlSampler make_sampler(GLint filter) {
  GLuint name = 0;
  glCreateSamplers(1, &name);
  GlSampler sampler(name);
  constexpr std::array<float, 4> kLit{1.0F, 1.0F, 1.0F, 1.0F};
  glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, filter);
  glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, filter);
  glSamplerParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  glSamplerParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  glSamplerParameterfv(name, GL_TEXTURE_BORDER_COLOR, kLit.data());
  return sampler;
}

}  // namespace

Result<ShadowPass> ShadowPass::create() {
  Result<GlProgram> program =
      make_program({{"frame.glsl", "shadow.vert.glsl"}, {"shadow.frag.glsl"}});
  if (!program) return program.error();
  ShadowPass pass;
  pass.program_ = std::move(*program);
  pass.near_ = make_map();
  pass.wide_ = make_map();
  pass.near_pass_ = make_pass(pass.near_);
  pass.wide_pass_ = make_pass(pass.wide_);
  pass.compare_ = make_sampler(GL_LINEAR);
  glSamplerParameteri(pass.compare_.get(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glSamplerParameteri(pass.compare_.get(), GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  pass.read_ = make_sampler(GL_NEAREST);
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

void ShadowPass::bind() const {
  glBindTextureUnit(kNearShadowUnit, near_.get());
  glBindTextureUnit(kNearShadowDepthUnit, near_.get());
  glBindTextureUnit(kWideShadowUnit, wide_.get());
  glBindTextureUnit(kWideShadowDepthUnit, wide_.get());
  glBindSampler(kNearShadowUnit, compare_.get());
  glBindSampler(kWideShadowUnit, compare_.get());
  glBindSampler(kNearShadowDepthUnit, read_.get());
  glBindSampler(kWideShadowDepthUnit, read_.get());
}

}  // namespace nade::draw
