#include "nade/correction.h"

#include <algorithm>

namespace nade {

HandPose apply(const PalmCorrection& correction, const HandPose& tracked) noexcept {
  const Vec3 center = tracked[Joint::palm].position;
  return moved(tracked, {center + correction.shift - correction.turn * center, correction.turn});
}

HandPose apply(const Correction& correction, const HandPose& tracked) noexcept {
  HandPose hand = apply(correction.palm, tracked);
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    if (correction.bend[d].isZero(0.0)) continue;
    const DigitChain chain = measure_chain(hand, digit_at(d));
    const DigitFreedoms bent = freedoms_of(chain.angles) + correction.bend[d];
    set_digit(hand, chain.digit, pose_chain(chain, with_freedoms(chain.angles, bent)));
  }
  return hand;
}

double largest_motion(const HandPose& from, const HandPose& to) noexcept {
  double motion = 0.0;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    motion = std::max(motion, (to.joints[i].position - from.joints[i].position).norm());
  }
  return motion;
}

}  // namespace nade
