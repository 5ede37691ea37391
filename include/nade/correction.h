#pragma once

#include "nade/fingers.h"
#include "nade/palm.h"

namespace nade {

/// A correction as a change of the tracked hand: the palm's motion and what the digits bend.
struct Correction {
  PalmCorrection palm;
  HandBend bend = no_bend();
};

/// The tracked hand with a correction applied.
[[nodiscard]] HandPose apply(const Correction& correction, const HandPose& tracked) noexcept;

/// The farthest that any joint goes from one pose to the other, metres.
[[nodiscard]] double largest_motion(const HandPose& from, const HandPose& to) noexcept;

}  // namespace nade
