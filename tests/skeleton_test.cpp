#include "nade/skeleton.h"

#include <gtest/gtest.h>

#include <random>

#include "support/sample_hand.h"

namespace nade {
namespace {

using test::rad;

/// A hand as a tracker might give it: every joint turned and moved a little off its bone.
HandPose noisy_hand(std::mt19937& random, Handedness side) {
  std::normal_distribution<double> normal;
  const auto vector = [&](double size) {
    return Vec3(size * normal(random), size * normal(random), size * normal(random));
  };
  HandPose hand =
      test::placed_hand(test::sample_hand(side), vector(1.0),
                        Quat(Eigen::AngleAxisd(normal(random), vector(1.0).normalized())));
  for (Pose& joint : hand.joints) {
    joint.position += vector(0.002);
    joint.rotation =
        joint.rotation * Quat(Eigen::AngleAxisd(0.2 * normal(random), vector(1.0).normalized()));
    joint.rotation.normalize();
  }
  return hand;
}

double largest_error(const HandPose& hand) {
  double error = 0.0;
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const DigitChain chain = measure_chain(hand, digit_at(d));
    const DigitPose pose = pose_chain(chain, chain.angles);
    for (std::size_t i = 0; i <= kHingeCount; ++i) {
      const Pose& tracked = hand[hinge_joint(digit_at(d), i)];
      error = std::max(error, (pose[i].position - tracked.position).norm());
      error = std::max(error, 0.1 * pose[i].rotation.angularDistance(tracked.rotation));
    }
  }
  return error;
}

TEST(Skeleton, ForwardKinematicsGivesTheTrackedJointsBack) {
  std::mt19937 random(7);
  for (int i = 0; i < 500; ++i) {
    const Handedness side = i % 2 == 0 ? Handedness::left : Handedness::right;
    EXPECT_LT(largest_error(noisy_hand(random, side)), 1e-5);
  }
}

TEST(Skeleton, BonesWithoutLengthStillGiveTheJointsBack) {
  HandPose hand = test::sample_hand();
  for (Joint joint : {Joint::index_intermediate, Joint::index_distal, Joint::index_tip}) {
    hand[joint].position = hand[Joint::index_proximal].position;
  }
  hand[Joint::thumb_metacarpal].position = hand[Joint::wrist].position;
  EXPECT_LT(largest_error(hand), 1e-5);
}

TEST(Skeleton, AnglesAreWhatTheHandWasBentBy) {
  for (Handedness side : {Handedness::left, Handedness::right}) {
    HandAngles angles = test::relaxed_angles();
    angles[index_of(Digit::index)][0] = {rad(30.0), rad(12.0), 0.0};
    angles[index_of(Digit::little)][2].flexion = rad(40.0);
    const HandAngles measured = measure_angles(test::sample_hand(side, angles));
    for (std::size_t d = 0; d < kDigitCount; ++d) {
      for (std::size_t i = 0; i < kHingeCount; ++i) {
        EXPECT_NEAR(measured[d][i].flexion, angles[d][i].flexion, 1e-9);
        EXPECT_NEAR(measured[d][i].abduction, angles[d][i].abduction, 1e-9);
        EXPECT_NEAR(measured[d][i].twist, angles[d][i].twist, 1e-9);
      }
    }
  }
}

TEST(Skeleton, FlexionMovesTheTipTowardThePalmAndAbductionTowardTheThumb) {
  const HandPose straight = test::sample_hand(Handedness::right, {});
  for (std::size_t d = 1; d < kDigitCount; ++d) {
    HandAngles bent{};
    bent[d][0].flexion = rad(20.0);
    HandAngles spread{};
    spread[d][0].abduction = rad(10.0);
    const Joint tip = joints_of(digit_at(d)).tip;
    EXPECT_LT(test::sample_hand(Handedness::right, bent)[tip].position.y(),
              straight[tip].position.y() - 0.01);
    EXPECT_LT(test::sample_hand(Handedness::right, spread)[tip].position.x(),
              straight[tip].position.x() - 0.005);
  }
}

TEST(Skeleton, AxesAreTheDerivativesOfTheTip) {
  std::mt19937 random(11);
  for (int i = 0; i < 100; ++i) {
    const Handedness side = i % 2 == 0 ? Handedness::left : Handedness::right;
    const DigitChain chain =
        measure_chain(noisy_hand(random, side), digit_at(static_cast<std::size_t>(i) % 5));
    const DigitAxes axes = chain_axes(chain, chain.angles);
    for (std::size_t k = 0; k < kDigitFreedoms; ++k) {
      constexpr double kBend_rad = 1e-6;
      DigitFreedoms moved = freedoms_of(chain.angles);
      moved[static_cast<Eigen::Index>(k)] += kBend_rad;
      const Vec3 tip = pose_chain(chain, with_freedoms(chain.angles, moved))[kHingeCount].position;
      const Vec3 expected = axes.axis[k].cross(axes.tip - axes.center[k]);
      EXPECT_LT(((tip - axes.tip) / kBend_rad - expected).norm(), 1e-6);
    }
  }
}

TEST(Skeleton, ARelaxedThumbLiesInTheMiddleOfItsRange) {
  const HingeRange range = range_of_motion(Digit::thumb, 0);
  const HingeAngles relaxed = measure_angles(test::sample_hand())[0][0];
  EXPECT_GT(relaxed.flexion, range.flexion_min);
  EXPECT_LT(relaxed.flexion, range.flexion_max);
  EXPECT_GT(relaxed.abduction, range.abduction_min);
  EXPECT_LT(relaxed.abduction, range.abduction_max);
}

}  // namespace
}  // namespace nade
