#include "settle_slide.h"

#include <algorithm>

#include "ramps.h"

namespace nade {
namespace {

/// A hand that friction holds back or lets slip takes about this time for it.
constexpr double kLagTime_s = 0.2;

/// Friction: what was stroked along the surface stays behind, up to a bound; then it slips, and
/// catches up no faster than the hand strokes.
void rub(const Vec3& stroked, const Vec3& normal, const VisibleFriction& friction,
         ContactState& contact) {
  const double stick_m =
      std::min(friction.coefficient * std::max(contact.height_m, 0.0), friction.longest_lag_m);
  const double slide_m = friction.kinetic * stick_m;
  const double before_m = contact.lag.norm();
  Vec3 lag = along_surface(contact.lag, normal) - stroked;
  if (lag.norm() > stick_m) contact.slips = true;
  if (contact.slips) {
    lag = shortened(lag, std::max(slide_m, before_m - stroked.norm()));
    if (lag.norm() <= slide_m) contact.slips = false;
  }
  contact.lag = shortened(lag, stick_m);
}

}  // namespace

void remember_slide(const Vec3& shift, const Vec3& stroked, const Vec3& normal,
                    const VisibleFriction& friction, ContactState& contact) noexcept {
  const Vec3 offset = contact.carried + contact.normal.dot(shift) * contact.normal;
  contact.carried = shortened(along_surface(offset, normal), std::max(0.0, normal.dot(shift)));
  rub(stroked, normal, friction, contact);
}

void forget_slide(ContactState& contact) noexcept {
  contact.carried = contact.lag = contact.drawn_lag = Vec3::Zero();
  contact.slips = false;
}

Vec3 follow_lag(double seconds, ContactState& contact) noexcept {
  const double share = followed(seconds, kLagTime_s);
  const Vec3 change = share * (contact.lag - contact.drawn_lag);
  contact.drawn_lag += change;
  return change;
}

}  // namespace nade
