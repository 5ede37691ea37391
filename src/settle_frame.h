#pragma once

#include "nade/settle.h"

namespace nade {

// A hand is settled in a frame that stands still: the object's, as it was when the hand was found.
// What comes in is rounded there. Hand and object moved together then give the same answer, also
// where the smallest difference would grow: deep in a rough object, or with fingers on both sides
// of a sheet.

/// `hand` as seen from the pose `home`, rounded to 60 nm.
[[nodiscard]] HandPose seen_from(const Pose& home, const HandPose& hand) noexcept;
/// The same of an object; its scale stays.
[[nodiscard]] Object seen_from(const Pose& home, const Object& object) noexcept;
/// And of the hand's size over the flesh's.
[[nodiscard]] double rounded(double scale) noexcept;

/// What became there of a tracked hand, in the world; the tracked one itself where nothing did.
[[nodiscard]] SettledHand brought_back(const Pose& home, const HandPose& tracked,
                                       SettledHand settled) noexcept;

}  // namespace nade
