#pragma once

#include <array>
#include <optional>

#include "nade/hand.h"

namespace nade::io {

/// One finger as a Leap Motion v2 reports it. Metres, world frame.
struct LeapFinger {
  Vec3 mcp = Vec3::Zero();  ///< the knuckle; of the thumb the base of its metacarpal
  Vec3 pip = Vec3::Zero();
  Vec3 dip = Vec3::Zero();
  Vec3 tip = Vec3::Zero();           ///< the end of the last bone, inside the flesh
  std::optional<Vec3> metacarpal{};  ///< base of a finger's, where a device reports it
};

/// One hand as a Leap Motion v2 reports it: no wrist, no metacarpals. Metres, world frame. Other
/// devices report a wrist, too.
struct LeapHand {
  Handedness side = Handedness::right;
  Vec3 palm = Vec3::Zero();
  Vec3 palm_normal = -Vec3::UnitY();  ///< out of the palm
  Vec3 direction = -Vec3::UnitZ();    ///< from the palm to the fingers
  double confidence = 1.0;
  std::array<LeapFinger, kDigitCount> fingers{};
  std::optional<Vec3> wrist{};
};

/// The 26 joints: what was measured as it is; wrist, metacarpal joints and the turn of each bone
/// about itself inferred (docs/formats.md says how). Without memory, so without lag. Degenerate
/// input gives a pose that is not `is_usable`, or one turned like the palm where a bone has no
/// length.
[[nodiscard]] HandPose hand_from_leap(const LeapHand& leap);

/// The same of a device that reports a wrist but no palm: the palm is turned so that the generic
/// hand's knuckles lie nearest to these. `leap` needs its side, fingers and wrist.
[[nodiscard]] HandPose hand_from_wrist_and_fingers(LeapHand leap);

}  // namespace nade::io
