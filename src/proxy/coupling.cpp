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

void add_joint_springs(const JointVectors& places, double stiffness, const PosedHand& posed,
                       Springs& springs) noexcept {
  // Every joint's spring is as stiff in every direction, so most of the products are sums of cross
  // products: a shift of the wrist meets every joint alike, a turn w takes one at r along w x r.
  Vec3 sum = Vec3::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const JointMotion motion = motion_of(posed, i);
    const Vec3& reach = motion.reach;
    const Vec3 force = stiffness * (places[i] - posed.hand.joints[i].position);
    sum += reach;
    squares += reach * reach.transpose();
    springs.force.head<3>() += force;
    springs.force.segment<3>(3) += reach.cross(force);
    const std::array<Vec3, kDigitFreedoms>& bends = motion.with_bend;
    for (std::size_t f = 0; f < motion.bends; ++f) {
      const auto column = static_cast<Eigen::Index>(f);
      springs.force[first_freedom(motion.digit) + column] += bends[f].dot(force);
      auto coupling = springs.stiffness.coupling[motion.digit].col(column);
      coupling.head<3>() += stiffness * bends[f];
      coupling.tail<3>() += stiffness * reach.cross(bends[f]);
      for (std::size_t g = 0; g <= f; ++g) {
        const auto row = static_cast<Eigen::Index>(g);
        const double product = stiffness * bends[g].dot(bends[f]);
        springs.stiffness.digit[motion.digit](row, column) += product;
        if (g != f) springs.stiffness.digit[motion.digit](column, row) += product;
      }
    }
  }
  Eigen::Matrix<double, 6, 6>& wrist = springs.stiffness.wrist;
  Eigen::Matrix3d crossed;
  crossed << 0.0, sum.z(), -sum.y(), -sum.z(), 0.0, sum.x(), sum.y(), -sum.x(), 0.0;
  wrist.topLeftCorner<3, 3>().diagonal().array() += stiffness * kJointCount;
  wrist.topRightCorner<3, 3>() += stiffness * crossed;
  wrist.bottomLeftCorner<3, 3>() += stiffness * crossed.transpose();
  wrist.bottomRightCorner<3, 3>() +=
      stiffness * (squares.trace() * Eigen::Matrix3d::Identity() - squares);
}

void add_bend_springs(const ProxyTuning& tuning, const Correction& now, double firmness,
                      Springs& springs) noexcept {
  HandFreedoms stiffness = HandFreedoms::Zero();
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    auto digit = stiffness.segment<4>(first_freedom(d));
    if (digit_at(d) == Digit::thumb) {
      digit.setConstant(tuning.knuckle_stiffness);
    } else {
      digit << kAsideHarder * tuning.finger_stiffness, tuning.knuckle_stiffness,
          tuning.finger_stiffness, tuning.finger_stiffness;
    }
  }
  springs.add(firmness * stiffness, -step_between({}, now));
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
  const Eigen::Matrix3d damper = tuning.place_stiffness * tuning.slide_time_s / seconds * along;
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
