#include "arrow_matrix.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace nade {

ArrowMatrix::ArrowMatrix() {
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    coupling[d].setZero();
    digit[d].setZero();
  }
}

void ArrowMatrix::add_diagonal(const HandFreedoms& diagonal) noexcept {
  wrist.diagonal() += diagonal.head<6>();
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    digit[d].diagonal() += diagonal.segment<4>(first_freedom(d));
  }
}

void ArrowMatrix::add(const ContactRow& row, double stiffness) noexcept {
  wrist.noalias() += stiffness * row.wrist * row.wrist.transpose();
  if (!row.digit) return;
  const std::size_t d = index_of(*row.digit);
  coupling[d].noalias() += stiffness * row.wrist * row.bend.transpose();
  digit[d].noalias() += stiffness * row.bend * row.bend.transpose();
}

HandFreedoms ArrowMatrix::times(const HandFreedoms& step) const noexcept {
  HandFreedoms result;
  result.head<6>() = wrist * step.head<6>();
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const Eigen::Vector4d bend = step.segment<4>(first_freedom(d));
    result.head<6>() += coupling[d] * bend;
    result.segment<4>(first_freedom(d)) =
        coupling[d].transpose() * step.head<6>() + digit[d] * bend;
  }
  return result;
}

HandFreedoms ArrowMatrix::solve(const HandFreedoms& right) const noexcept {
  // Eliminates the digits, solves for the wrist, and goes back.
  Eigen::Matrix<double, 6, 6> reduced = wrist;
  Eigen::Matrix<double, 6, 1> wrist_right = right.head<6>();
  std::array<Eigen::Matrix<double, 4, 6>, kDigitCount> inverse_coupling;
  std::array<Eigen::Vector4d, kDigitCount> inverse_right;
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const Eigen::Matrix4d inverse = digit[d].inverse();
    inverse_coupling[d].noalias() = inverse * coupling[d].transpose();
    inverse_right[d].noalias() = inverse * right.segment<4>(first_freedom(d));
    reduced.noalias() -= coupling[d] * inverse_coupling[d];
    wrist_right.noalias() -= coupling[d] * inverse_right[d];
  }
  HandFreedoms result;
  result.head<6>() = reduced.llt().solve(wrist_right);
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    result.segment<4>(first_freedom(d)) = inverse_right[d] - inverse_coupling[d] * result.head<6>();
  }
  return result;
}

}  // namespace nade
