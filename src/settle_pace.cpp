#include "settle_pace.h"

#include <cmath>

namespace nade {
namespace {

constexpr double kHoldStiffness = 1.5e5;
/// The time constant with which a drawn joint takes on the tracked one's velocity.
constexpr double kCoastTime_s = 0.059194;

/// From a tracked joint to the drawn one.
Vec3 offset_of(const SettledFrame& frame, std::size_t joint) {
  return frame.drawn.joints[joint].position - frame.tracked->joints[joint].position;
}

}  // namespace

void follow_velocity(const HandPose& from, const HandPose& to, double seconds, double share,
                     JointVectors& velocity) noexcept {
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Vec3 way = to.joints[i].position - from.joints[i].position;
    velocity[i] += share * (way / seconds - velocity[i]);
  }
}

JointVectors drift_between(const SettledFrame& before, const SettledFrame& now,
                           double seconds) noexcept {
  JointVectors drift;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    drift[i] = (offset_of(now, i) - offset_of(before, i)) / seconds;
  }
  return drift;
}

JointVectors coasted_joints(const SettledFrame& last, const JointVectors& drift,
                            const HandPose& tracked, double seconds) noexcept {
  const double faded_s = seconds * std::exp(-seconds / kCoastTime_s);
  JointVectors coasted;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    coasted[i] = tracked.joints[i].position + offset_of(last, i) + faded_s * drift[i];
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
