#pragma once

#include <array>

#include "hand/freedoms.h"

namespace nade {

/// A symmetric matrix over the hand's freedoms in which every digit is coupled to the wrist and to
/// no other digit.
struct ArrowMatrix {
  Eigen::Matrix<double, 6, 6> wrist = Eigen::Matrix<double, 6, 6>::Zero();
  std::array<Eigen::Matrix<double, 6, 4>, kDigitCount> coupling;
  std::array<Eigen::Matrix4d, kDigitCount> digit;

  ArrowMatrix();

  void add_diagonal(const HandFreedoms& diagonal) noexcept;
  /// Adds `stiffness` times the square of what a row says of a step.
  void add(const ContactRow& row, double stiffness) noexcept;

  [[nodiscard]] HandFreedoms times(const HandFreedoms& step) const noexcept;
  /// What this matrix times gives `right`. It has to be positive definite.
  [[nodiscard]] HandFreedoms solve(const HandFreedoms& right) const noexcept;
};

}  // namespace nade
