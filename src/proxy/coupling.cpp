#include "coupling.h"

#include <algorithm>
#include <cmath>

#include "hand/step.h"
#include "ramps.h"

namespace nade {
namespace {

/// Anatomy: 25 degrees; farther back a knuckle looks broken.
constexpr double kMostBentBack_rad = 0.44;
/// The seat counts from where the palm is surely pressed, and is whole so many times as deep.
constexpr double kSeatFull = 2.0;
/// A finger goes aside so much harder than it bends: it does not split from the others around a
/// leg.
constexpr double kAsideHarder = 2.0;
/// And likewise with the angle between the palm and the surface: 30 to 10 degrees.
constexpr double kSeatFrom_rad = 0.52;
constexpr double kSeatFull_rad = 0.17;

}  // namespace

void limit_back_bend(HandModel& model) noexcept {
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    if (digit_at(d) == Digit::thumb) continue;
    const double bent_rad = freedoms_of(model.chains[d].angles)[1];
    double& low = model.ranges[d].low[1];
    low = std::max(low, std::min(0.0, -kMostBentBack_rad - bent_rad));
  }
}

void add_coupling(const ProxyTuning& tuning, const Correction& now, const Vec3& lag,
                  double firmness, Springs& springs) noexcept {
  HandFreedoms stiffness;
  stiffness.head<3>().setConstant(tuning.shift_stiffness);
  stiffness.segment<3>(3).setConstant(tuning.turn_stiffness);
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    auto digit = stiffness.segment<4>(first_freedom(d));
    if (digit_at(d) == Digit::thumb) {
      digit.setConstant(tuning.knuckle_stiffness);
    } else {
      digit << kAsideHarder * tuning.finger_stiffness, tuning.knuckle_stiffness,
          tuning.finger_stiffness, tuning.finger_stiffness;
    }
  }
  HandFreedoms away = step_between({}, now);
  away.head<3>() -= lag;
  springs.add(firmness * stiffness, -away);
}

void add_seat(const ProxyTuning& tuning, const Correction& now, const Pose& tracked_palm,
              const PalmTouch& palm, Springs& springs) noexcept {
  if (palm.normal.isZero()) return;
  const Vec3 normal = palm.normal.normalized();
  const double facing = (tracked_palm.rotation * Vec3::UnitY()).dot(normal);
  const double stiffness =
      tuning.seat_stiffness *
      smoothstep(tuning.pressed_m, kSeatFull * tuning.pressed_m, palm.depth_m) *
      smoothstep(std::cos(kSeatFrom_rad), std::cos(kSeatFull_rad), facing);
  if (stiffness == 0.0) return;
  const Eigen::Matrix3d tilt =
      stiffness * (Eigen::Matrix3d::Identity() - normal * normal.transpose());
  springs.stiffness.wrist.bottomRightCorner<3, 3>() += tilt;
  springs.force.segment<3>(3) -= tilt * step_between({}, now).segment<3>(3);
}

void add_slide(const ProxyTuning& tuning, const Vec3& normal, const Vec3& shifted, double seconds,
               Springs& springs) noexcept {
  const Eigen::Matrix3d along = Eigen::Matrix3d::Identity() - normal * normal.transpose();
  const Eigen::Matrix3d damper = tuning.shift_stiffness * tuning.slide_time_s / seconds * along;
  springs.stiffness.wrist.topLeftCorner<3, 3>() += damper;
  springs.force.head<3>() -= damper * shifted;
}

StepRange step_range(const HandModel& model, const Correction& now) noexcept {
  StepRange range;
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    range.low.segment<4>(first_freedom(d)) = model.ranges[d].low - now.bend[d];
    range.high.segment<4>(first_freedom(d)) = model.ranges[d].high - now.bend[d];
  }
  return range;
}

}  // namespace nade
