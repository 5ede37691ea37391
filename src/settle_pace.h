#pragma once

#include <array>
#include <vector>

#include "nade/settle.h"
#include "posed_hand.h"

namespace nade {

// How fast a hand goes from frame to frame. World frame.

/// How far a joint went beyond where it would have gone on from the first two poses, at the most,
/// if the last step took `ratio` times as long as the one before.
[[nodiscard]] double largest_gain(const HandPose& first, const HandPose& second,
                                  const HandPose& third, double ratio) noexcept;

/// Takes a share of each joint's velocity from one pose to the next into a smoothed one, m/s, in
/// the axes of `frame`.
void follow_velocity(const HandPose& from, const HandPose& to, const Quat& frame, double seconds,
                     double share, std::array<Vec3, kJointCount>& velocity) noexcept;

/// Adds rows that hold back what a step would take farther from the last frame's hand than
/// `most_m`: of each digit the joint that goes farthest, and the wrist. `next` is the hand after
/// the step, `posed` before it; `frame` that of the step. Says whether there are any.
bool hold_back(const HandPose& last, const HandPose& next, double most_m, const PosedHand& posed,
               const HandFreedoms& step, const Eigen::Matrix3d& frame,
               std::vector<ContactRow>& rows) noexcept;

}  // namespace nade
