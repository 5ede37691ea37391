#include "panel_touch.h"

#include <algorithm>
#include <cmath>

namespace nade::xr {
namespace {

/// Tip joints lie this deep under the skin where the tracker does not tell.
constexpr double kTipRadius_m = 0.007;
/// The finger has to come so far out before it can press again.
constexpr double kOut_m = 0.012;
/// From there on a finger before the panel is shown its cursor.
constexpr double kNear_m = 0.10;
/// So far off, a hand points with its ray instead.
constexpr double kFar_m = 0.16;
constexpr double kPinchClosed_m = 0.016;
constexpr double kPinchOpen_m = 0.028;
/// An estimate of the shoulder, from the head: the ray goes from it through the knuckle.
constexpr double kShoulderDown_m = 0.20;
constexpr double kShoulderOut_m = 0.16;

bool on_panel(const Vec3& point) {
  return std::abs(point.x()) <= 0.5 * kPanelWidth_m && std::abs(point.y()) <= 0.5 * kPanelHeight_m;
}

Vec3 shoulder_of(const Pose& head, Handedness side) {
  const Vec3 right = head.rotation * Vec3::UnitX();
  const double out = side == Handedness::right ? kShoulderOut_m : -kShoulderOut_m;
  return head.position - kShoulderDown_m * Vec3::UnitY() + out * Vec3(right.x(), 0.0, right.z());
}

}  // namespace

Touch PanelTouch::update(const std::optional<HandPose>& hand, const std::optional<Pose>& head,
                         const Pose& panel, const PanelPicture& picture, bool may_point) {
  Touch touch;
  if (!hand) {
    *this = {};
    return touch;
  }
  poke(*hand, panel, picture, touch);
  if (head && may_point && last_tip_->z() > kFar_m) {
    point(*hand, *head, panel, picture, touch);
  } else {
    open_ = false;
  }
  return touch;
}

void PanelTouch::poke(const HandPose& hand, const Pose& panel, const PanelPicture& picture,
                      Touch& touch) {
  const double told = hand.radius[index_of(Joint::index_tip)];
  const double radius = told > 0.003 && told < 0.015 ? told : kTipRadius_m;
  Vec3 tip = panel.inverse().apply(hand[Joint::index_tip].position);
  tip.z() -= radius;
  if (out_ && last_tip_ && tip.z() <= 0.0) {
    out_ = false;
    const double share = last_tip_->z() / std::max(last_tip_->z() - tip.z(), 1e-9);
    const Vec3 through = *last_tip_ + std::clamp(share, 0.0, 1.0) * (tip - *last_tip_);
    touch.pressed = picture.button_at(through.x(), through.y());
  }
  // In front of the panel, not somewhere beside it: from there nobody means to press.
  if (tip.z() > kOut_m) out_ = true;
  if (tip.z() <= 0.0) out_ = false;
  last_tip_ = tip;
  if (tip.z() < kNear_m && tip.z() > -0.03 && on_panel(tip)) {
    touch.cursor = panel.apply({tip.x(), tip.y(), 0.002});
  }
}

void PanelTouch::point(const HandPose& hand, const Pose& head, const Pose& panel,
                       const PanelPicture& picture, Touch& touch) {
  const Vec3 from = hand[Joint::index_proximal].position;
  const Vec3 ahead = from - shoulder_of(head, hand.side);
  const Pose to_panel = panel.inverse();
  const Vec3 start = to_panel.apply(from);
  const Vec3 direction = to_panel.rotation * ahead;
  if (!(direction.z() < -1e-3)) {
    open_ = false;
    return;
  }
  const Vec3 hit = start - start.z() / direction.z() * direction;
  const double apart = (hand[Joint::thumb_tip].position - hand[Joint::index_tip].position).norm();
  if (on_panel(hit)) {
    touch.cursor = panel.apply({hit.x(), hit.y(), 0.002});
    touch.ray_from = from;
    if (open_ && apart < kPinchClosed_m) touch.pressed = picture.button_at(hit.x(), hit.y());
  }
  if (apart < kPinchClosed_m) open_ = false;
  if (apart > kPinchOpen_m) open_ = true;
}

}  // namespace nade::xr
