#pragma once

#include <span>

#include "nade/settle.h"

namespace nade {

/// The hand's freedoms: shift and turn of the wrist, then four bends a digit.
inline constexpr Eigen::Index kHandFreedoms = 6 + 4 * 5;
using HandFreedoms = Eigen::Matrix<double, kHandFreedoms, 1>;
[[nodiscard]] constexpr Eigen::Index first_freedom(std::size_t digit) {
  return 6 + 4 * static_cast<Eigen::Index>(digit);
}

/// A spring on every freedom: it costs half of stiffness times the square of `from` plus the step.
struct Springs {
  HandFreedoms stiffness = HandFreedoms::Zero();
  HandFreedoms from = HandFreedoms::Zero();
};

/// A wall on both sides of every freedom's step, as stiff as said. low <= high.
struct Walls {
  HandFreedoms low = HandFreedoms::Zero();
  HandFreedoms high = HandFreedoms::Zero();
  HandFreedoms stiffness = HandFreedoms::Zero();
};

/// Springs against walls, and rows that push where their gap is below 0 or pull where it is above.
struct SettleProblem {
  Springs back;     ///< to the tracked pose
  Springs viscous;  ///< to the last frame's correction
  Walls range;      ///< of motion
  Walls rate;       ///< of change
  std::span<const ContactRow> rows;
};

/// The stiffness of a surface, as the rows see it: 1/m^2 for a cost of 1 a radian squared.
inline constexpr double kSurfaceStiffness = 4e6;

/// The step of least cost: a convex problem, so there is one. Newton's method on a piecewise
/// quadratic, a fixed number of steps at the most.
[[nodiscard]] HandFreedoms least_cost_step(const SettleProblem& problem) noexcept;

/// The gap of a row after a step.
[[nodiscard]] double gap_after(const ContactRow& row, const HandFreedoms& step) noexcept;

}  // namespace nade
