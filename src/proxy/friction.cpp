#include "friction.h"

#include <algorithm>

#include "ramps.h"

namespace nade {

void remember_stroke(const Vec3& stroked, const VisibleFriction& friction,
                     SurfaceTouch& touch) noexcept {
  // What was stroked stays behind, up to a bound; then the hand slips, and catches up no faster
  // than the person strokes.
  const double stick_m =
      std::min(friction.coefficient * std::max(touch.height_m, 0.0), friction.longest_lag_m);
  const double slide_m = friction.kinetic * stick_m;
  const double before_m = touch.lag.norm();
  Vec3 lag = along_surface(touch.lag, touch.normal) - stroked;
  if (lag.norm() > stick_m) touch.slips = true;
  if (touch.slips) {
    lag = shortened(lag, std::max(slide_m, before_m - stroked.norm()));
    if (lag.norm() <= slide_m) touch.slips = false;
  }
  touch.lag = shortened(lag, stick_m);
}

void forget_stroke(SurfaceTouch& touch) noexcept {
  touch.lag = touch.drawn_lag = Vec3::Zero();
  touch.slips = false;
}

Vec3 follow_lag(double seconds, double constant_s, SurfaceTouch& touch) noexcept {
  const Vec3 change = followed(seconds, constant_s) * (touch.lag - touch.drawn_lag);
  touch.drawn_lag += change;
  return change;
}

}  // namespace nade
