#include "carry_over.h"

namespace nade {
namespace {

/// The joint that a joint is turned and shifted against; of the wrist itself.
std::size_t joint_before(std::size_t joint) {
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    if (joint == index_of(joints_of(digit_at(d)).metacarpal)) return index_of(Joint::wrist);
  }
  return joint == index_of(Joint::palm) ? index_of(Joint::wrist) : joint - 1;
}

}  // namespace

HandPose carried_over(const HandPose& tracked, const HandPose& drawn,
                      const HandPose& newer) noexcept {
  HandPose result = newer;
  const std::size_t wrist = index_of(Joint::wrist);
  const Pose& from = tracked.joints[wrist];
  const Pose& to = drawn.joints[wrist];
  result.joints[wrist].position += to.position - from.position;
  result.joints[wrist].rotation =
      (to.rotation * from.rotation.conjugate() * newer.joints[wrist].rotation).normalized();
  const auto local = [](const HandPose& hand, std::size_t joint) {
    return hand.joints[joint_before(joint)].inverse() * hand.joints[joint];
  };
  for (std::size_t joint = 0; joint < kJointCount; ++joint) {
    if (joint == wrist) continue;
    const Pose before = local(tracked, joint);
    const Pose after = local(drawn, joint);
    Pose now = local(newer, joint);
    now.position += after.position - before.position;
    now.rotation = after.rotation * before.rotation.conjugate() * now.rotation;
    result.joints[joint] = result.joints[joint_before(joint)] * now;
    result.joints[joint].rotation.normalize();
  }
  return result;
}

}  // namespace nade
