#include "camera_rig.h"

#include <algorithm>
#include <cmath>

namespace nade::viewer {
namespace {

constexpr double kRadiansPerPixel = 0.006;
constexpr double kZoomPerNotch = 0.88;
constexpr double kNearest_m = 0.08;
constexpr double kFarthest_m = 8.0;
constexpr double kSteepest_rad = 89.0 * kDegree;
/// Higher than pictures are taken from: a hand is steered best when one sees its back.
constexpr double kThreeQuarter_rad = 42.0 * kDegree;
constexpr double kFollow_s = 0.25;  // in which a first-person eye comes after the hand

}  // namespace

void CameraRig::look(draw::View view, const Vec3& center, double radius_m) {
  view_ = view;
  follows_.reset();
  orbit_ = draw::framed(view, center, radius_m);
  if (view == draw::View::three_quarter) orbit_.elevation_rad = kThreeQuarter_rad;
}

void CameraRig::orbit(double moved_x, double moved_y) {
  if (view_ == draw::View::first_person) return;
  orbit_.azimuth_rad -= kRadiansPerPixel * moved_x;
  orbit_.elevation_rad =
      std::clamp(orbit_.elevation_rad + kRadiansPerPixel * moved_y, -kSteepest_rad, kSteepest_rad);
}

void CameraRig::pan(double moved_x, double moved_y, int viewport_height) {
  if (view_ == draw::View::first_person) return;
  const double per_pixel =
      2.0 * orbit_.distance_m * std::tan(0.5 * orbit_.vertical_view_rad) / viewport_height;
  const Quat turned = orbit_.camera(1.0).pose.rotation;
  orbit_.target += per_pixel * (turned * Vec3(-moved_x, moved_y, 0.0));
}

void CameraRig::zoom(double notches) {
  orbit_.distance_m =
      std::clamp(orbit_.distance_m * std::pow(kZoomPerNotch, notches), kNearest_m, kFarthest_m);
}

draw::Camera CameraRig::camera(const Viewport& viewport, const std::optional<HandPose>& hand,
                               double step_s) {
  if (view_ != draw::View::first_person || !hand) {
    if (view_ != draw::View::first_person) return orbit_.camera(viewport.aspect());
    draw::Camera camera = orbit_.camera(viewport.aspect());
    if (follows_) camera.pose = *follows_;
    return camera;
  }
  draw::Camera camera = draw::first_person(*hand, viewport.aspect());
  if (follows_) {
    const double share = 1.0 - std::exp(-step_s / kFollow_s);
    camera.pose = {follows_->position + share * (camera.pose.position - follows_->position),
                   follows_->rotation.slerp(share, camera.pose.rotation)};
  }
  follows_ = camera.pose;
  return camera;
}

Ray ray_through(const draw::Camera& camera, const Viewport& viewport, double x, double y) {
  const auto mix = [](double a, double b, double share) { return a + share * (b - a); };
  const double across = (x + 0.5 - viewport.x) / viewport.width;
  const double down = (y + 0.5 - viewport.y) / viewport.height;
  const Vec3 in_eye(mix(std::tan(camera.view.left), std::tan(camera.view.right), across),
                    mix(std::tan(camera.view.up), std::tan(camera.view.down), down), -1.0);
  Ray ray;
  ray.origin = camera.pose.position;
  ray.direction = camera.pose.rotation * in_eye.normalized();
  return ray;
}

}  // namespace nade::viewer
