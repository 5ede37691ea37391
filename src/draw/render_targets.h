#pragma once

#include "gl_objects.h"

namespace nade::draw {

/// The textures a picture of one size is made in.
struct RenderTargets {
  /// Sizes above 0.
  RenderTargets(int width, int height);

  int width;
  int height;
  GlTexture depth;   ///< what is seen, without ghosts: metres before the eye, 0 where nothing is
  GlTexture normal;  ///< of what is seen, in the world, octahedral
  GlRenderbuffer depth_test;
  GlFramebuffer depth_pass;
  GlTexture visibility;  ///< how much of the key light and of the surroundings arrives
  GlFramebuffer visibility_pass;
  GlTexture smooth_visibility;
  GlFramebuffer smoothing_pass;
  GlRenderbuffer color_samples;
  GlRenderbuffer depth_samples;
  GlFramebuffer picture_pass;  ///< 4 samples a pixel
  GlTexture resolved;
  GlFramebuffer resolve_pass;
};

}  // namespace nade::draw
