#include "render_targets.h"

#include <array>

namespace nade::draw {
namespace {

constexpr int kSamples = 4;

GlFramebuffer framebuffer_of(const GlTexture& texture) {
  GlFramebuffer framebuffer = make_framebuffer();
  glNamedFramebufferTexture(framebuffer.get(), GL_COLOR_ATTACHMENT0, texture.get(), 0);
  return framebuffer;
}

}  // namespace

RenderTargets::RenderTargets(int width_px, int height_px)
    : width(width_px),
      height(height_px),
      depth(make_target(GL_R32F, width, height)),
      normal(make_target(GL_RG16F, width, height)),
      depth_test(make_renderbuffer(GL_DEPTH_COMPONENT32F, 0, width, height)),
      depth_pass(framebuffer_of(depth)),
      visibility(make_target(GL_RG8, width, height)),
      visibility_pass(framebuffer_of(visibility)),
      smooth_visibility(make_target(GL_RG8, width, height)),
      smoothing_pass(framebuffer_of(smooth_visibility)),
      color_samples(make_renderbuffer(GL_RGBA8, kSamples, width, height)),
      depth_samples(make_renderbuffer(GL_DEPTH_COMPONENT32F, kSamples, width, height)),
      picture_pass(make_framebuffer()),
      resolved(make_target(GL_RGBA8, width, height)),
      resolve_pass(framebuffer_of(resolved)) {
  glNamedFramebufferTexture(depth_pass.get(), GL_COLOR_ATTACHMENT1, normal.get(), 0);
  glNamedFramebufferRenderbuffer(depth_pass.get(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                 depth_test.get());
  constexpr std::array<GLenum, 2> kBoth{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  glNamedFramebufferDrawBuffers(depth_pass.get(), 2, kBoth.data());
  glNamedFramebufferRenderbuffer(picture_pass.get(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                 color_samples.get());
  glNamedFramebufferRenderbuffer(picture_pass.get(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                 depth_samples.get());
}

}  // namespace nade::draw
