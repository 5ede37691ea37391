#pragma once

#include <algorithm>
#include <limits>

#include "nade/corrector.h"
#include "nade/flesh.h"
#include "nade/hand_mesh.h"
#include "nade/surface.h"
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
    if (a.radius[i] != b.radius[i]) return false;
  }
  return true;
}

inline bool all_finite(const HandPose& hand) {
  return std::all_of(hand.joints.begin(), hand.joints.end(), [](const Pose& joint) {
    return joint.position.allFinite() && joint.rotation.coeffs().allFinite();
  });
}

/// A corrector's options with the method of the whole hand.
inline CorrectorOptions settling() {
  CorrectorOptions options;
  options.method = Method::nade;
  return options;
}

/// The least over the skin of its signed distance, to which `flesh_share` of its flesh depth is
/// added; `reach_m` where none is nearer.
inline double least_over_skin(const HandPose& hand, const Object& object, double flesh_share,
                              double reach_m) {
  const HandFlesh& flesh = generic_flesh(hand.side);
  const double scale = hand_length(hand) / flesh.hand_length_m;
  double least = reach_m;
  SurfaceHint hint;
  for (std::size_t k = 0; k < flesh.skin.size(); ++k) {
    const auto nearest =
        object.closest_point(position_of(flesh.skin[k], hand, scale), reach_m, hint);
    if (!nearest) continue;
    least = std::min(least, nearest->signed_distance + flesh_share * flesh.depth_m[k]);
  }
  return least;
}

/// Signed distance of the deepest skin; `reach_m` where none is nearer.
inline double lowest_skin(const HandPose& hand, const Object& object,
                          double reach_m = std::numeric_limits<double>::infinity()) {
  return least_over_skin(hand, object, 0.0, reach_m);
}

/// The same with each point's flesh depth added: below 0 where skin is deeper than flesh gives way.
inline double least_room(const HandPose& hand, const Object& object,
                         double reach_m = std::numeric_limits<double>::infinity()) {
  return least_over_skin(hand, object, 1.0, reach_m);
}

/// Whether some skin touches, and none is deeper than flesh gives way; to a millimetre.
inline bool rests_on(const Object& object, const HandPose& hand) {
  return lowest_skin(hand, object) < 0.001 && least_room(hand, object) > -0.001;
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
