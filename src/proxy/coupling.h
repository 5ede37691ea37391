#pragma once

#include "contact_finder.h"
#include "hand/posed_hand.h"
#include "solver.h"
#include "tuning.h"

namespace nade {

// What ties the drawn hand to the tracked pose.

/// The range of motion, with a finger's base bent back no farther than 25 degrees, or than the
/// person's own.
void limit_back_bend(HandModel& model) noexcept;

/// Springs from the correction `now` to none, `firmness` times as stiff as tuned, but for `lag`, by
/// which friction holds back the palm.
void add_coupling(const ProxyTuning& tuning, const Correction& now, const Vec3& lag,
                  double firmness, Springs& springs) noexcept;

/// A palm that is pressed, and about parallel to what it is pressed to, keeps its attitude: a
/// spring against turns about axes in the surface.
void add_seat(const ProxyTuning& tuning, const Correction& now, const Pose& tracked_palm,
              const PalmTouch& palm, Springs& springs) noexcept;

/// Along the surface the hand goes as the person's does: a damper on the shift since the last
/// frame, `shifted`, but for what friction wants.
void add_slide(const ProxyTuning& tuning, const Vec3& normal, const Vec3& shifted, double seconds,
               Springs& springs) noexcept;

/// How far a step may go from the correction `now`.
[[nodiscard]] StepRange step_range(const HandModel& model, const Correction& now) noexcept;

}  // namespace nade
