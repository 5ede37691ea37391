#include "frame_uniforms.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace nade::draw {
namespace {

/// Half the angle under which the key light is seen: a softbox of 36 cm, 2 m away.
constexpr double kKeyTangent = 0.09;
/// As in shaders/shadow.glsl.
constexpr double kWidestShadowBlur = 0.06;
constexpr double kLeastShadowRadius = 0.02;
constexpr double kFloorReach = 12.0;

/// Towards the lights of a studio whose front is +Z.
const Vec3 kKeyLight(-0.42, 0.95, 0.62);
const Vec3 kFillLight(0.85, 0.35, 0.55);
const Vec3 kRimLight(0.35, 0.55, -0.90);

Vec3 turned(const Vec3& direction, double turn_rad) {
  return Eigen::AngleAxisd(turn_rad, Vec3::UnitY()) * direction.normalized();
}

Eigen::Vector4f with(const Vec3& vector, double last) {
  Eigen::Vector4f result;
  result << vector.cast<float>(), static_cast<float>(last);
  return result;
}

Eigen::Matrix4d projection_of(const Camera& camera) {
  const double left = std::tan(camera.view.left);
  const double right = std::tan(camera.view.right);
  const double up = std::tan(camera.view.up);
  const double down = std::tan(camera.view.down);
  const double near = camera.near_m;
  const double far = camera.far_m;
  Eigen::Matrix4d projection = Eigen::Matrix4d::Zero();
  projection(0, 0) = 2.0 / (right - left);
  projection(0, 2) = (right + left) / (right - left);
  projection(1, 1) = 2.0 / (up - down);
  projection(1, 2) = (up + down) / (up - down);
  projection(2, 2) = -(far + near) / (far - near);
  projection(2, 3) = -2.0 * far * near / (far - near);
  projection(3, 2) = -1.0;
  return projection;
}

Eigen::Matrix4d matrix_of(const Pose& pose) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = pose.rotation.toRotationMatrix();
  matrix.topRightCorner<3, 1>() = pose.position;
  return matrix;
}

/// Right, up and away, as seen by the light; each a row.
Eigen::Matrix3d light_axes(const Vec3& to_light) {
  const Vec3 right =
      to_light.cross(std::abs(to_light.y()) < 0.99 ? Vec3::UnitY() : Vec3::UnitZ()).normalized();
  Eigen::Matrix3d axes;
  axes.row(0) = right;
  axes.row(1) = right.cross(-to_light);
  axes.row(2) = -to_light;
  return axes;
}

struct ShadowMap {
  Eigen::Matrix4f world_to_map;
  Eigen::Vector4f extent;
  Eigen::Vector4f casters;
};

/// A map about `center` (in the light's axes), deep enough for `casters` and what they shade.
ShadowMap shadow_map(const Eigen::Matrix3d& axes, const Vec3& center, double radius_m,
                     const Eigen::AlignedBox3d& casters) {
  const double width = 2.0 * radius_m;
  const double start = std::min(casters.min().z(), center.z() - radius_m) - 0.01;
  const double end = std::max(casters.max().z(), center.z() + radius_m) + 0.01;
  // In steps of whole texels, so that shadows do not crawl when the focus moves.
  const double texel = width / kShadowMapSize;
  const auto snapped = [texel](double x) { return std::round(x / texel) * texel; };
  const double low_x = snapped(center.x()) - radius_m;
  const double low_y = snapped(center.y()) - radius_m;
  Eigen::Matrix4d map = Eigen::Matrix4d::Identity();
  map.topLeftCorner<3, 3>() = axes;
  map.topRightCorner<3, 1>() = Vec3(-low_x, -low_y, -start);
  map.topRows<2>() /= width;
  map.row(2) /= end - start;
  const double reach = kWidestShadowBlur + 2.0 * texel;
  return {map.cast<float>(), Eigen::Vector4d(width, end - start, texel, 0.0).cast<float>(),
          Eigen::Vector4d((casters.min().x() - reach - low_x) / width,
                          (casters.min().y() - reach - low_y) / width,
                          (casters.max().x() + reach - low_x) / width,
                          (casters.max().y() + reach - low_y) / width)
              .cast<float>()};
}

/// The lights and the shadows they cast.
void set_lights(const Scene& scene, std::span<const Vec3> solids, FrameUniforms& frame) {
  const Vec3 to_key = turned(kKeyLight, scene.light_turn_rad);
  const Eigen::Matrix3d axes = light_axes(to_key);
  Eigen::AlignedBox3d box;
  Eigen::AlignedBox3d casters;
  for (const Vec3& corner : solids) {
    box.extend(corner);
    casters.extend(axes * corner);
  }
  if (casters.isEmpty()) {
    box.extend(scene.focus);
    casters.extend(axes * scene.focus);
  }
  const double focus_radius = std::max(scene.focus_radius_m, kLeastShadowRadius);
  const double wide_radius =
      std::max(0.52 * casters.sizes().head<2>().maxCoeff(), kLeastShadowRadius);
  const ShadowMap near = shadow_map(axes, axes * scene.focus, focus_radius, casters);
  const ShadowMap wide = shadow_map(axes, casters.center(), wide_radius, casters);
  frame.near_shadow = near.world_to_map;
  frame.near_extent = near.extent;
  frame.near_casters = near.casters;
  frame.wide_shadow = wide.world_to_map;
  frame.wide_extent = wide.extent;
  frame.wide_casters = wide.casters;
  frame.solids_low = with(box.min(), 0.0);
  frame.solids_high = with(box.max(), 0.0);
  frame.focus = with(scene.focus, focus_radius);
  frame.key_light = with(to_key, kKeyTangent);
  frame.fill_light = with(turned(kFillLight, scene.light_turn_rad), 0.0);
  frame.rim_light = with(turned(kRimLight, scene.light_turn_rad), 0.0);
}

}  // namespace

FrameUniforms eye_uniforms(const Camera& camera, int width, int height) {
  FrameUniforms frame{};
  const Eigen::Matrix4d projection = projection_of(camera);
  frame.view = matrix_of(camera.pose.inverse()).cast<float>();
  frame.projection = projection.cast<float>();
  frame.eye = with(camera.pose.position, 1.0);
  frame.forward = with(camera.pose.rotation * -Vec3::UnitZ(), 0.0);
  frame.size << static_cast<float>(width), static_cast<float>(height),
      1.0F / static_cast<float>(width), 1.0F / static_cast<float>(height);
  frame.unproject =
      Eigen::Vector4d(1.0 / projection(0, 0), 1.0 / projection(1, 1),
                      projection(0, 2) / projection(0, 0), projection(1, 2) / projection(1, 1))
          .cast<float>();
  return frame;
}

FrameUniforms frame_uniforms(const Scene& scene, const Camera& camera, int width, int height,
                             std::span<const Vec3> solids) {
  FrameUniforms frame = eye_uniforms(camera, width, height);
  set_lights(scene, solids, frame);
  frame.floor << static_cast<float>(scene.floor_y), scene.floor ? 1.0F : 0.0F,
      static_cast<float>(kFloorReach), 0.0F;
  return frame;
}

}  // namespace nade::draw
