#pragma once

// Optional, header only: hands from and to OpenXR's XR_EXT_hand_tracking.

#include <openxr/openxr.h>

#include <cmath>
#include <optional>
#include <span>

#include "nade/hand.h"

namespace nade::openxr {

/// All joints of a hand, as `XrHandJointLocationsEXT::jointLocations` points to them.
using Locations = std::span<const XrHandJointLocationEXT, XR_HAND_JOINT_COUNT_EXT>;

static_assert(kJointCount == XR_HAND_JOINT_COUNT_EXT);
static_assert(index_of(Joint::thumb_tip) == XR_HAND_JOINT_THUMB_TIP_EXT);
static_assert(index_of(Joint::little_tip) == XR_HAND_JOINT_LITTLE_TIP_EXT);

[[nodiscard]] inline Pose pose_from(const XrPosef& pose) {
  const XrQuaternionf& q = pose.orientation;
  Pose result;
  result.position = Vec3(pose.position.x, pose.position.y, pose.position.z);
  // To more digits than the runtime's floats keep it of unit length.
  result.rotation = Quat(q.w, q.x, q.y, q.z).normalized();
  return result;
}

[[nodiscard]] inline XrVector3f xr_vector_from(const Vec3& vector) {
  const Eigen::Vector3f v = vector.cast<float>();
  return {v.x(), v.y(), v.z()};
}

[[nodiscard]] inline XrPosef xr_pose_from(const Pose& pose) {
  const Eigen::Vector4f q = pose.rotation.coeffs().cast<float>();
  return {{q.x(), q.y(), q.z(), q.w()}, xr_vector_from(pose.position)};
}

/// A hand as a runtime located it: nade has OpenXR's joints, order and frames. Confidence is 1, or
/// a half where the runtime only infers a joint. No value where a joint has no valid pose, or where
/// they make no hand (`fault_of`).
[[nodiscard]] inline std::optional<HandPose> hand_from(Handedness side, Locations joints) {
  constexpr XrSpaceLocationFlags kValid =
      XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT;
  constexpr XrSpaceLocationFlags kTracked =
      XR_SPACE_LOCATION_POSITION_TRACKED_BIT | XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT;
  constexpr double kInferred = 0.5;
  HandPose hand;
  hand.side = side;
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

/// Puts the hand to draw where the runtime's was. Flags and radii stay.
inline void put_hand(const HandPose& drawn,
                     std::span<XrHandJointLocationEXT, XR_HAND_JOINT_COUNT_EXT> joints) {
  for (std::size_t i = 0; i < kJointCount; ++i) joints[i].pose = xr_pose_from(drawn.joints[i]);
}

/// Puts how the drawn hand moved from one frame to the next, metres and radians a second; not valid
/// where no time went by.
inline void put_velocities(const HandPose& before, const HandPose& now, double seconds,
                           std::span<XrHandJointVelocityEXT, XR_HAND_JOINT_COUNT_EXT> joints) {
  const bool known = std::isfinite(seconds) && seconds > 0.0;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    XrHandJointVelocityEXT& joint = joints[i];
    joint = {};
    if (!known) continue;
    const Pose& from = before.joints[i];
    const Pose& to = now.joints[i];
    const Eigen::AngleAxisd turn{Eigen::Quaterniond(to.rotation * from.rotation.conjugate())};
    joint.velocityFlags = XR_SPACE_VELOCITY_LINEAR_VALID_BIT | XR_SPACE_VELOCITY_ANGULAR_VALID_BIT;
    joint.linearVelocity = xr_vector_from((to.position - from.position) / seconds);
    joint.angularVelocity = xr_vector_from(turn.angle() / seconds * turn.axis());
  }
}

}  // namespace nade::openxr
