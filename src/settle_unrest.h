#pragma once

#include "nade/settle.h"
#include "posed_hand.h"
#include "touch_finder.h"

namespace nade {

// How much more strongly than a calm hand a restless one may be drawn to the surface.

/// Of a hand that was not seen before.
[[nodiscard]] Unrest no_unrest() noexcept;

/// Takes in a frame of the tracked hand, `seconds` after the last, as seen from home and from the
/// object. What repeats the last sample, or comes at once after it, says nothing; a motion is not
/// followed over a gap.
void follow_unrest(const HandPose& from_home, const HandPose& from_object, double seconds,
                   Unrest& unrest) noexcept;

/// How long a frame counts that came so long after the last: as long as all do, where only their
/// times are uneven; a millisecond at the least, and 50 at the most.
[[nodiscard]] double frame_seconds(double seconds, const Unrest& unrest) noexcept;
/// After a jump: what is known of the hand's unrest stays, its motion starts anew.
void break_motion(Unrest& unrest) noexcept;

/// How the tracked fingers are curled.
[[nodiscard]] FingerCurls curls_of(const HandModel& model) noexcept;

/// `curls` and `at_touch` are how the tracked fingers are curled, and were when the hand touched.
[[nodiscard]] PullStrengths pull_strengths(const Unrest& unrest, const FingerCurls& curls,
                                           const FingerCurls& at_touch) noexcept;

}  // namespace nade
