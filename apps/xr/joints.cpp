#include "joints.h"

namespace nade::xr {
namespace {

constexpr XrSpaceLocationFlags kValid =
    XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT;
constexpr XrSpaceLocationFlags kTracked =
    XR_SPACE_LOCATION_POSITION_TRACKED_BIT | XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT;
constexpr double kInferred = 0.5;

static_assert(kJointCount == XR_HAND_JOINT_COUNT_EXT);
static_assert(index_of(Joint::thumb_tip) == XR_HAND_JOINT_THUMB_TIP_EXT);
static_assert(index_of(Joint::little_tip) == XR_HAND_JOINT_LITTLE_TIP_EXT);

}  // namespace

Pose pose_from(const XrPosef& pose) {
  const XrQuaternionf& q = pose.orientation;
  Pose result;
  result.position = Vec3(pose.position.x, pose.position.y, pose.position.z);
  // To more digits than the runtime's floats keep it of unit length.
  result.rotation = Quat(q.w, q.x, q.y, q.z).normalized();
  return result;
}

draw::FieldOfView view_from(const XrFovf& view) {
  return {view.angleLeft, view.angleRight, view.angleUp, view.angleDown};
}

std::optional<HandPose> hand_from(Handedness side, const JointLocations& joints) {
  HandPose hand;
  hand.side = side;
  hand.confidence = 1.0;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const XrHandJointLocationEXT& joint = joints[i];
    if ((joint.locationFlags & kValid) != kValid) return std::nullopt;
    if ((joint.locationFlags & kTracked) != kTracked) hand.confidence = kInferred;
    hand.joints[i] = pose_from(joint.pose);
    hand.radius[i] = joint.radius > 0.0F ? static_cast<double>(joint.radius) : 0.0;
  }
  if (!is_usable(hand)) return std::nullopt;
  return hand;
}

}  // namespace nade::xr
