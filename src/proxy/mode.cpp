#include "mode.h"

#include <algorithm>

#include "hand/step.h"
#include "nade/correction.h"
#include "ramps.h"

namespace nade {
namespace {

/// A drawn hand is far from the tracked one where a joint is farther than this: what leaves the
/// object as it came does not count.
constexpr double kFar_m = 0.02;
/// The tracked hand is clear where the middles of all its pads are so far out.
constexpr double kClearOfObject_m = 0.007;
/// A hand that has been clear for so long is blocked, and then for so long is let go. Shorter, it
/// may be on its way out.
constexpr double kBlocked_s = 0.08;
constexpr double kLetGo_s = 0.16;
/// It presses elsewhere, as on the table that the thing stands on before which the drawn one was
/// left, where it is no deeper than this share of how far off the drawn one is; which is farther
/// off than a hand that is pressed 80 mm deep through a thin board, and waited for so long.
constexpr double kShallow = 0.25;
constexpr double kElsewhere_m = 0.13;
constexpr double kPatience_s = 0.3;
/// Another object throws a hand that goes farther at once, besides so many times its own motion.
constexpr double kThrown_m = 0.005;
constexpr double kThrownOfMotion = 3.0;

/// How far a pad of the tracked hand is out of the object, in the middle.
double out_by(const ContactSearch& search, std::size_t pad, const ProxyState& state) {
  SurfaceHint hint = state.pads[pad].hint;
  const Vec3 middle = search.tracked.position(search.flesh.pads[pad].middle);
  const auto nearest = search.object.closest_point(middle, kDeepest_m, hint);
  return nearest ? nearest->signed_distance : kDeepest_m;
}

/// Whether all of the tracked hand is so far out; below 0, whether no more than that inside. It is
/// asked again and again: where the last look ended comes first, and what has to spare is looked
/// at when that may be gone.
bool is_tracked_out(const ContactSearch& search, double out_m, ProxyState& state) {
  const std::size_t pads = state.pads.size();
  for (std::size_t i = 0; i < pads; ++i) {
    const std::size_t pad = (state.last_inside + i) % pads;
    double& out_until_m = state.pads[pad].out_until_m;
    if (state.way_m + out_m < out_until_m) continue;
    out_until_m = state.way_m + out_by(search, pad, state);
    if (state.way_m + out_m < out_until_m) continue;
    state.last_inside = pad;
    return false;
  }
  return true;
}

/// Whether a thin wall is between the tracked palm and the drawn one: it is pressed through.
bool is_pressed_through(const ContactSearch& search, double away_m, const ProxyState& state) {
  const Vec3 from = search.tracked.origin(index_of(Joint::palm));
  const Vec3 way = state.last->drawn[Joint::palm].position - from;
  const double length_m = way.norm();
  if (away_m > kElsewhere_m || length_m == 0.0) return false;
  return search.object.first_hit({from, way / length_m, length_m}).has_value();
}

}  // namespace

bool follow_blocking(const ContactSearch& search, ProxyState& state) noexcept {
  const double away_m = largest_motion(state.last->drawn, state.last->tracked);
  const bool far = state.mode != ProxyMode::free && (state.clear_s > 0.0 || away_m > kFar_m);
  const bool clear = far && is_tracked_out(search, kClearOfObject_m, state) &&
                     !is_pressed_through(search, away_m, state);
  // The farther off the sooner: an object may have been thrown.
  const double sooner = std::max(1.0, away_m / kElsewhere_m);
  state.clear_s = clear ? state.clear_s + sooner * search.seconds : 0.0;
  const bool elsewhere =
      far && !clear && away_m > kElsewhere_m && is_tracked_out(search, -kShallow * away_m, state);
  state.stuck_s = elsewhere ? state.stuck_s + search.seconds : 0.0;
  const bool blocked = elsewhere || state.clear_s > kBlocked_s;
  if (blocked) {
    state.mode = ProxyMode::blocked;
  } else if (state.mode == ProxyMode::blocked) {
    state.mode = ProxyMode::contact;
  }
  return state.clear_s > kLetGo_s || state.stuck_s > kPatience_s;
}

bool is_thrown(const ShownBefore& before, const Correction& now) noexcept {
  return reach_of(step_between(before.correction, now)) >
         kThrown_m + kThrownOfMotion * before.way_m;
}

void start_return(const Correction& from, const Correction& to, double lasts_s,
                  ProxyState& state) noexcept {
  state.returning = {step_between(to, from), 0.0, lasts_s};
}

double follow_return(double seconds, ProxyState& state) noexcept {
  state.returning.elapsed_s += seconds;
  return 1.0 - smoothstep(0.0, state.returning.lasts_s, state.returning.elapsed_s);
}

}  // namespace nade
