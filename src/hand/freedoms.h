#pragma once

#include <array>
#include <optional>

#include "nade/skeleton.h"

namespace nade {

/// The hand's freedoms: shift and turn of the wrist, then four bends a digit.
inline constexpr Eigen::Index kHandFreedoms = 6 + 4 * 5;
using HandFreedoms = Eigen::Matrix<double, kHandFreedoms, 1>;
[[nodiscard]] constexpr Eigen::Index first_freedom(std::size_t digit) {
  return 6 + 4 * static_cast<Eigen::Index>(digit);
}

/// How the gap between a point of the hand and a plane grows with the hand's freedoms.
struct ContactRow {
  Eigen::Matrix<double, 6, 1> wrist = Eigen::Matrix<double, 6, 1>::Zero();  ///< shift, turn
  DigitFreedoms bend = DigitFreedoms::Zero();
  std::optional<Digit> digit;  ///< whose bend counts
  double gap_m = 0.0;          ///< before any step
};

/// The gap of a row after a step.
[[nodiscard]] inline double gap_after(const ContactRow& row, const HandFreedoms& step) noexcept {
  double gap_m = row.gap_m + row.wrist.dot(step.head<6>());
  if (row.digit) gap_m += row.bend.dot(step.segment<4>(first_freedom(index_of(*row.digit))));
  return gap_m;
}

/// One for each joint.
using JointVectors = std::array<Vec3, kJointCount>;

}  // namespace nade
