#pragma once

#include "contact_finder.h"
#include "hand/posed_hand.h"
#include "solver.h"
#include "state.h"
#include "tuning.h"

namespace nade {

// What ties the drawn hand to the tracked pose.

/// The range of motion, with a finger's base bent back no farther than 25 degrees, or than the
/// person's own.
void limit_back_bend(HandModel& model) noexcept;

/// Springs as stiff as that, 1/m^2, from every joint of `posed` to its place.
void add_joint_springs(const JointVectors& places, double stiffness, const PosedHand& posed,
                       Springs& springs) noexcept;

/// Springs from the bends of the correction `now` to none, `firmness` times as stiff as tuned.
void add_bend_springs(const ProxyTuning& tuning, const Correction& now, double firmness,
                      Springs& springs) noexcept;

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
