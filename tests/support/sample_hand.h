#pragma once

#include <array>

#include "nade/hand.h"
#include "nade/skeleton.h"

namespace nade::test {

inline constexpr double rad(double degrees) { return degrees * kDegree; }

/// A relaxed hand's flexion, as a headset sees it: 0 to 18 degrees in the fingers.
inline HandAngles relaxed_angles() {
  HandAngles angles{};
  for (std::size_t d = 1; d < kDigitCount; ++d) {
    angles[d][0].flexion = rad(8.0);
    angles[d][1].flexion = rad(16.0);
    angles[d][2].flexion = rad(4.0);
  }
  angles[0][1].flexion = rad(5.0);
  angles[0][2].flexion = rad(7.0);
  return angles;
}

/// A hand for tests: wrist at the origin, palm down (back of the hand +Y), fingers along -Z;
/// bone lengths of an adult hand.
inline HandPose sample_hand(Handedness side = Handedness::right,
                            const HandAngles& angles = relaxed_angles()) {
  struct DigitSize {
    Vec3 base;
    std::array<double, kHingeCount> bone;
  };
  static const std::array<DigitSize, kDigitCount> kSizes{{
      {{-0.021, -0.010, -0.022}, {0.033, 0.034, 0.025}},
      {{-0.027, 0.000, -0.095}, {0.038, 0.024, 0.022}},
      {{-0.004, 0.003, -0.096}, {0.043, 0.028, 0.025}},
      {{0.016, 0.000, -0.088}, {0.039, 0.027, 0.024}},
      {{0.034, -0.006, -0.078}, {0.031, 0.020, 0.022}},
  }};
  HandPose hand;
  hand.side = Handedness::right;
  for (std::size_t d = 1; d < kDigitCount; ++d) {
    Pose& metacarpal = hand[joints_of(digit_at(d)).metacarpal];
    metacarpal.position = Vec3(0.4 * kSizes[d].base.x(), 0.0, -0.035);
  }
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const Digit digit = digit_at(d);
    // A first guess gives measure_chain the joints whose frames it needs.
    hand[hinge_joint(digit, 0)].position = kSizes[d].base;
    DigitChain chain = measure_chain(hand, digit);
    for (std::size_t i = 0; i < kHingeCount; ++i) {
      chain.bone[i] = Vec3(0.0, 0.0, -kSizes[d].bone[i]);
      chain.joint_from_bone[i] = Quat::Identity();
    }
    chain.joint_from_bone[kHingeCount] = Quat::Identity();
    set_digit(hand, digit, pose_chain(chain, angles[d]));
  }
  hand[Joint::palm] = palm_from_middle_metacarpal(hand);
  hand[Joint::palm].rotation = Quat::Identity();
  return side == Handedness::right ? hand : mirrored(hand);
}

/// The hand moved so that its palm joint is at `position`, turned about it.
inline HandPose placed_hand(const HandPose& hand, const Vec3& position,
                            const Quat& turn = Quat::Identity()) {
  const Vec3 center = hand[Joint::palm].position;
  return moved(hand, {position - turn * center, turn});
}

}  // namespace nade::test
