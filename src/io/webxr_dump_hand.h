#pragma once

#include <optional>
#include <string>

#include "json_text.h"
#include "nade/hand.h"

namespace nade::io {

/// The pose of a hand that a page wrote down: an object by WebXR's joint names, each with a
/// position and a rotation or a matrix; or the arrays of XRFrame.fillPoses and fillJointRadii. None
/// where a joint is missing or cannot be used; `missing` says which. The error names `place`.
[[nodiscard]] Result<std::optional<HandPose>> hand_of_page(const Json& hand, Handedness side,
                                                           const std::string& place,
                                                           std::string& missing);

}  // namespace nade::io
