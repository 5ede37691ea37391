#pragma once

#include <optional>

#include "proxy/proxy_hand.h"
#include "proxy/state.h"
#include "surface/scaled_surface.h"

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

/// How a hand was drawn in the last frame, in the axes of where the object is now, and how far the
/// tracked one has come since by itself.
struct ShownBefore {
  Correction correction;
  double way_m = 0.0;
};

/// A tracked hand in the object's frame.
struct SeenHand {
  HandPose tracked;
  std::optional<ShownBefore> before;  ///< none of one that was not seen then, or jumped
  bool at_another = false;            ///< it goes on at another object than the last frame's
};

/// Begins a frame: the hand and where the object is, which `state.home` and `state.place` say from
/// then on. Of another object than the last frame's nothing is known.
[[nodiscard]] SeenHand see_hand(const HandPose& tracked, const Object& object, double seconds,
                                ProxyState& state) noexcept;

/// Whether an object is not there, or too far from the hand for numbers.
[[nodiscard]] bool is_nowhere(const Object& object, const HandPose& tracked) noexcept;

/// The hand's size over the flesh's, rounded.
[[nodiscard]] double rounded(double scale) noexcept;

/// What became of a tracked hand at such an object, in the world; the tracked one itself where
/// nothing did.
[[nodiscard]] ProxyResult brought_back(const Pose& object, const HandPose& tracked,
                                       ProxyResult result) noexcept;

}  // namespace nade
