#include "nade/draw/renderer.h"

#include <algorithm>
#include <array>
#include <optional>

#include "depth_probe.h"
#include "draw_list.h"
#include "label_pass.h"
#include "mesh_store.h"
#include "nade/assert.h"
#include "nade/draw/gl_context.h"
#include "occlusion_pass.h"
#include "overlay_pass.h"
#include "render_targets.h"
#include "shadow_pass.h"
#include "surface_pass.h"

namespace nade::draw {
namespace {

constexpr GLuint kFrameBinding = 0;

/// Every state that our passes rely on, whoever used the context before.
void take_over_state() {
  constexpr std::array<GLenum, 12> kOff{GL_BLEND,
                                        GL_CULL_FACE,
                                        GL_DEPTH_CLAMP,
                                        GL_FRAMEBUFFER_SRGB,
                                        GL_POLYGON_OFFSET_FILL,
                                        GL_PRIMITIVE_RESTART,
                                        GL_RASTERIZER_DISCARD,
                                        GL_SAMPLE_ALPHA_TO_COVERAGE,
                                        GL_SAMPLE_MASK,
                                        GL_SCISSOR_TEST,
                                        GL_STENCIL_TEST,
                                        GL_COLOR_LOGIC_OP};
  for (const GLenum state : kOff) {
    glDisable(state);
  }
  glEnable(GL_MULTISAMPLE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glDepthRange(0.0, 1.0);
  glFrontFace(GL_CCW);
  glCullFace(GL_BACK);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glBlendEquation(GL_FUNC_ADD);
  // What is drawn over something leaves it opaque.
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glPixelStorei(GL_PACK_ROW_LENGTH, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  for (GLuint unit = kColorUnit; unit <= kShadowUnit; ++unit) glBindSampler(unit, 0);
}

/// So that nothing of ours is in the way of who draws next.
void leave_state() {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glUseProgram(0);
  glBindVertexArray(0);
  for (GLuint unit = kColorUnit; unit <= kShadowUnit; ++unit) {
    glBindTextureUnit(unit, 0);
    glBindSampler(unit, 0);
  }
}

}  // namespace

struct Renderer::Impl {
  MeshStore meshes;
  DrawList list;
  ShadowPass shadows;
  OcclusionPass occlusion;
  SurfacePass surfaces;
  OverlayPass overlays;
  LabelPass labels;
  DepthProbe probe;
  GlBuffer uniforms = make_buffer(sizeof(FrameUniforms), nullptr, GL_DYNAMIC_STORAGE_BIT);
  std::optional<RenderTargets> targets{};

  void set_uniforms(const FrameUniforms& frame) {
    glNamedBufferSubData(uniforms.get(), 0, sizeof(FrameUniforms), &frame);
    glBindBufferBase(GL_UNIFORM_BUFFER, kFrameBinding, uniforms.get());
  }

  /// Of several eyes, shadows are the same for all: they are drawn with the first.
  enum class Shadows : std::uint8_t { draw, keep };

  /// The picture, resolved, is then in `targets->resolved`.
  void draw(const Scene& scene, const Camera& camera, int width, int height,
            Shadows at_shadows = Shadows::draw) {
    if (!targets || targets->width != width || targets->height != height) {
      targets.reset();
      targets.emplace(width, height);
    }
    take_over_state();
    list.gather(scene, meshes, camera);
    const FrameUniforms frame = frame_uniforms(scene, camera, width, height, list.solid_corners());
    set_uniforms(frame);
    if (at_shadows == Shadows::draw) shadows.draw(list.solids());
    shadows.bind();
    occlusion.draw(list.solids(), scene, *targets);

    constexpr float kFar = 1.0F;
    glBindFramebuffer(GL_FRAMEBUFFER, targets->picture_pass.get());
    glClearNamedFramebufferfv(targets->picture_pass.get(), GL_DEPTH, 0, &kFar);
    surfaces.draw_solids(list.solids(), scene);
    overlays.draw(scene);
    surfaces.draw_ghosts(list.ghosts());
    labels.draw(scene.labels, frame);
    glBlitNamedFramebuffer(targets->picture_pass.get(), targets->resolve_pass.get(), 0, 0, width,
                           height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    leave_state();
  }
};

Renderer::Renderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Result<Renderer> Renderer::create() {
  if (Status checked = check_current_context(); !checked) return checked.error();
  Result<ShadowPass> shadows = ShadowPass::create();
  if (!shadows) return shadows.error();
  Result<OcclusionPass> occlusion = OcclusionPass::create();
  if (!occlusion) return occlusion.error();
  Result<SurfacePass> surfaces = SurfacePass::create();
  if (!surfaces) return surfaces.error();
  Result<OverlayPass> overlays = OverlayPass::create();
  if (!overlays) return overlays.error();
  Result<LabelPass> labels = LabelPass::create();
  if (!labels) return labels.error();
  Result<DepthProbe> probe = DepthProbe::create();
  if (!probe) return probe.error();
  return Renderer(std::unique_ptr<Impl>(
      new Impl{MeshStore(), DrawList(), std::move(*shadows), std::move(*occlusion),
               std::move(*surfaces), std::move(*overlays), std::move(*labels), std::move(*probe)}));
}

MeshId Renderer::add(const DrawnMesh& mesh) { return impl_->meshes.add(mesh); }
void Renderer::remove(MeshId mesh) { impl_->meshes.remove(mesh); }

void Renderer::set_shape(MeshId mesh, std::span<const Eigen::Vector3f> positions,
                         std::span<const Eigen::Vector3f> normals) {
  impl_->meshes.set_shape(mesh, positions, normals);
}

void Renderer::set_colors(MeshId mesh, std::span<const Color> colors) {
  impl_->meshes.set_colors(mesh, colors);
}

void Renderer::set_material(MeshId mesh, const Material& material) {
  impl_->meshes.set_material(mesh, material);
}

void Renderer::set_texture(MeshId mesh, const Image& image) {
  impl_->meshes.set_texture(mesh, image);
}

void Renderer::draw(const Scene& scene, const Camera& camera, const Target& target) {
  const Sight sight{camera, target};
  draw(scene, std::span(&sight, 1));
}

void Renderer::draw(const Scene& scene, std::span<const Sight> sights) {
  Impl::Shadows shadows = Impl::Shadows::draw;
  for (const auto& [camera, target] : sights) {
    NADE_ASSERT(target.width > 0 && target.height > 0);
    impl_->draw(scene, camera, target.width, target.height, shadows);
    shadows = Impl::Shadows::keep;
    glBlitNamedFramebuffer(impl_->targets->resolve_pass.get(), target.framebuffer, 0, 0,
                           target.width, target.height, target.x, target.y, target.x + target.width,
                           target.y + target.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  }
}

Image Renderer::picture(const Scene& scene, const Camera& camera, int width, int height) {
  NADE_ASSERT(width > 0 && height > 0);
  impl_->draw(scene, camera, width, height);
  Image image = Image::blank(width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, impl_->targets->resolve_pass.get());
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  const auto row = 4 * static_cast<std::size_t>(width);
  for (std::size_t top = 0, bottom = static_cast<std::size_t>(height) - 1; top < bottom;
       ++top, --bottom) {
    std::uint8_t* const first = image.rgba.data() + top * row;
    std::swap_ranges(first, first + row, image.rgba.data() + bottom * row);
  }
  return image;
}

DepthMap Renderer::depths(const Scene& scene, const Camera& camera, int width, int height,
                          Faces faces) {
  NADE_ASSERT(width > 0 && height > 0);
  take_over_state();
  impl_->list.gather(scene, impl_->meshes, camera);
  impl_->set_uniforms(eye_uniforms(camera, width, height));
  DepthMap map = impl_->probe.draw(impl_->list, width, height, faces);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  leave_state();
  return map;
}

}  // namespace nade::draw
