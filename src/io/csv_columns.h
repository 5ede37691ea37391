#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "nade/hand.h"
#include "recording_limits.h"

namespace nade::io {

/// What our own columns of a joint end in: position, rotation, radius.
inline constexpr std::array<std::string_view, kJointNumbers> kJointNumberNames{
    "px", "py", "pz", "qx", "qy", "qz", "qw", "radius"};

/// What a column of a table of joints holds.
struct JointColumn {
  enum class Kind : std::uint8_t { joint, time, side, valid, confidence };
  Kind kind = Kind::joint;
  std::optional<Handedness> side;  ///< where its name says it
  Joint joint = Joint::wrist;
  std::size_t number = 0;     ///< of a joint: x y z, x y z w of the rotation, radius
  double time_unit_ns = 0.0;  ///< of a time; 0 where its name does not say it
};

/// A column by its name: "index_tip_px", "LeftIndexTip_rotation.w",
/// "XR_HAND_JOINT_INDEX_TIP_EXT_pos_x", "index-finger-phalanx-proximal qy", "time_ns", "hand".
[[nodiscard]] std::optional<JointColumn> column_from(std::string_view name);

}  // namespace nade::io
