#include "settle_pace.h"

#include <algorithm>
#include <cmath>

#include "ramps.h"
#include "settle_jump.h"
#include "settle_leave.h"
#include "settle_step.h"

namespace nade {
namespace {

// How fast a correction may change where nothing pushes: so many times the tracked hand's own
// motion, and a little more, so that a hand at rest is released as well.
constexpr double kShiftRate = 2.0;
constexpr double kTurnRate = 1.0135;
constexpr double kBendRate = 0.646;
constexpr double kFreeRate_mps = 0.0030187;
/// A hand keeps still the more the slower than this it goes.
constexpr double kAtRest_mps = 0.015;
/// Bends go as fast as this at least, the faster the longer the tracked hand keeps still: fingers
/// are not to be seen to sink on long after the person's hand rests. Turns go half as fast.
constexpr double kLeastRate_mps = 0.01;
constexpr double kLeastRateAtRest_mps = 0.03;
constexpr double kRestTime_s = 0.2;
constexpr double kLeastTurn = 0.5;
// In the air nothing is in the way: what is left of a correction goes by up to so many times the
// tracked hand's motion, or so fast. Where that hand keeps still, what is large goes in about
// `kCatchUpTime_s`.
constexpr double kWayInAir = 1.4;
constexpr double kRateInAir_mps = 0.03;
constexpr double kCatchUpTime_s = 0.5;
constexpr double kFastestAtRest_mps = 0.12;

constexpr double kHoldStiffness = 1.5e5;
/// The time constant with which a drawn joint takes on the tracked one's velocity.
constexpr double kCoastTime_s = 0.059194;
/// A hand strikes the object that goes to it so fast, and surely strikes it; of late is within
/// about this time. Its joints take on the tracked ones' velocity with this time constant besides.
constexpr double kStrike_mps = 0.3;
constexpr double kSureStrike_mps = 0.7;
constexpr double kStrikeTime_s = 0.15;
constexpr double kStrikeCoastTime_s = 0.02;
/// From so deep on it rests on the object, and surely rests: those of its drawn joints that go to
/// the surface or from it no faster than this, and surely not so fast.
constexpr double kDeep_m = 0.01;
constexpr double kSurelyDeep_m = 0.04;
constexpr double kStill_mps = 0.1;
constexpr double kNotStill_mps = 0.4;

/// From a tracked joint to the drawn one.
Vec3 offset_of(const SettledFrame& frame, std::size_t joint) {
  return frame.drawn.joints[joint].position - frame.tracked->joints[joint].position;
}

/// How still a hand keeps that goes so far in a frame: 1 at rest.
double rest_of(double motion_m, double seconds) {
  return 1.0 - smoothstep(0.0, kAtRest_mps, motion_m / seconds);
}

/// How far bends may always go on the surface.
double least_way(double rest, double seconds) {
  return seconds * (kLeastRate_mps + rest * (kLeastRateAtRest_mps - kLeastRate_mps));
}

}  // namespace

void follow_rest(double motion_m, double seconds, double& rest) noexcept {
  const double rested = rest + followed(seconds, kRestTime_s) * (1.0 - rest);
  rest = std::min(rest_of(motion_m, seconds), rested);
}

HandFreedoms steps_on_surface(double motion_m, double rest, double seconds) noexcept {
  const double slack_m = kFreeRate_mps * seconds;
  const double least_m = least_way(rest, seconds);
  return steps_of(kShiftRate * motion_m + slack_m,
                  std::max(kTurnRate * motion_m + slack_m, kLeastTurn * least_m),
                  std::max(kBendRate * motion_m + slack_m, least_m));
}

double way_on_surface(double motion_m, double rest, double seconds) noexcept {
  return std::max(motion_m + kFreeRate_mps * seconds, least_way(rest, seconds));
}

double way_in_air(double motion_m, double away_m, double seconds) noexcept {
  const double at_rest_mps =
      std::clamp(away_m / kCatchUpTime_s, kRateInAir_mps, kFastestAtRest_mps);
  const double rest = rest_of(motion_m, seconds);
  const double rate_mps = kRateInAir_mps + rest * (at_rest_mps - kRateInAir_mps);
  return std::max(kWayInAir * motion_m, rate_mps * seconds);
}

void follow_velocity(const HandPose& from, const HandPose& to, double seconds, double share,
                     JointVectors& velocity) noexcept {
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Vec3 way = to.joints[i].position - from.joints[i].position;
    velocity[i] += share * (way / seconds - velocity[i]);
  }
}

void follow_strike(const HandPose& from, const HandPose& to, const Vec3& normal, double seconds,
                   double& strike_mps) noexcept {
  strike_mps *= std::exp(-seconds / kStrikeTime_s);
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Vec3 way = to.joints[i].position - from.joints[i].position;
    const double over_m = std::abs(normal.dot(way)) - along_surface(way, normal).norm();
    strike_mps = std::max(strike_mps, over_m / seconds);
  }
}

void follow_pace(const SettledFrame& now, double seconds, bool jumped,
                 SettleMemory& memory) noexcept {
  const SettledFrame& before = memory.last;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    if (jumped) {  // as if it went along with the person's hand
      memory.pace[i] = velocity_after_jump(*now.tracked, i, seconds, memory);
      memory.drift[i].setZero();
      continue;
    }
    memory.pace[i] = (now.drawn.joints[i].position - before.drawn.joints[i].position) / seconds;
    memory.drift[i] = (offset_of(now, i) - offset_of(before, i)) / seconds;
  }
}

void forget_drift(SettleMemory& memory) noexcept {
  for (std::size_t i = 0; i < kJointCount; ++i) memory.pace[i] -= memory.drift[i];
  memory.drift.fill(Vec3::Zero());
  memory.before = memory.last.correction;
}

JointVectors coasted_joints(const SettleMemory& memory, const HandPose& tracked, const Vec3& normal,
                            double seconds) noexcept {
  const SettledFrame& last = memory.last;
  const double strikes = smoothstep(kStrike_mps, kSureStrike_mps, memory.strike_mps);
  const double rests = strikes * smoothstep(kDeep_m, kSurelyDeep_m, memory.contact.deepest_m);
  const bool held_up = is_held_up(memory);  // not drawn to the surface, so it would not come back
  const double fading = 1.0 / kCoastTime_s + strikes / kStrikeCoastTime_s;
  const double faded_s = seconds * std::exp(-seconds * fading);
  JointVectors coasted;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    coasted[i] = tracked.joints[i].position + offset_of(last, i) + faded_s * memory.drift[i];
    const double pace_mps = std::abs(normal.dot(memory.pace[i]));
    const double still = held_up ? 1.0 : smoothstep(kNotStill_mps, kStill_mps, pace_mps);
    coasted[i] += rests * still * normal.dot(last.drawn.joints[i].position - coasted[i]) * normal;
  }
  return coasted;
}

void add_inertia(const JointVectors& coasted, double stiffness, const PosedHand& posed,
                 const Eigen::Matrix3d& frame, Springs& springs) noexcept {
  // Every joint's spring is as stiff in every direction, so most of the products are sums of cross
  // products: a shift of the wrist meets every joint alike, a turn w takes one at r along w x r.
  const Eigen::Matrix3d to_frame = frame.transpose();
  Vec3 sum = Vec3::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const JointMotion motion = motion_of(posed, i);
    const Vec3 reach = to_frame * motion.reach;
    const Vec3 force = stiffness * (to_frame * (coasted[i] - posed.hand.joints[i].position));
    sum += reach;
    squares += reach * reach.transpose();
    springs.force.head<3>() += force;
    springs.force.segment<3>(3) += reach.cross(force);
    std::array<Vec3, kDigitFreedoms> bends;
    for (std::size_t f = 0; f < motion.bends; ++f) {
      const auto column = static_cast<Eigen::Index>(f);
      bends[f] = to_frame * motion.with_bend[f];
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

bool hold_back(const HandPose& last, const HandPose& next, double most_m, double firmness,
               const PosedHand& posed, const HandFreedoms& step, const Eigen::Matrix3d& frame,
               std::vector<ContactRow>& rows) noexcept {
  const auto way_of = [&](std::size_t joint) -> Vec3 {
    return next.joints[joint].position - last.joints[joint].position;
  };
  bool any = false;
  const auto hold = [&](std::size_t joint) {
    const Vec3 way = way_of(joint);
    const double length_m = way.norm();
    if (length_m <= most_m) return;
    ContactRow& row =
        rows.emplace_back(motion_along(posed, joint_point(joint), -way / length_m, frame));
    row.kind = RowKind::hold_back;
    row.stiffness = firmness * kHoldStiffness;
    row.gap_m = most_m - length_m - gap_after(row, step);
    any = true;
  };
  hold(index_of(Joint::wrist));
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const DigitJoints joints = joints_of(digit_at(d));
    std::size_t farthest = index_of(joints.tip);
    for (std::size_t i = index_of(joints.metacarpal); i < index_of(joints.tip); ++i) {
      if (way_of(i).squaredNorm() > way_of(farthest).squaredNorm()) farthest = i;
    }
    hold(farthest);
  }
  return any;
}

}  // namespace nade
