#include "nade/hand.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/sample_hand.h"

namespace nade {
namespace {

TEST(Hand, JointsFollowTheOpenXrOrder) {
  EXPECT_EQ(index_of(Joint::palm), 0u);
  EXPECT_EQ(index_of(Joint::wrist), 1u);
  EXPECT_EQ(index_of(Joint::thumb_tip), 5u);
  EXPECT_EQ(index_of(Joint::little_tip), 25u);
}

TEST(Hand, WebXrNamesGiveEveryJoint) {
  EXPECT_EQ(joint_from_webxr_name("pinky-finger-phalanx-proximal"), Joint::little_proximal);
  EXPECT_EQ(joint_from_webxr_name("thumb-phalanx-distal"), Joint::thumb_distal);
  EXPECT_EQ(joint_from_webxr_name("wrist"), Joint::wrist);
  EXPECT_FALSE(joint_from_webxr_name("elbow").has_value());
}

TEST(Hand, NumbersThatAreNotFiniteMakeAHandUnusable) {
  HandPose hand = test::sample_hand();
  EXPECT_TRUE(is_usable(hand));
  hand[Joint::ring_tip].position.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_usable(hand));
  hand = test::sample_hand();
  hand[Joint::wrist].position.x() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(is_usable(hand));
  hand = test::sample_hand();
  hand[Joint::index_tip].rotation.coeffs().setZero();
  EXPECT_FALSE(is_usable(hand));
}

/// A device need not know how thick a finger is.
TEST(Hand, ARadiusThatIsNoNumberDoesNot) {
  HandPose hand = test::sample_hand();
  hand.radius[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(is_usable(hand));
}

TEST(Hand, AJointFarFromTheWristMakesAHandUnusable) {
  HandPose hand = test::sample_hand();
  hand[Joint::index_tip].position.z() -= 0.6;
  EXPECT_FALSE(is_usable(hand));
}

TEST(Hand, SoDoesAHandFarFromTheWorld) {
  for (const double x : {1.1e6, 1e160, 1e300}) {
    HandPose hand = test::sample_hand();
    for (Pose& joint : hand.joints) joint.position.x() += x;
    EXPECT_FALSE(is_usable(hand)) << x;
  }
}

TEST(Hand, AFaultSaysWhyAHandIsUnusable) {
  const HandPose good = test::sample_hand();
  EXPECT_FALSE(fault_of(good));
  HandPose hand = good;
  hand[Joint::palm].position.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fault_of(hand), HandFault::not_finite);
  hand = good;
  hand[Joint::palm].rotation.coeffs() *= 1.0006;
  EXPECT_EQ(fault_of(hand), HandFault::rotation_not_unit);
  hand = test::placed_hand(good, {2e6, 0.0, 0.0});
  EXPECT_EQ(fault_of(hand), HandFault::wrist_far);
  hand = good;
  hand[Joint::index_tip].position.z() -= 0.6;
  EXPECT_EQ(fault_of(hand), HandFault::joint_far);
  hand = good;
  for (Pose& joint : hand.joints) joint.position.setZero();
  EXPECT_EQ(fault_of(hand), HandFault::no_length);
}

TEST(Hand, RotationsAreMadeUnitWhereTheyAreMeantTo) {
  HandPose hand = test::sample_hand();
  const HandPose good = hand;
  hand[Joint::palm].rotation.coeffs() *= 1.0006;
  hand[Joint::thumb_tip].rotation.coeffs() *= 1.9;
  hand[Joint::ring_tip].rotation.coeffs() *= 1.0001;
  const HandPose unit = with_unit_rotations(hand);
  EXPECT_TRUE(is_usable(unit));
  EXPECT_NEAR(unit[Joint::thumb_tip].rotation.angularDistance(good[Joint::thumb_tip].rotation), 0.0,
              1e-7);
  EXPECT_EQ(unit[Joint::ring_tip], hand[Joint::ring_tip]) << "bit for bit";
  for (const double factor : {0.0, 0.4, 2.1}) {
    hand[Joint::palm].rotation.coeffs() = factor * good[Joint::palm].rotation.coeffs();
    EXPECT_FALSE(is_usable(with_unit_rotations(hand))) << factor;
  }
}

TEST(Hand, MirroringTwiceGivesTheHandBack) {
  const HandPose hand = test::placed_hand(test::sample_hand(), {0.1, 0.2, 0.3},
                                          Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized())));
  const HandPose back = mirrored(mirrored(hand));
  EXPECT_EQ(mirrored(hand).side, Handedness::left);
  for (std::size_t i = 0; i < kJointCount; ++i) {
    EXPECT_EQ(back.joints[i].position, hand.joints[i].position);
    EXPECT_EQ(back.joints[i].rotation.coeffs(), hand.joints[i].rotation.coeffs());
  }
}

TEST(Hand, MirroredFramesStillPointToTheTip) {
  const HandPose left = test::sample_hand(Handedness::left);
  const Vec3 bone = left[Joint::index_intermediate].position - left[Joint::index_proximal].position;
  EXPECT_LT((left[Joint::index_proximal].rotation * -Vec3::UnitZ() - bone.normalized()).norm(),
            1e-12);
}

TEST(Hand, ThePalmOfADeviceWithoutOneIsTheMiddleOfTheMiddleMetacarpal) {
  const HandPose hand = test::sample_hand();
  const Pose palm = palm_from_middle_metacarpal(hand);
  const Vec3 from = hand[Joint::middle_metacarpal].position;
  const Vec3 to = hand[Joint::middle_proximal].position;
  EXPECT_LT((palm.position - 0.5 * (from + to)).norm(), 1e-15);
}

}  // namespace
}  // namespace nade
