#include "mode.h"

#include <algorithm>

#include "hand/step.h"
#include "nade/correction.h"
#include "ramps.h"

namespace nade {
namespace {

/// Anatomy: the tracked hand is clear where the middles of all its pads are so far out.
constexpr double kClearOfObject_m = 0.007;
/// A hand that has been clear for this share of `let_go_s` is blocked. Shorter, it may be on its
/// way out. One that presses elsewhere is let go after so many times `return_s`.
constexpr double kBlockedShare = 0.5;
constexpr double kPatience = 1.5;
/// It presses elsewhere, as on the table that the thing stands on before which the drawn one was
/// left, where it is no deeper than this share of how far off the drawn one is.
constexpr double kShallow = 0.25;
/// Numerics: another object throws a hand that goes farther at once, besides so many times its own
/// motion.
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
  if (away_m > search.tuning.elsewhere_m || length_m == 0.0) return false;
  return search.object.first_hit({from, way / length_m, length_m}).has_value();
}

}  // namespace

bool follow_blocking(const ContactSearch& search, ProxyState& state) noexcept {
  const ProxyTuning& tuning = search.tuning;
  const double away_m = largest_motion(state.last->drawn, state.last->tracked);
  // What leaves the object as it came is not far.
  const bool far =
      state.mode != ProxyMode::free && (state.clear_s > 0.0 || away_m > tuning.unnoticed_m);
  const bool clear = far && is_tracked_out(search, kClearOfObject_m, state) &&
                     !is_pressed_through(search, away_m, state);
  // The farther off the sooner: an object may have been thrown.
  const double sooner = std::max(1.0, away_m / tuning.elsewhere_m);
  state.clear_s = clear ? state.clear_s + sooner * search.seconds : 0.0;
  const bool elsewhere = far && !clear && away_m > tuning.elsewhere_m &&
                         is_tracked_out(search, -kShallow * away_m, state);
  state.stuck_s = elsewhere ? state.stuck_s + search.seconds : 0.0;
  const bool blocked = elsewhere || state.clear_s > kBlockedShare * tuning.let_go_s;
  if (blocked) {
    state.mode = ProxyMode::blocked;
  } else if (state.mode == ProxyMode::blocked) {
    state.mode = ProxyMode::contact;
  }
  return state.clear_s > tuning.let_go_s || state.stuck_s > kPatience * tuning.return_s;
}

bool is_thrown(const ShownBefore& before, const Correction& now) noexcept {
  return reach_of(step_between(before.correction, now)) >
         kThrown_m + kThrownOfMotion * before.way_m;
}

void start_return(const Correction& from, const Correction& to, double lasts_s,
                  ProxyState& state) noexcept {
  state.returning = {step_between(to, from), 1.0, 0.0, lasts_s};
}

double follow_return(double seconds, ProxyState& state) noexcept {
  Return& back = state.returning;
  back.elapsed_s += seconds;
  return back.left = 1.0 - smoothstep(0.0, back.lasts_s, back.elapsed_s);
}

ProxyMode mode_after(bool touches, bool pushed, const ProxyState& state) noexcept {
  if (state.returning.left > 0.0) return ProxyMode::returning;
  if (state.mode == ProxyMode::blocked && pushed) return ProxyMode::blocked;
  return touches ? ProxyMode::contact : ProxyMode::free;
}

}  // namespace nade
