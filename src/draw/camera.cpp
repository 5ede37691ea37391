#include "nade/draw/camera.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nade::draw {
namespace {

constexpr double kSteepest = 89.0 * kDegree;
/// What is framed fills this share of the picture's height.
constexpr double kFill = 0.9;

constexpr std::array<std::string_view, 5> kViewNames{"front", "side", "top", "three-quarter",
                                                     "first-person"};

/// Unit vector from the target to the eye.
Vec3 outward(double azimuth_rad, double elevation_rad) {
  return {std::sin(azimuth_rad) * std::cos(elevation_rad), std::sin(elevation_rad),
          std::cos(azimuth_rad) * std::cos(elevation_rad)};
}

}  // namespace

std::optional<View> view_from_name(std::string_view name) {
  const auto found = std::find(kViewNames.begin(), kViewNames.end(), name);
  if (found == kViewNames.end()) return std::nullopt;
  return static_cast<View>(found - kViewNames.begin());
}

std::string_view name_of(View view) { return kViewNames[static_cast<std::size_t>(view)]; }

Camera looking_at(const Vec3& eye, const Vec3& target, double vertical_view_rad, double aspect) {
  const Vec3 offset = eye - target;
  const double distance = offset.norm();
  const Vec3 back = distance > 1e-9 ? Vec3(offset / distance) : Vec3::UnitZ();
  // Straight down, -Z is up in the picture.
  Vec3 right = Vec3::UnitY().cross(back);
  right = right.norm() > 1e-6 ? Vec3(right.normalized()) : Vec3::UnitX();
  Eigen::Matrix3d axes;
  axes << right, back.cross(right), back;
  Camera camera;
  camera.pose = {eye, Quat(axes)};
  camera.view = symmetric_view(vertical_view_rad, aspect);
  camera.near_m = std::clamp(0.05 * distance, 0.005, 0.1);
  camera.far_m = std::max(20.0, 4.0 * distance);
  return camera;
}

Camera Orbit::camera(double aspect) const {
  const double elevation = std::clamp(elevation_rad, -kSteepest, kSteepest);
  return looking_at(target + distance_m * outward(azimuth_rad, elevation), target,
                    vertical_view_rad, aspect);
}

Orbit framed(View view, const Vec3& center, double radius_m) {
  Orbit orbit;
  orbit.target = center;
  orbit.vertical_view_rad = 32.0 * kDegree;
  orbit.distance_m = std::max(radius_m, 1e-3) / std::sin(0.5 * kFill * orbit.vertical_view_rad);
  switch (view) {
    case View::front:
      orbit.azimuth_rad = 0.0;
      orbit.elevation_rad = 12.0 * kDegree;
      break;
    case View::side:
      orbit.azimuth_rad = 90.0 * kDegree;
      orbit.elevation_rad = 8.0 * kDegree;
      break;
    case View::top:
      orbit.azimuth_rad = 0.0;
      orbit.elevation_rad = kSteepest;
      break;
    case View::three_quarter:
    case View::first_person:
      // Thumb and fingertips of a right hand that points along -Z.
      orbit.azimuth_rad = -130.0 * kDegree;
      orbit.elevation_rad = 22.0 * kDegree;
      break;
  }
  return orbit;
}

Camera first_person(const HandPose& hand, double aspect) {
  const Vec3 wrist = hand[Joint::wrist].position;
  const Vec3 knuckle = hand[Joint::middle_proximal].position;
  Vec3 ahead = knuckle - wrist;
  ahead.y() = 0.0;  // the head does not roll with the hand
  if (ahead.norm() < 1e-6) ahead = -Vec3::UnitZ();
  ahead.normalize();
  const Vec3 eye = wrist - 0.15 * ahead + 0.26 * Vec3::UnitY();
  return looking_at(eye, knuckle, 40.0 * kDegree, aspect);
}

}  // namespace nade::draw
