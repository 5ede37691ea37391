#pragma once

#include "nade/contact.h"

namespace nade {

/// How the whole hand was moved to seat the palm: turned about the tracked palm's centre, then
/// shifted. World frame.
struct PalmCorrection {
  Vec3 shift = Vec3::Zero();
  Quat turn = Quat::Identity();
};

/// The hand moved rigidly by a palm correction.
[[nodiscard]] HandPose apply(const PalmCorrection& correction, const HandPose& tracked) noexcept;

/// The hand with its palm on the surface.
struct SeatedPalm {
  HandPose hand;  ///< bit for bit the tracked one where the palm does not touch
  PalmCorrection correction;
};

/// Step 2 (a): where the palm touches, the shortest turn that takes the back of the hand toward
/// the surface normal, and the shift that puts the palm's centre at its target.
[[nodiscard]] SeatedPalm seat_palm(const HandPose& tracked,
                                   const std::optional<PartContact>& palm) noexcept;

}  // namespace nade
