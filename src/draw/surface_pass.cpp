#include "surface_pass.h"

#include <array>
#include <string>

#include "shadow_pass.h"

namespace nade::draw {
namespace {

// As in shaders/surface.frag.glsl and ghost.frag.glsl.
constexpr GLint kBaseColorUniform = 1;
constexpr GLint kMaterialUniform = 2;
constexpr GLint kTexturedUniform = 3;
constexpr GLint kOpacityUniform = 4;

/// What a surface's shader has to do beyond the plain.
enum SurfaceFeature : std::size_t { kTextureFeature = 1, kSkinFeature = 2, kCoatFeature = 4 };

std::size_t features_of(const StoredMesh& mesh) {
  std::size_t features = 0;
  if (mesh.texture) features |= kTextureFeature;
  if (mesh.material.translucency > 0.0F) features |= kSkinFeature;
  if (mesh.material.sheen > 0.0F) features |= kCoatFeature;
  return features;
}

std::string definitions_of(std::size_t features) {
  std::string lines;
  if (features & kTextureFeature) lines += "#define TEXTURE\n";
  if (features & kSkinFeature) lines += "#define SKIN\n";
  if (features & kCoatFeature) lines += "#define COAT\n";
  return lines;
}

void set_color(const DrawItem& item) {
  const Color color = item.mesh->material.base_color.cwiseProduct(item.instance->tint);
  glUniform3fv(kBaseColorUniform, 1, color.data());
  glBindTextureUnit(kColorUnit, item.mesh->texture.get());
}

void set_material(const Material& material) {
  glUniform4f(kMaterialUniform, material.roughness, material.metalness, material.sheen,
              material.translucency);
}

}  // namespace

Result<SurfacePass> SurfacePass::create() {
  SurfacePass pass;
  const std::array<Status, 3> built{
      make_program(
          {{"screen.vert.glsl"},
           {"frame.glsl", "srgb.glsl", "studio.glsl", "received.glsl", "backdrop.frag.glsl"}},
          pass.backdrop_),
      make_program({{"frame.glsl", "floor.vert.glsl"}, {"depth_only.frag.glsl"}},
                   pass.floor_depth_),
      make_program({{"frame.glsl", "mesh.vert.glsl"},
                    {"frame.glsl", "srgb.glsl", "studio.glsl", "ghost.frag.glsl"}},
                   pass.ghost_)};
  for (const Status& status : built) {
    if (!status) return status.error();
  }
  for (std::size_t features = 0; features < pass.surfaces_.size(); ++features) {
    const std::string definitions = definitions_of(features);
    const Status status = make_program({{"frame.glsl", "mesh.vert.glsl"},
                                        {"frame.glsl", "srgb.glsl", "studio.glsl", "received.glsl",
                                         "grain.glsl", "surface.frag.glsl"},
                                        definitions},
                                       pass.surfaces_[features]);
    if (!status) return status.error();
  }
  pass.nothing_ = make_vertex_array();
  return pass;
}

void SurfacePass::draw_solids(const std::vector<DrawItem>& solids, const Scene& scene) {
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(nothing_.get());
  glUseProgram(backdrop_.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);

  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  if (scene.floor) {
    // Its colour is the backdrop's; here it only hides what is under it.
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glUseProgram(floor_depth_.get());
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  }
  // A vertex without colour is white.
  glVertexAttrib3f(kColorAttribute, 1.0F, 1.0F, 1.0F);
  for (const DrawItem& item : solids) {
    glUseProgram(surfaces_[features_of(*item.mesh)].get());
    set_color(item);
    set_material(item.mesh->material);
    draw_triangles(item);
  }
}

void SurfacePass::draw_ghosts(const std::vector<DrawItem>& ghosts) {
  if (ghosts.empty()) return;
  glVertexAttrib3f(kColorAttribute, 1.0F, 1.0F, 1.0F);
  glUseProgram(ghost_.get());
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  for (const DrawItem& item : ghosts) {
    set_color(item);
    glUniform1i(kTexturedUniform, item.mesh->texture ? 1 : 0);
    if (item.instance->shows_behind > 0.0F) {
      glUniform1f(kOpacityUniform, item.instance->opacity * item.instance->shows_behind);
      glDepthMask(GL_FALSE);
      glDepthFunc(GL_GREATER);
      draw_triangles(item);
      glDepthMask(GL_TRUE);
    }
    // First its depth alone, so that only its front shows.
    glUniform1f(kOpacityUniform, item.instance->opacity);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glDepthFunc(GL_LESS);
    draw_triangles(item);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthFunc(GL_EQUAL);
    draw_triangles(item);
  }
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glDepthFunc(GL_LESS);
}

}  // namespace nade::draw
