#pragma once

#include <optional>

#include "nade/skeleton.h"
#include "nade/surface.h"

namespace nade {

// A hand is settled in the object's frame, whatever the object does; lengths are the world's. What
// comes in is rounded before, as seen from home, where the object was when the hand was found. Hand
// and object moved together then give the same answer, also where the smallest difference would
// grow: deep in a rough object, or with fingers on both sides of a sheet.

/// A hand that goes farther from one frame to the next, or whose object grows by so much under it,
/// was lost and found: its pads would not see from so far how deep they are.
inline constexpr double kTeleport_m = 0.1;
/// One that was not seen for longer may be anywhere.
inline constexpr double kMissing_s = 0.2;

/// Where the object is.
struct ObjectFrame {
  Pose home;                 ///< when the hand was found, in the world
  Pose place;                ///< in the last frame
  Vec3 went = Vec3::Zero();  ///< the tracked palm's way in the last frame, in the world
  ObjectIdentity object;
};

/// A tracked hand in the object's frame.
struct SeenHand {
  HandPose tracked;
  bool goes_on = false;         ///< from the last frame
  bool at_another = false;      ///< object than the last frame's, though it goes on
  std::optional<double> way_m;  ///< it came by itself; none if it was not seen then, or jumped
  Pose from_last;               ///< leads from the last frame's place to this one's
  Pose from_other;  ///< at another: from the last frame's place to where this one was then
};

/// Begins a frame: the hand and where the object is, which `frame.home` and `frame.place` say from
/// then on. `last` is the tracked hand of the last frame at its place, if any. Of another object
/// than the last frame's nothing is known, except perhaps where it was then: at `object_before`.
[[nodiscard]] SeenHand see_hand(const HandPose& tracked, const Object& object, double seconds,
                                const HandPose* last, const Pose* object_before,
                                ObjectFrame& frame) noexcept;

/// Whether an object is not there, or too far from the hand for numbers.
[[nodiscard]] bool is_nowhere(const Object& object, const HandPose& tracked) noexcept;

/// The hand's size over the flesh's, rounded.
[[nodiscard]] double rounded(double scale) noexcept;

}  // namespace nade
