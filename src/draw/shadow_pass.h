#pragma once

#include <vector>

#include "draw_list.h"
#include "gl_objects.h"

namespace nade::draw {

/// Texture units that the maps are bound to while a picture is drawn.
enum TextureUnit : GLuint {
  kColorUnit,
  kDepthUnit,
  kNormalUnit,
  kVisibilityUnit,
  kShadowUnit,
};

/// What stands in the key light: one map about the focus, one about everything.
class ShadowPass {
 public:
  [[nodiscard]] static Result<ShadowPass> create();
  void draw(const std::vector<DrawItem>& solids);
  void bind() const;

 private:
  ShadowPass() = default;

  GlProgram program_;
  GlTexture maps_;
  GlFramebuffer near_pass_;
  GlFramebuffer wide_pass_;
};

}  // namespace nade::draw
