#pragma once

#include <vector>

#include "hand/posed_hand.h"
#include "state.h"
#include "tuning.h"

namespace nade {

// What the correction adds to the person's motion has inertia, and a bound.

/// Where the drawn joints are if each keeps its way from the tracked one, but for `moved`, and the
/// velocity of that, which fades with `offset_time_s`. A hand that is pressed in rests on the
/// object: it leaves the surface no sooner than by its own velocity, however the person's goes.
[[nodiscard]] JointVectors coasted_joints(const ProxyTuning& tuning, const ProxyState& state,
                                          const HandPose& tracked, const Vec3& moved,
                                          double seconds) noexcept;

/// Adds terms that hold back what a step would take farther from the last frame's hand than
/// `most_m`: the wrist, and of each digit the joint that goes farthest. `next` is the hand after
/// the step, `posed` before it. Says whether there are any.
[[nodiscard]] bool hold_back(const HandPose& last, const HandPose& next, double most_m,
                             const PosedHand& posed, const HandFreedoms& step,
                             std::vector<ContactTerm>& terms) noexcept;

}  // namespace nade
