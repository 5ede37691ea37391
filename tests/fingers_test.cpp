#include "nade/fingers.h"

#include <gtest/gtest.h>

#include <random>

#include "nade/palm.h"
#include "support/sample_hand.h"

namespace nade {
namespace {

using test::rad;

Vec3 tip_of(const DigitChain& chain, const DigitAngles& angles) {
  return pose_chain(chain, angles)[kHingeCount].position;
}

double range_excess(Digit digit, const DigitAngles& angles) {
  double excess = 0.0;
  for (std::size_t i = 0; i < kHingeCount; ++i) {
    const HingeRange range = range_of_motion(digit, i);
    excess = std::max(
        {excess, range.flexion_min - angles[i].flexion, angles[i].flexion - range.flexion_max});
    if (i > 0) continue;
    excess = std::max({excess, range.abduction_min - angles[i].abduction,
                       angles[i].abduction - range.abduction_max});
  }
  return excess;
}

/// Angles anywhere inside the range of motion.
DigitAngles random_angles(Digit digit, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.1, 0.9);
  DigitAngles angles{};
  for (std::size_t i = 0; i < kHingeCount; ++i) {
    const HingeRange range = range_of_motion(digit, i);
    angles[i].flexion =
        range.flexion_min + uniform(random) * (range.flexion_max - range.flexion_min);
    angles[i].abduction =
        range.abduction_min + uniform(random) * (range.abduction_max - range.abduction_min);
  }
  return angles;
}

TEST(Fingers, ATargetAtTheTipChangesNothing) {
  const HandPose hand = test::sample_hand();
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const DigitChain chain = measure_chain(hand, digit_at(d));
    const DigitAngles angles = reach(chain, tip_of(chain, chain.angles));
    EXPECT_LT((freedoms_of(angles) - freedoms_of(chain.angles)).norm(), 1e-9);
  }
}

TEST(Fingers, EveryReachableTargetIsMetInsideTheRange) {
  std::mt19937 random(3);
  double worst_m = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const Digit digit = digit_at(static_cast<std::size_t>(i) % kDigitCount);
    const Handedness side = i % 2 == 0 ? Handedness::left : Handedness::right;
    const DigitChain chain = measure_chain(test::sample_hand(side), digit);
    const Vec3 target = tip_of(chain, random_angles(digit, random));
    const DigitAngles angles = reach(chain, target);
    EXPECT_LE(range_excess(digit, angles), 1e-12);
    worst_m = std::max(worst_m, (tip_of(chain, angles) - target).norm());
  }
  EXPECT_LT(worst_m, 1e-5);
}

TEST(Fingers, ATargetBeyondReachStraightensTheFingerTowardIt) {
  const DigitChain chain = measure_chain(test::sample_hand(), Digit::index);
  const Vec3 target = chain.base + Vec3(0.0, 0.0, -1.0);
  const Vec3 tip = tip_of(chain, reach(chain, target));
  EXPECT_GT((tip - chain.base).normalized().dot(-Vec3::UnitZ()), 0.999);
  EXPECT_GT((tip - chain.base).norm(), 0.998 * chain.length());
}

TEST(Fingers, ATargetAtTheBaseIsAnsweredInsideTheRange) {
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const DigitChain chain = measure_chain(test::sample_hand(), digit_at(d));
    const DigitAngles angles = reach(chain, chain.base);
    EXPECT_TRUE(freedoms_of(angles).allFinite());
    EXPECT_LE(range_excess(digit_at(d), angles), 1e-12);
  }
}

TEST(Fingers, ATrackedAngleOutsideTheRangeStaysAllowed) {
  HandAngles angles{};
  angles[index_of(Digit::ring)][1].flexion = rad(-12.0);
  const DigitChain chain = measure_chain(test::sample_hand(Handedness::right, angles), Digit::ring);
  const DigitAngles same = reach(chain, tip_of(chain, chain.angles));
  EXPECT_NEAR(same[1].flexion, rad(-12.0), 1e-9);
}

TEST(Fingers, TheAnswerIsContinuousInTheTarget) {
  const DigitChain chain = measure_chain(test::sample_hand(), Digit::middle);
  const Vec3 start = tip_of(chain, chain.angles);
  DigitFreedoms before = freedoms_of(chain.angles);
  for (int i = 1; i <= 200; ++i) {
    const Vec3 target = start + i * 1e-4 * Vec3(0.1, 1.0, 0.0);
    const DigitFreedoms now = freedoms_of(reach(chain, target));
    EXPECT_LT((now - before).cwiseAbs().maxCoeff(), rad(2.0)) << "step " << i;
    before = now;
  }
}

TEST(Fingers, MirroredDigitsBendAlike) {
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const DigitChain right = measure_chain(test::sample_hand(), digit_at(d));
    const DigitChain left = measure_chain(test::sample_hand(Handedness::left), digit_at(d));
    const Vec3 target = tip_of(right, right.angles) + Vec3(0.003, 0.015, 0.002);
    const Vec3 target_mirrored(-target.x(), target.y(), target.z());
    EXPECT_LT((freedoms_of(reach(right, target)) - freedoms_of(reach(left, target_mirrored)))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-7);
  }
}

/// A hand with bent fingers, sunk into the plane so far that every part is below.
HandPose sunk_hand(double finger_flexion_rad) {
  HandAngles angles = test::relaxed_angles();
  for (std::size_t d = 1; d < kDigitCount; ++d) angles[d][0].flexion = finger_flexion_rad;
  return test::placed_hand(test::sample_hand(Handedness::right, angles), {0.0, -0.01, 0.0});
}

TEST(Fingers, TheTurnedRayKeepsTheFingerFromBuckling) {
  const PlaneSurface plane;
  const Object object(plane);
  const HandPose hand = sunk_hand(rad(45.0));
  for (double most_turn : {0.0, 1.4}) {
    ContactMemory memory;
    Contacts contacts = find_contacts(hand, generic_skin_depths(), object, {}, memory);
    const SeatedPalm seated = seat_palm(hand, contacts[0]);
    const LaidFingers laid = lay_fingers(hand, seated.hand, object, {most_turn}, contacts);
    const DigitChain before = measure_chain(hand, Digit::middle);
    const DigitChain after = measure_chain(laid.hand, Digit::middle);
    const double curl_before = curl_of(before.angles);
    const double curl_after = curl_of(after.angles);
    if (most_turn > 0.0) {
      EXPECT_GT(laid.ray_turn_rad[index_of(Digit::middle)], 0.0);
      EXPECT_NEAR(curl_after, curl_before, rad(2.0));
    } else {
      EXPECT_GT(curl_after, curl_before + rad(20.0));
    }
    EXPECT_NEAR(laid.hand[Joint::middle_tip].position.y(), generic_skin_depths()[Part::middle],
                1e-4);
  }
}

TEST(Fingers, TheTurnIsTheLeastThatKeepsBaseToTip) {
  const PlaneSurface plane;
  const HandPose hand = sunk_hand(rad(45.0));
  ContactMemory memory;
  Contacts contacts = find_contacts(hand, generic_skin_depths(), Object(plane), {}, memory);
  const SeatedPalm seated = seat_palm(hand, contacts[0]);
  const LaidFingers laid = lay_fingers(hand, seated.hand, Object(plane), {}, contacts);
  for (std::size_t d = 1; d < kDigitCount; ++d) {
    const Joint tip = joints_of(digit_at(d)).tip;
    const Joint base = hinge_joint(digit_at(d), 0);
    EXPECT_NEAR((laid.hand[tip].position - laid.hand[base].position).norm(),
                (hand[tip].position - hand[base].position).norm(), 1e-5);
  }
}

}  // namespace
}  // namespace nade
