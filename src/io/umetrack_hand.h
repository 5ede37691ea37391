#pragma once

#include <array>
#include <string>

#include "leap_hand.h"
#include "nade/hand.h"
#include "nade/status.h"

namespace nade::io {

inline constexpr std::size_t kUmetrackAngles = 20;  ///< four hinges for each digit

/// The hand of a person as UmeTrack has it: a left one at rest, metres, seen from the wrist.
struct UmetrackModel {
  std::array<Vec3, kUmetrackAngles> hinges{};  ///< a point on each
  std::array<Vec3, kUmetrackAngles> axes{};    ///< about which it turns
  std::array<Vec3, kDigitCount> tips{};
};

/// Reads a person's hand from a file ("umetrack_hand_user_profile.json").
[[nodiscard]] Result<UmetrackModel> read_umetrack_model(const std::string& path);

/// The hand's points with its hinges bent by `angles` (radians) and its wrist at `wrist`, in which
/// a right hand is the mirror x = 0 of the model.
[[nodiscard]] LeapHand umetrack_hand(const UmetrackModel& model, Handedness side,
                                     const std::array<double, kUmetrackAngles>& angles,
                                     const Pose& wrist);

}  // namespace nade::io
