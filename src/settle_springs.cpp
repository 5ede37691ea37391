#include "settle_springs.h"

#include <cmath>

namespace nade {
namespace {

// A shift of 19 mm costs as much as bending a finger at its knuckle by a radian.
constexpr double kShiftStiffness = 1.0 / (0.018 * 0.018);
constexpr double kTurnStiffness = 7.5217;
/// About the surface's normal: the heading is the person's own.
constexpr double kSpinStiffness = 24.007;
/// Base abduction, base, middle and last flexion. A finger pushed from below gives way at its
/// knuckle and keeps its curl; a thumb gives way as a whole.
const DigitFreedoms kFingerStiffness{9.0, 1.1, 7.9, 7.1};
const DigitFreedoms kThumbStiffness{1.6, 1.6, 3.2, 3.2};
/// From about here on a spring pulls with the same force (pseudo-Huber).
constexpr double kFarShift_m = 0.029419;
constexpr double kFarTurn_rad = 0.56073;

/// In the air the springs of turns and bends are so many times as stiff.
constexpr double kStifferInAir = 2.0;

/// Turns and bends follow with this time constant.
constexpr double kViscosity_s = 0.051082;
/// And shifts along the surface with this: there the hand moves as the person's does.
constexpr double kSlideTime_s = 45.0;
/// A shift of this and so many heights of the press has strayed: it comes back in half that time,
/// a longer one far sooner. Circles on a ball would else lead the hand round it.
constexpr double kStray_m = 0.02;
constexpr double kStrayOfHeight = 2.0;
/// In the air, all of a correction goes with this.
constexpr double kReleaseTime_s = 0.095791;

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

HandFreedoms stiffness_in_air(const HandFreedoms& away) noexcept {
  HandFreedoms stiffness = stiffness_of_pose(away);
  stiffness.tail<kHandFreedoms - 3>() *= kStifferInAir;
  return stiffness;
}

HandFreedoms damping(const HandFreedoms& away, double height_m) noexcept {
  const double strays = away.head<2>().norm() / (kStray_m + kStrayOfHeight * height_m);
  const double slide_s =
      kSlideTime_s * slackened(away.head<3>().norm() / kFarShift_m) / (1.0 + std::pow(strays, 4));
  HandFreedoms time_s = HandFreedoms::Constant(kViscosity_s);
  time_s.head<3>() << slide_s, slide_s, 0.0;  // out of the object at once
  return stiffness_of_pose(HandFreedoms::Zero()).cwiseProduct(time_s);
}

HandFreedoms damping_in_air() noexcept {
  return kReleaseTime_s * stiffness_of_pose(HandFreedoms::Zero());
}

}  // namespace nade
