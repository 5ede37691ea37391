#pragma once

#include <Eigen/Core>
#include <span>

#include "nade/draw/scene.h"

namespace nade::draw {

/// What every shader knows of the picture; the layout is that of shaders/frame.glsl.
struct FrameUniforms {
  Eigen::Matrix4f view;          ///< world to eye
  Eigen::Matrix4f projection;    ///< eye to clip
  Eigen::Matrix4f near_shadow;   ///< world to the unit cube of the shadow map about the focus
  Eigen::Matrix4f wide_shadow;   ///< the same of the one about everything
  Eigen::Vector4f eye;           ///< in the world
  Eigen::Vector4f forward;       ///< where the eye looks, in the world
  Eigen::Vector4f size;          ///< width, height, and one over each; pixels
  Eigen::Vector4f unproject;     ///< eye's x, y = depth (unproject.xy clip.xy + unproject.zw)
  Eigen::Vector4f key_light;     ///< towards the light; w: tangent of half its angular size
  Eigen::Vector4f fill_light;    ///< towards the light
  Eigen::Vector4f rim_light;     ///< towards the light
  Eigen::Vector4f near_extent;   ///< of the map about the focus: width, depth range, texel; metres
  Eigen::Vector4f wide_extent;   ///< the same of the one about everything
  Eigen::Vector4f near_casters;  ///< where in the map about the focus something can cast a shadow
  Eigen::Vector4f wide_casters;  ///< the same of the one about everything; low x, y, high x, y
  Eigen::Vector4f solids_low;    ///< the box about all solids
  Eigen::Vector4f solids_high;
  Eigen::Vector4f focus;  ///< centre and radius
  Eigen::Vector4f floor;  ///< height, 1 where there is one, how far it reaches
};

/// A scene as seen by a camera in a picture of a size. `solids` are the corners of the boxes about
/// what casts shadows.
[[nodiscard]] FrameUniforms frame_uniforms(const Scene& scene, const Camera& camera, int width,
                                           int height, std::span<const Vec3> solids);

/// The same without light: for depths.
[[nodiscard]] FrameUniforms eye_uniforms(const Camera& camera, int width, int height);

inline constexpr int kShadowMapSize = 2048;

}  // namespace nade::draw
