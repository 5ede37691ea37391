#pragma once

#include <array>

#include "nade/settle.h"
#include "posed_hand.h"

namespace nade {

// A correction's changes as steps of the hand's freedoms. `frame` is the one that the wrist's
// shift and turn are counted in.

/// Z along `normal`, X as near as can be to where the hand points; the hand's own axes where there
/// is no normal.
[[nodiscard]] Eigen::Matrix3d surface_frame(const Vec3& normal, const Quat& palm) noexcept;

/// A correction as the step that leads to it from another.
[[nodiscard]] HandFreedoms step_between(const Correction& from, const Correction& to,
                                        const Eigen::Matrix3d& frame) noexcept;

/// And the correction that a step leads to, with every bend inside its range.
[[nodiscard]] Correction after_step(const Correction& from, const HandFreedoms& step,
                                    const Eigen::Matrix3d& frame,
                                    const std::array<BendRange, kDigitCount>& ranges) noexcept;

/// Whether a correction leaves the hand as it is tracked, bit for bit.
[[nodiscard]] bool is_none(const Correction& correction) noexcept;

/// The farthest that any skin goes in a step, about.
[[nodiscard]] double reach_of(const HandFreedoms& step) noexcept;

/// Each freedom's step that takes the hand's farthest skin about so far.
[[nodiscard]] HandFreedoms steps_of(double shift_m, double turn_m, double bend_m) noexcept;

}  // namespace nade
