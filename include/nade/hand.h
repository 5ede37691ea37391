#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "nade/geometry.h"

namespace nade {

/// The joints of a hand, in the order of XrHandJointEXT (XR_EXT_hand_tracking).
enum class Joint : std::uint8_t {
  palm,
  wrist,
  thumb_metacarpal,
  thumb_proximal,
  thumb_distal,
  thumb_tip,
  index_metacarpal,
  index_proximal,
  index_intermediate,
  index_distal,
  index_tip,
  middle_metacarpal,
  middle_proximal,
  middle_intermediate,
  middle_distal,
  middle_tip,
  ring_metacarpal,
  ring_proximal,
  ring_intermediate,
  ring_distal,
  ring_tip,
  little_metacarpal,
  little_proximal,
  little_intermediate,
  little_distal,
  little_tip,
};
inline constexpr std::size_t kJointCount = 26;

enum class Digit : std::uint8_t { thumb, index, middle, ring, little };
inline constexpr std::size_t kDigitCount = 5;

/// What can touch in the paper's method: the palm's centre and the five fingertips.
enum class Part : std::uint8_t { palm, thumb, index, middle, ring, little };
inline constexpr std::size_t kPartCount = 6;

enum class Handedness : std::uint8_t { left, right };

/// What became of a tracked hand in a frame.
enum class HandStatus : std::uint8_t {
  free,       ///< nothing touched: the tracked hand, bit for bit
  corrected,  ///< some part rests on the object, or is braked to land on it
  released,   ///< nothing touched any more, what was left of a correction fades
  untracked,  ///< the tracked hand was missing or could not be used
};

[[nodiscard]] constexpr std::size_t index_of(Joint joint) {
  return static_cast<std::size_t>(joint);
}
[[nodiscard]] constexpr std::size_t index_of(Digit digit) {
  return static_cast<std::size_t>(digit);
}
[[nodiscard]] constexpr std::size_t index_of(Part part) { return static_cast<std::size_t>(part); }
[[nodiscard]] constexpr std::size_t index_of(Handedness side) {
  return static_cast<std::size_t>(side);
}
[[nodiscard]] constexpr Joint joint_at(std::size_t index) { return static_cast<Joint>(index); }
[[nodiscard]] constexpr Digit digit_at(std::size_t index) { return static_cast<Digit>(index); }
[[nodiscard]] constexpr Part part_at(std::size_t index) { return static_cast<Part>(index); }

/// The fingertip part of a digit.
[[nodiscard]] constexpr Part part_of(Digit digit) { return part_at(index_of(digit) + 1); }

/// The joints of a digit from the metacarpal to the tip: five, for the thumb four.
struct DigitJoints {
  Joint metacarpal;
  Joint tip;
  [[nodiscard]] constexpr std::size_t count() const {
    return index_of(tip) - index_of(metacarpal) + 1;
  }
};
[[nodiscard]] constexpr DigitJoints joints_of(Digit digit) {
  constexpr std::array<DigitJoints, kDigitCount> kJoints{{
      {Joint::thumb_metacarpal, Joint::thumb_tip},
      {Joint::index_metacarpal, Joint::index_tip},
      {Joint::middle_metacarpal, Joint::middle_tip},
      {Joint::ring_metacarpal, Joint::ring_tip},
      {Joint::little_metacarpal, Joint::little_tip},
  }};
  return kJoints[index_of(digit)];
}

/// The joint at a part's centre: the palm joint or a fingertip.
[[nodiscard]] constexpr Joint joint_of(Part part) {
  return part == Part::palm ? Joint::palm : joints_of(digit_at(index_of(part) - 1)).tip;
}

/// "thumb_metacarpal", …
[[nodiscard]] std::string_view name_of(Joint joint);
/// "palm", "thumb", "index", …
[[nodiscard]] std::string_view name_of(Part part);
/// "left" or "right".
[[nodiscard]] std::string_view name_of(Handedness side);
/// "free", "corrected", "released" or "untracked".
[[nodiscard]] std::string_view name_of(HandStatus status);
/// "pinky-finger-phalanx-proximal", …
[[nodiscard]] std::string_view webxr_name_of(Joint joint);
/// A joint by its WebXR name ("pinky-finger-phalanx-proximal"); the palm is "palm".
[[nodiscard]] std::optional<Joint> joint_from_webxr_name(std::string_view name);

/// One hand at one moment. Joint frames as in OpenXR: -Z points to the fingertip, +Y to the
/// back of the hand, for both hands.
struct HandPose {
  Handedness side = Handedness::right;
  std::array<Pose, kJointCount> joints{};
  /// Joint to skin, metres; 0 where unknown.
  std::array<double, kJointCount> radius{};
  /// The tracker's own, 0 to 1. For who records and shows it: a hand is corrected alike at any.
  double confidence = 1.0;

  bool operator==(const HandPose&) const = default;

  [[nodiscard]] const Pose& operator[](Joint joint) const { return joints[index_of(joint)]; }
  [[nodiscard]] Pose& operator[](Joint joint) { return joints[index_of(joint)]; }

  /// `b`: the unit normal of the back of the hand.
  [[nodiscard]] Vec3 back() const { return (*this)[Joint::palm].rotation * Vec3::UnitY(); }
};

/// Why the frame path cannot work on a pose.
enum class HandFault : std::uint8_t {
  not_finite,         ///< a number of a joint is not finite
  rotation_not_unit,  ///< a squared length of a rotation is not 1 to a thousandth
  wrist_far,          ///< the wrist is 1000 km or more from the origin
  joint_far,          ///< a joint is half a metre or more from the wrist
  no_length,          ///< wrist and middle knuckle are less than a millimetre apart
};
/// What a fault is, to go into a sentence: "a joint is half a metre or more from the wrist".
[[nodiscard]] std::string_view name_of(HandFault fault);

/// The first fault of a pose, in the order of `HandFault`; none where the frame path can work on
/// it. Radii may be anything.
[[nodiscard]] std::optional<HandFault> fault_of(const HandPose& hand) noexcept;

/// Whether there is no fault.
[[nodiscard]] bool is_usable(const HandPose& hand) noexcept;

/// The hand with rotations from half to twice the unit length made unit, as floats and rounded
/// files need it. One that is unit as `fault_of` has it stays bit for bit, and so does any other.
[[nodiscard]] HandPose with_unit_rotations(const HandPose& hand) noexcept;

/// Wrist to middle-finger knuckle, metres: the measure of a hand's size.
[[nodiscard]] double hand_length(const HandPose& hand) noexcept;

/// The palm where a device gives none: the middle of the middle metacarpal, turned like it.
[[nodiscard]] Pose palm_from_middle_metacarpal(const HandPose& hand) noexcept;

/// The hand moved rigidly: every joint by `motion`.
[[nodiscard]] HandPose moved(const HandPose& hand, const Pose& motion) noexcept;

/// The same place seen in the mirror x = 0.
[[nodiscard]] Pose mirrored(const Pose& pose) noexcept;

/// The same hand seen in the mirror x = 0, with the other handedness.
[[nodiscard]] HandPose mirrored(const HandPose& hand) noexcept;

}  // namespace nade
