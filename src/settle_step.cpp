#include "settle_step.h"

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

Eigen::Matrix3d surface_frame(const Vec3& normal, const Quat& palm) noexcept {
  const Vec3 ahead = palm * -Vec3::UnitZ();
  const Vec3 along = along_surface(ahead, normal);
  if (normal.isZero() || along.norm() < 1e-6) return palm.toRotationMatrix();
  Eigen::Matrix3d frame;
  frame.col(0) = along.normalized();
  frame.col(1) = normal.cross(frame.col(0));
  frame.col(2) = normal;
  return frame;
}

HandFreedoms step_between(const Correction& from, const Correction& to,
                          const Eigen::Matrix3d& frame) noexcept {
  HandFreedoms step;
  step.head<3>() = frame.transpose() * (to.palm.shift - from.palm.shift);
  step.segment<3>(3) =
      frame.transpose() * rotation_vector(to.palm.turn * from.palm.turn.conjugate());
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    step.segment<4>(first_freedom(d)) = to.bend[d] - from.bend[d];
  }
  return step;
}

Correction after_step(const Correction& from, const HandFreedoms& step,
                      const Eigen::Matrix3d& frame,
                      const std::array<BendRange, kDigitCount>& ranges) noexcept {
  Correction to;
  to.palm.shift = from.palm.shift + frame * step.head<3>();
  to.palm.turn = (turn_about(frame * step.segment<3>(3)) * from.palm.turn).normalized();
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

HandFreedoms steps_of(double shift_m, double turn_m, double bend_m) noexcept {
  HandFreedoms steps = HandFreedoms::Constant(bend_m / kBendLever_m);
  steps.head<3>().setConstant(shift_m);
  steps.segment<3>(3).setConstant(turn_m / kTurnLever_m);
  return steps;
}

}  // namespace nade
