#include "step.h"

#include <algorithm>

namespace nade {
namespace {

// How far the hand's farthest skin goes with a turn of the wrist, and with a bend.
constexpr double kTurnLever_m = 0.10;
constexpr double kBendLever_m = 0.07;

Vec3 rotation_vector(const Quat& turn) {
  const Eigen::AngleAxisd angle_axis{turn.w() < 0.0 ? Quat(-turn.coeffs()) : turn};
  return angle_axis.angle() * angle_axis.axis();
}

Quat turn_about(const Vec3& rotation_vector) {
  const double angle = rotation_vector.norm();
  if (angle == 0.0) return Quat::Identity();
  return Quat(Eigen::AngleAxisd(angle, rotation_vector / angle));
}

}  // namespace

HandFreedoms step_between(const Correction& from, const Correction& to) noexcept {
  HandFreedoms step;
  step.head<3>() = to.palm.shift - from.palm.shift;
  step.segment<3>(3) = rotation_vector(to.palm.turn * from.palm.turn.conjugate());
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    step.segment<4>(first_freedom(d)) = to.bend[d] - from.bend[d];
  }
  return step;
}

Correction after_step(const Correction& from, const HandFreedoms& step,
                      const std::array<BendRange, kDigitCount>& ranges) noexcept {
  Correction to;
  to.palm.shift = from.palm.shift + step.head<3>();
  to.palm.turn = (turn_about(step.segment<3>(3)) * from.palm.turn).normalized();
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    to.bend[d] = (from.bend[d] + step.segment<4>(first_freedom(d)))
                     .cwiseMax(ranges[d].low)
                     .cwiseMin(ranges[d].high);
  }
  return to;
}

bool is_none(const Correction& correction) noexcept {
  return correction.palm.shift.isZero(0.0) && correction.palm.turn.vec().isZero(0.0) &&
         std::all_of(correction.bend.begin(), correction.bend.end(),
                     [](const DigitFreedoms& bend) { return bend.isZero(0.0); });
}

double reach_of(const HandFreedoms& step) noexcept {
  return step.head<3>().norm() + kTurnLever_m * step.segment<3>(3).norm() +
         kBendLever_m * step.tail<kHandFreedoms - 6>().cwiseAbs().maxCoeff();
}

}  // namespace nade
