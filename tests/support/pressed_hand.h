#pragma once

#include <algorithm>
#include <cstdint>

#include "nade/skeleton.h"
#include "nade/surface.h"
#include "support/hand_checks.h"
#include "support/sample_hand.h"

// Hands on a plane and a ball.

namespace nade::test {

inline constexpr std::int64_t kFrame_ns = 11'111'111;
inline constexpr double kFrame_s = 1e-9 * kFrame_ns;

inline const PlaneSurface kPlane;
inline const SphereSurface kBall(0.15);

inline Object plane() { return Object(kPlane); }
/// Its top at y = 0.
inline Object ball() { return Object(kBall, {{{0.0, -0.15, 0.0}, Quat::Identity()}, 1.0}); }

/// The palm's skin `depth_m` below y = 0, tilted about the hand's lateral axis.
inline HandPose pressed_hand(double depth_m, double tilt_rad = 0.0,
                             const Vec3& along = Vec3::Zero(),
                             const HandPose& hand = generic_size_hand()) {
  const Quat tilt(Eigen::AngleAxisd(tilt_rad, Vec3::UnitX()));
  const double skin_m = generic_skin_depths()[Part::palm];
  return placed_hand(hand, tilt * Vec3(0.0, skin_m, 0.0) - Vec3(0.0, depth_m, 0.0) + along, tilt);
}

/// Down from above, `frames` frames, to the palm's depth.
inline HandPose on_the_way_down(int frame, int frames, double depth_m, double tilt_rad = 0.0) {
  const double share = std::min(1.0, static_cast<double>(frame) / frames);
  return pressed_hand(-0.08 + share * (0.08 + depth_m), tilt_rad);
}

/// Its fingers' joints flexed by 0.25 rad more than a relaxed one's.
inline HandPose bent_hand() {
  HandAngles angles = relaxed_angles();
  for (std::size_t d = 1; d < kDigitCount; ++d) {
    for (HingeAngles& hinge : angles[d]) hinge.flexion += 0.25;
  }
  return generic_size_hand(Handedness::right, angles);
}

/// All joints flexed by 0.7 rad, as far as they can be.
inline HandPose gripping_hand() {
  HandAngles angles = relaxed_angles();
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    for (std::size_t i = 0; i < kHingeCount; ++i) {
      const HingeRange range = range_of_motion(digit_at(d), i);
      angles[d][i].flexion = std::clamp(0.7, range.flexion_min, range.flexion_max);
    }
  }
  return generic_size_hand(Handedness::right, angles);
}

}  // namespace nade::test
