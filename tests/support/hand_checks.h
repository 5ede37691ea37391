#pragma once

#include <algorithm>

#include "nade/hand_mesh.h"
#include "support/sample_hand.h"

namespace nade::test {

inline HandPose generic_size_hand(Handedness side = Handedness::right,
                                  const HandAngles& angles = relaxed_angles()) {
  HandPose hand = sample_hand(side, angles);
  const double scale = kGenericHandLength / hand_length(hand);
  for (Pose& joint : hand.joints) joint.position *= scale;
  return hand;
}

inline bool same_bits(const HandPose& a, const HandPose& b) {
  for (std::size_t i = 0; i < kJointCount; ++i) {
    if (a.joints[i].position != b.joints[i].position) return false;
    if (a.joints[i].rotation.coeffs() != b.joints[i].rotation.coeffs()) return false;
  }
  return true;
}

inline bool all_finite(const HandPose& hand) {
  return std::all_of(hand.joints.begin(), hand.joints.end(), [](const Pose& joint) {
    return joint.position.allFinite() && joint.rotation.coeffs().allFinite();
  });
}

inline double excess(double value, double low, double high) {
  return std::max({0.0, value - high, low - value});
}

/// How far beyond its range of motion the worst joint is that the tracked pose did not have so.
inline double limit_violation(const HandPose& tracked, const HandPose& corrected) {
  const HandAngles before = measure_angles(tracked);
  const HandAngles after = measure_angles(corrected);
  double worst = 0.0;
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    for (std::size_t i = 0; i < kHingeCount; ++i) {
      const HingeRange range = range_of_motion(digit_at(d), i);
      const auto flexion = [&](const HandAngles& angles) {
        return excess(angles[d][i].flexion, range.flexion_min, range.flexion_max);
      };
      worst = std::max(worst, flexion(after) - flexion(before));
      if (i > 0) continue;  // only a digit's first hinge abducts
      const auto abduction = [&](const HandAngles& angles) {
        return excess(angles[d][i].abduction, range.abduction_min, range.abduction_max);
      };
      worst = std::max(worst, abduction(after) - abduction(before));
    }
  }
  return worst;
}

}  // namespace nade::test
