#include "mouse_hand.h"

#include <algorithm>
#include <cmath>
#include <numbers>

// Based on: Casiez, Roussel and Vogel. 1 Euro Filter: A Simple Speed-based Low-pass Filter for
// Noisy Input in Interactive Systems. 2012.

namespace nade::viewer {
namespace {

constexpr double kSlowest_hz = 5.0;      // cut-off of a hand at rest: steadies single pixels
constexpr double kHzPerSpeed = 60.0;     // and how it rises, so that a stroke hardly lags
constexpr double kSpeedCutoff_hz = 4.0;  // of the speed that decides
constexpr double kFastestSpeed = 2.5;    // m/s: over a silhouette the goal leaps, a hand does not
constexpr double kNormal_s = 0.05;       // time in which the hand turns with the surface
constexpr double kHeading_s = 0.12;
constexpr double kMotionHeading_s = 0.35;
/// One's hand comes from one's side, not from one's middle.
constexpr double kInward_rad = 30.0 * kDegree;
constexpr double kMovingSpeed = 0.04;  // m/s: slower than this has no direction
constexpr double kHold_s = 0.045;      // time in which wheel and keys take effect
constexpr double kNear_m = 0.5;        // how far the surface is looked for
constexpr double kLetGo_m = 0.03;      // so far off the surface the hand presses no more

/// The share of the way that a first-order filter goes in a step.
double share_of(double step_s, double time_constant_s) {
  return 1.0 - std::exp(-step_s / time_constant_s);
}

double time_constant(double cutoff_hz) { return 1.0 / (2.0 * std::numbers::pi * cutoff_hz); }

void approach(double& value, double goal, double share) { value += share * (goal - value); }

}  // namespace

MouseHand::MouseHand(const HandPose& relaxed)
    : relaxed_(relaxed), hand_(relaxed, settings_.side, 1.0) {}

void MouseHand::place(const Object& object, const Pose& place) {
  hint_ = {};
  goal_ = {place.position, 0.0};
  point_ = place.position;
  velocity_ = Vec3::Zero();
  off_m_ = 0.0;
  normal_ = broad_normal(object, place.position, place.rotation * Vec3::UnitY());
  surface_point_ = place.position;
  ahead_ = along_surface(place.rotation * -Vec3::UnitZ(), normal_).normalized();
  held_ = settings_;
  settled_ = false;
}

HandPose MouseHand::update(const Object& object, const Aim& aim, double step_s) {
  find_goal(object, aim);
  follow(step_s);
  lie_on(object, step_s);
  take_heading(aim, step_s);
  hold(step_s);
  Eigen::Matrix3d axes;
  axes << ahead_.cross(normal_), normal_, -ahead_;
  const Quat turned = Quat(axes) * Quat(Eigen::AngleAxisd(held_.turn_rad, Vec3::UnitY())) *
                      Quat(Eigen::AngleAxisd(held_.tilt_rad, Vec3::UnitX())) *
                      Quat(Eigen::AngleAxisd(held_.roll_rad, Vec3::UnitZ()));
  const double pressing = std::clamp(1.0 - off_m_ / kLetGo_m, 0.0, 1.0);
  const double depth_m = held_.depth_m > 0.0 ? pressing * held_.depth_m : held_.depth_m;
  const Vec3 skin = surface_point_ + (off_m_ - depth_m) * normal_;
  return moved(hand_.posed(held_.shape), hand_.palm_at(skin, turned.normalized()));
}

void MouseHand::find_goal(const Object& object, const Aim& aim) {
  if (!aim.ray) {
    goal_.point += aim.nudge_world;
    const auto nearest = object.closest_point(goal_.point, kNear_m, hint_);
    if (nearest && goal_.off_m == 0.0) goal_.point = nearest->point;
    return;
  }
  if (const auto hit = object.first_hit(*aim.ray)) {
    goal_ = {hit->point, 0.0};
    return;
  }
  // Beside the object: as far away as it was when it was last over it.
  const double along = aim.ray->direction.dot(aim.viewer_ahead);
  if (along < 1e-3) return;
  const double away = (goal_.point - aim.ray->origin).dot(aim.viewer_ahead) / along;
  const Vec3 point = aim.ray->origin + away * aim.ray->direction;
  const auto nearest = object.closest_point(point, kNear_m, hint_);
  if (nearest) goal_ = {point, std::max(0.0, nearest->signed_distance)};
}

void MouseHand::follow(double step_s) {
  const Vec3 wanted = (goal_.point - point_) / step_s;
  velocity_ += share_of(step_s, time_constant(kSpeedCutoff_hz)) * (wanted - velocity_);
  const double cutoff_hz = kSlowest_hz + kHzPerSpeed * velocity_.norm();
  const double share = share_of(step_s, time_constant(cutoff_hz));
  Vec3 step = share * (goal_.point - point_);
  const double longest = kFastestSpeed * step_s;
  if (step.norm() > longest) step *= longest / step.norm();
  point_ += step;
  approach(off_m_, goal_.off_m, share);
}

void MouseHand::lie_on(const Object& object, double step_s) {
  const auto nearest = object.closest_point(point_, kNear_m, hint_);
  if (!nearest) return;
  surface_point_ = nearest->point;
  const Vec3 lies = broad_normal(object, nearest->point, nearest->normal);
  const Vec3 turned = normal_ + share_of(step_s, kNormal_s) * (lies - normal_);
  normal_ = turned.norm() > 0.1 ? Vec3(turned.normalized()) : lies;
}

void MouseHand::take_heading(const Aim& aim, double step_s) {
  const bool by_motion = settings_.heading == Heading::with_motion;
  const Vec3 wish = by_motion ? velocity_ : Vec3(aim.viewer_ahead + aim.viewer_up);
  const double inward_rad = settings_.side == Handedness::right ? kInward_rad : -kInward_rad;
  const Vec3 goal =
      Quat(Eigen::AngleAxisd(by_motion ? 0.0 : inward_rad, normal_)) * along_surface(wish, normal_);
  const Vec3 kept = along_surface(ahead_, normal_);
  ahead_ = kept.norm() > 1e-3 ? Vec3(kept.normalized()) : Vec3(normal_.unitOrthogonal());
  if (goal.norm() < (by_motion ? kMovingSpeed : 0.1)) return;
  const double away = std::atan2(ahead_.cross(goal).dot(normal_), ahead_.dot(goal));
  const double share = settled_ ? share_of(step_s, by_motion ? kMotionHeading_s : kHeading_s) : 1.0;
  settled_ = true;
  ahead_ = Quat(Eigen::AngleAxisd(share * away, normal_)) * ahead_;
  ahead_ = along_surface(ahead_, normal_).normalized();
}

void MouseHand::hold(double step_s) {
  if (held_.side != settings_.side) hand_ = PosableHand(relaxed_, settings_.side, 1.0);
  const double share = share_of(step_s, kHold_s);
  MouseHandSettings now = settings_;
  now.depth_m = held_.depth_m;
  now.turn_rad = held_.turn_rad;
  now.tilt_rad = held_.tilt_rad;
  now.roll_rad = held_.roll_rad;
  now.shape = held_.shape;
  approach(now.depth_m, settings_.depth_m, share);
  approach(now.turn_rad, settings_.turn_rad, share);
  approach(now.tilt_rad, settings_.tilt_rad, share);
  approach(now.roll_rad, settings_.roll_rad, share);
  approach(now.shape.curl, settings_.shape.curl, share);
  approach(now.shape.spread, settings_.shape.spread, share);
  held_ = now;
}

}  // namespace nade::viewer
