#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "nade/hand.h"

namespace nade {

/// What may look wrong about a pose. A device's own hand shows none of these.
enum class HandDoubt : std::uint8_t {
  unusable,   ///< `fault_of` says why
  collapsed,  ///< all joints lie within a millimetre
  length,     ///< wrist to middle knuckle is not 60 to 130 mm
  turns,      ///< every joint is turned alike
  bones,      ///< the joints' -Z is more than 30 degrees off their bones, at the median
  back,       ///< the metacarpals' +Y is more than 45 degrees off the back of the hand
  bend,       ///< the fingers bend to the back of the hand, by more than a dozen degrees
};
inline constexpr std::size_t kHandDoubtCount = 7;

/// What a doubtful pose most likely is.
enum class HandCause : std::uint8_t {
  collapsed,         ///< all joints in one point: a hand that was not tracked
  other_units,       ///< positions are not in metres
  no_rotations,      ///< rotations were never set
  quaternion_order,  ///< w came first, and was read as x
  mirrored,          ///< from a left-handed frame, as Unity's
  upside_down,       ///< from a frame that is mirrored from the palm to the back of the hand
  swapped_sides,     ///< the hand is of the other side
  other_bone_axes,   ///< joints point to the fingertip, or to the back, with other axes
  unknown,           ///< none of these
};
inline constexpr std::size_t kHandCauseCount = 9;

/// An axis of a joint's own frame.
enum class JointAxis : std::uint8_t { plus_x, plus_y, plus_z, minus_x, minus_y, minus_z };

/// How a pose agrees with the conventions of `HandPose`. Angles are zero where nothing is finite.
struct HandCheck {
  std::array<bool, kHandDoubtCount> doubts{};
  /// Of the rotations first, then of the length; none without a doubt about either.
  std::optional<HandCause> cause{};
  double length_m = 0.0;        ///< wrist to middle knuckle
  double bone_angle_rad = 0.0;  ///< between the joints' -Z and their bones, median
  double back_angle_rad = 0.0;  ///< between the metacarpals' +Y and the back of the hand, median
  /// The axes that point to the fingertip and to the back of the hand; told where either is in
  /// doubt.
  JointAxis bone_axis = JointAxis::minus_z;
  JointAxis back_axis = JointAxis::plus_y;
  /// What the unit of the positions most likely is, metres; told where the length is in doubt.
  std::optional<double> unit_m{};

  [[nodiscard]] bool has(HandDoubt doubt) const { return doubts[static_cast<std::size_t>(doubt)]; }
};

/// Checks one pose, as a device or an importer gives it. The back of the hand is told from wrist,
/// knuckles and `side`. One pose may be odd by itself: judge by what most frames say.
[[nodiscard]] HandCheck check_hand(const HandPose& hand) noexcept;

/// What the unit of a hand's positions most likely is by its length from wrist to middle knuckle:
/// metres (millimetres, centimetres, inches, feet or kilometres); none where no unit fits.
[[nodiscard]] std::optional<double> unit_by_length(double length) noexcept;

/// What a cause looks like and how to convert, in words: "the quaternions look to have w first;
/// …".
[[nodiscard]] std::string_view name_of(HandCause cause);
/// "+X", …
[[nodiscard]] std::string_view name_of(JointAxis axis);
/// The unit vector of an axis.
[[nodiscard]] Vec3 vector_of(JointAxis axis) noexcept;

}  // namespace nade
