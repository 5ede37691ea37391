#pragma once

#include <array>
#include <optional>

#include "nade/draw/scene.h"
#include "nade/hand.h"
#include "xr_platform.h"

namespace nade::xr {

[[nodiscard]] Pose pose_from(const XrPosef& pose);
[[nodiscard]] draw::FieldOfView view_from(const XrFovf& view);

using JointLocations = std::array<XrHandJointLocationEXT, XR_HAND_JOINT_COUNT_EXT>;

/// A hand as a runtime located it: nade has OpenXR's joints, order and frames. No value where a
/// joint has no valid pose, or where they make no hand. Joints that the runtime only infers count,
/// with half the confidence.
[[nodiscard]] std::optional<HandPose> hand_from(Handedness side, const JointLocations& joints);

}  // namespace nade::xr
