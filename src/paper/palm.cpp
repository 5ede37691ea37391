#include "nade/palm.h"

// Based on: Yanagida, Mori, Toyama. Composition of CG Hand Images for Visual Feedback of Contact
// Sensation in Stroking Motion. 2023. Section 2 (2) (a).

namespace nade {

SeatedPalm seat_palm(const HandPose& tracked, const std::optional<PartContact>& palm) noexcept {
  if (!palm) return {tracked, {}};
  PalmCorrection correction;
  correction.shift = palm->target - tracked[Joint::palm].position;
  correction.turn = turn_toward(tracked.back(), palm->normal, palm->turn);
  return {apply(correction, tracked), correction};
}

}  // namespace nade
