#include "settle_leave.h"

#include <algorithm>

#include "nade/correction.h"
#include "settle_step.h"

namespace nade {
namespace {

/// A drawn hand is far from the tracked one where a joint is farther than this: what leaves the
/// object as it came does not count.
constexpr double kFar_m = 0.04;
/// The tracked hand is clear where all of its flesh is so far out.
constexpr double kClear_m = 0.006;
/// It presses elsewhere, as on the table that the thing stands on before which the drawn one was
/// left, where it is no deeper than this share of how far off the drawn one is.
constexpr double kShallow = 0.25;
/// It is on its way out, and not held up, until it has been clear for so long.
constexpr double kOnItsWay_s = 0.1;
/// What is held up so long, with a joint farther off than this, is let go; sooner, the farther off,
/// and the more hand and object move against each other: a metre counts as so many seconds. A hand
/// that is pressed 80 mm deep through a thin board or bowl is not: it has 126 mm at the most.
constexpr double kPatience_s = 1.0;
constexpr double kStuck_m = 0.13;
constexpr double kPatienceOfWay = 3.0;
/// A hand that presses elsewhere may stroke back to the drawn one: it is waited for, and longer.
constexpr double kPatienceElsewhere_s = 2.0;
/// Another object throws a hand that goes farther at once, besides so many times its own motion.
constexpr double kThrown_m = 0.005;
constexpr double kThrownOfMotion = 3.0;
/// It comes back through the object by up to so many times the tracked hand's motion, and so fast.
constexpr double kReturnOfMotion = 1.8;
constexpr double kReturn_mps = 0.17;
/// Where the person presses again, it is back no later than after this.
constexpr double kReturnToTouch_s = 0.25;

/// How far a pad of the tracked hand is out of the object, in the middle.
double out_by(const TouchSearch& search, std::size_t pad, const SettleMemory& memory) {
  SurfaceHint hint = memory.pads[pad].hint;
  const Vec3 middle = search.tracked.position(search.flesh.pads[pad].middle);
  const auto nearest = search.object.closest_point(middle, kDeepest_m, hint);
  return nearest ? nearest->signed_distance : kDeepest_m;
}

/// Whether all of the tracked hand is so far out; below 0, whether no more than that inside. It is
/// asked again and again: where the last look ended comes first, and what has to spare is looked
/// at when that may be gone.
bool is_tracked_out(const TouchSearch& search, double out_m, SettleMemory& memory) {
  const std::size_t pads = memory.pads.size();
  for (std::size_t i = 0; i < pads; ++i) {
    const std::size_t pad = (memory.last_inside + i) % pads;
    double& out_until_m = memory.pads[pad].out_until_m;
    if (memory.way_m + out_m < out_until_m) continue;
    out_until_m = memory.way_m + out_by(search, pad, memory);
    if (memory.way_m + out_m < out_until_m) continue;
    memory.last_inside = pad;
    return false;
  }
  return true;
}

}  // namespace

bool is_held_up(const SettleMemory& memory) noexcept { return memory.clear_s > kOnItsWay_s; }

bool follow_leaving(const TouchSearch& search, SettleMemory& memory) noexcept {
  const double away_m = largest_motion(memory.last.drawn, *memory.last.tracked);
  const bool far = !memory.contact.push.isZero() && (memory.clear_s > 0.0 || away_m > kFar_m);
  const bool clear = far && is_tracked_out(search, kClear_m, memory);
  memory.clear_s = clear ? memory.clear_s + search.seconds : 0.0;
  const bool elsewhere =
      far && !clear && away_m > kStuck_m && is_tracked_out(search, -kShallow * away_m, memory);
  if (!is_held_up(memory) && !elsewhere) {
    memory.stuck_s = 0.0;
    return false;
  }
  const double passing = elsewhere ? 1.0 : 1.0 + kPatienceOfWay * search.speed_mps;
  const double pace = away_m > kStuck_m ? passing * away_m / kStuck_m : -1.0;
  memory.stuck_s = std::max(0.0, memory.stuck_s + pace * search.seconds);
  return memory.stuck_s > (elsewhere ? kPatienceElsewhere_s : kPatience_s);
}

bool is_thrown(const ShownBefore& before, const Correction& now) noexcept {
  const HandFreedoms step = step_between(before.correction, now, Eigen::Matrix3d::Identity());
  return reach_of(step) > kThrown_m + kThrownOfMotion * before.way_m;
}

void start_return(const Correction& from, const Correction& to, SettleMemory& memory) noexcept {
  memory.returning = step_between(to, from, Eigen::Matrix3d::Identity());
  memory.return_share = 1.0;
}

void follow_return(double motion_m, double seconds, bool pressed, SettleMemory& memory) noexcept {
  if (memory.return_share == 0.0) return;
  const double way_m = kReturnOfMotion * motion_m + kReturn_mps * seconds;
  const double share = way_m / reach_of(memory.returning);
  const double gone = pressed ? std::max(share, seconds / kReturnToTouch_s) : share;
  memory.return_share = std::max(0.0, memory.return_share - gone);
}

}  // namespace nade
