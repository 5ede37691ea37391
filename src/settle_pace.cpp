#include "settle_pace.h"

#include <algorithm>

#include "settle_solver.h"
#include "touch_finder.h"

namespace nade {
namespace {

constexpr double kHoldStiffness = 1e5;

}  // namespace

double largest_gain(const HandPose& first, const HandPose& second, const HandPose& third,
                    double ratio) noexcept {
  double farthest_m = 0.0;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Vec3 before = second.joints[i].position - first.joints[i].position;
    const Vec3 after = third.joints[i].position - second.joints[i].position;
    farthest_m = std::max(farthest_m, (after - ratio * before).norm());
  }
  return farthest_m;
}

void follow_velocity(const HandPose& from, const HandPose& to, const Quat& frame, double seconds,
                     double share, std::array<Vec3, kJointCount>& velocity) noexcept {
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Vec3 way = to.joints[i].position - from.joints[i].position;
    velocity[i] += share * (frame.conjugate() * (way / seconds) - velocity[i]);
  }
}

bool hold_back(const HandPose& last, const HandPose& next, double most_m, const PosedHand& posed,
               const HandFreedoms& step, const Eigen::Matrix3d& frame,
               std::vector<ContactRow>& rows) noexcept {
  const auto way_of = [&](std::size_t joint) -> Vec3 {
    return next.joints[joint].position - last.joints[joint].position;
  };
  bool any = false;
  const auto hold = [&](std::size_t joint) {
    const Vec3 way = way_of(joint);
    const double length_m = way.norm();
    if (length_m <= most_m || rows.size() == kMostContactRows) return;
    ContactRow& row =
        rows.emplace_back(motion_along(posed, joint_point(joint), -way / length_m, frame));
    row.kind = RowKind::hold_back;
    row.stiffness = kHoldStiffness;
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
