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
/// It is on its way out, and not held up, until it has been clear for so long.
constexpr double kOnItsWay_s = 0.1;
/// What is held up so long, with a joint farther off than this, is let go. A hand that is pressed
/// 80 mm deep through a thin board or bowl is not: it has 126 mm at the most.
constexpr double kPatience_s = 1.0;
constexpr double kStuck_m = 0.13;

/// How far a pad's middle is out of the object.
double out_by(const TouchSearch& search, const PosedFlesh& flesh, std::size_t pad,
              const SettleMemory& memory) {
  SurfaceHint hint = memory.pads[pad].hint;
  const Vec3 middle = flesh.position(search.flesh.pads[pad].middle);
  const auto nearest = search.object.closest_point(middle, kDeepest_m, hint);
  return nearest ? nearest->signed_distance : kDeepest_m;
}

bool is_drawn_clear(const TouchSearch& search, const SettleMemory& memory) {
  const PosedFlesh drawn = pose_flesh(memory.last.drawn, search.scale);
  for (std::size_t pad = 0; pad < memory.pads.size(); ++pad) {
    if (out_by(search, drawn, pad, memory) <= kClear_m) return false;
  }
  return true;
}

/// It is asked again and again: where the last look ended comes first, and what was far out is
/// looked at when it may have come back.
bool is_tracked_clear(const TouchSearch& search, SettleMemory& memory) {
  const std::size_t pads = memory.pads.size();
  for (std::size_t i = 0; i < pads; ++i) {
    const std::size_t pad = (memory.last_inside + i) % pads;
    if (memory.way_m < memory.pads[pad].out_until_m) continue;
    const double to_spare_m = out_by(search, search.tracked, pad, memory) - kClear_m;
    memory.pads[pad].out_until_m = memory.way_m + to_spare_m;
    if (to_spare_m > 0.0) continue;
    memory.last_inside = pad;
    return false;
  }
  return true;
}

}  // namespace

void follow_leaving(const TouchSearch& search, SettleMemory& memory) noexcept {
  const double away_m = largest_motion(memory.last.drawn, *memory.last.tracked);
  if (memory.let_go) {
    const bool back = away_m < kFar_m && is_drawn_clear(search, memory);
    memory.let_go = !back && !is_none(memory.last.correction);
    return;
  }
  const bool held_up = !memory.push.isZero() && (memory.clear_s || away_m > kFar_m);
  if (!held_up || !is_tracked_clear(search, memory)) {
    memory.clear_s.reset();
    return;
  }
  const double before_s = memory.clear_s.value_or(-kOnItsWay_s);
  memory.clear_s = before_s < 0.0 || away_m > kStuck_m ? before_s + search.seconds
                                                       : std::max(0.0, before_s - search.seconds);
  if (*memory.clear_s < kPatience_s) return;
  memory.let_go = true;
  forget_planes(memory);
}

}  // namespace nade
