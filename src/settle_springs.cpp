#include "settle_springs.h"

#include <cmath>

namespace nade {
namespace {

// A shift of 19 mm costs as much as bending a finger at its knuckle by a radian.
constexpr double kShiftStiffness = 1.0 / (0.018 * 0.018);
constexpr double kTurnStiffness = 6.9;
/// About the surface's normal: the heading is the person's own.
constexpr double kSpinStiffness = 32.0;
/// Base abduction, base, middle and last flexion. A finger pushed from below gives way at its
/// knuckle and keeps its curl; a thumb gives way as a whole.
const DigitFreedoms kFingerStiffness{9.0, 1.1, 7.9, 7.1};
const DigitFreedoms kThumbStiffness{1.6, 1.6, 3.2, 3.2};
/// From about here on a spring pulls with the same force (pseudo-Huber).
constexpr double kFarShift_m = 0.03;
constexpr double kFarTurn_rad = 0.6;

/// Turns and bends follow with this time constant.
constexpr double kViscosity_s = 0.0506;
/// And shifts along the surface with this: there the hand moves as the person's does.
constexpr double kSlideTime_s = 30.0;
/// Over an edge what was depth on one face is astray on the other: there it goes with this.
constexpr double kEdgeSlideTime_s = 0.436;
/// In the air, all of a correction goes with this.
constexpr double kReleaseTime_s = 0.0812;

/// The share that is left of a spring's stiffness, by the way over that where it is far.
double slackened(double way) { return 1.0 / std::sqrt(1.0 + way * way); }

}  // namespace

HandFreedoms stiffness_of_pose(const HandFreedoms& away) noexcept {
  HandFreedoms stiffness;
  stiffness.head<3>().setConstant(kShiftStiffness);
  stiffness.segment<3>(3) << kTurnStiffness, kTurnStiffness, kSpinStiffness;
  stiffness.head<3>() *= slackened(away.head<3>().norm() / kFarShift_m);
  stiffness.segment<3>(3) *= slackened(away.segment<3>(3).norm() / kFarTurn_rad);
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    stiffness.segment<4>(first_freedom(d)) =
        digit_at(d) == Digit::thumb ? kThumbStiffness : kFingerStiffness;
  }
  return stiffness;
}

HandFreedoms damping(double edge) noexcept {
  const double slide_hz = (1.0 - edge) / kSlideTime_s + edge / kEdgeSlideTime_s;
  HandFreedoms time_s = HandFreedoms::Constant(kViscosity_s);
  time_s.head<3>() << 1.0 / slide_hz, 1.0 / slide_hz, 0.0;  // out of the object at once
  return stiffness_of_pose(HandFreedoms::Zero()).cwiseProduct(time_s);
}

HandFreedoms damping_in_air() noexcept {
  return kReleaseTime_s * stiffness_of_pose(HandFreedoms::Zero());
}

}  // namespace nade
