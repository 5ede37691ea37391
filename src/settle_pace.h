#pragma once

#include <array>
#include <vector>

#include "nade/settle.h"
#include "posed_hand.h"
#include "settle_solver.h"

namespace nade {

// How fast a hand goes from frame to frame.

/// Takes a frame, in which the tracked hand went so far, into how still it has kept of late: from 0
/// to 1, at rest.
void follow_rest(double motion_m, double seconds, double& rest) noexcept;

/// How far a correction may change in a frame where nothing pushes, on the surface.
[[nodiscard]] HandFreedoms steps_on_surface(double motion_m, double rest, double seconds) noexcept;

/// How far a joint of the drawn hand goes in a frame at the most: on the surface as far as the
/// tracked hand's fastest, and a little; in the air farther, the farther it is from the tracked one
/// if that keeps still.
[[nodiscard]] double way_on_surface(double motion_m, double rest, double seconds) noexcept;
[[nodiscard]] double way_in_air(double motion_m, double away_m, double seconds) noexcept;

/// Takes a share of each joint's velocity from one pose to the next into a smoothed one, m/s.
void follow_velocity(const HandPose& from, const HandPose& to, double seconds, double share,
                     JointVectors& velocity) noexcept;

/// Takes a frame into how fast the tracked hand went of late straight to the surface or from it, as
/// one does that pats: its fastest joint, by what it went along `normal` more than across.
void follow_strike(const HandPose& from, const HandPose& to, const Vec3& normal, double seconds,
                   double& strike_mps) noexcept;

/// Takes in how the drawn joints went in a frame, and how they came away from the tracked ones; of
/// a jump only as much as a hand can do.
void follow_pace(const SettledFrame& now, double seconds, bool jumped,
                 SettleMemory& memory) noexcept;

/// The object put the hand where it is: it does not go on so.
void forget_drift(SettleMemory& memory) noexcept;

/// Where the drawn joints are if each keeps its way from the tracked one, and what changed of that
/// in the last frame goes on, a little slower. A hand that strikes the object deep rests on it,
/// whatever the person's does: along the surface's normal what keeps still keeps so. Out of the
/// object it takes on the person's speed the sooner.
[[nodiscard]] JointVectors coasted_joints(const SettleMemory& memory, const HandPose& tracked,
                                          const Vec3& normal, double seconds) noexcept;

/// Gives the hand inertia: springs as stiff as that, 1/m^2, from every joint of `posed` to where it
/// would coast to. `frame` is that of the step.
void add_inertia(const JointVectors& coasted, double stiffness, const PosedHand& posed,
                 const Eigen::Matrix3d& frame, Springs& springs) noexcept;

/// Adds rows that hold back what a step would take farther from the last frame's hand than
/// `most_m`: of each digit the joint that goes farthest, and the wrist; so many times as firmly as
/// on a calm hand. `next` is the hand after the step, `posed` before it; `frame` that of the step.
/// Says whether there are any.
bool hold_back(const HandPose& last, const HandPose& next, double most_m, double firmness,
               const PosedHand& posed, const HandFreedoms& step, const Eigen::Matrix3d& frame,
               std::vector<ContactRow>& rows) noexcept;

}  // namespace nade
