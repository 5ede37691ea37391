#include "nade/hand_check.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/sample_hand.h"

namespace nade {
namespace {

HandPose somewhere(Handedness side = Handedness::right) {
  return test::placed_hand(test::sample_hand(side), {0.3, 1.2, -0.4},
                           Quat(Eigen::AngleAxisd(2.0, Vec3(1, -2, 3).normalized())));
}

HandPose turned(HandPose hand, const Quat& turn_joint) {
  for (Pose& joint : hand.joints) joint.rotation = joint.rotation * turn_joint;
  return hand;
}

HandPose scaled(HandPose hand, double factor) {
  for (Pose& joint : hand.joints) joint.position *= factor;
  return hand;
}

TEST(HandCheck, AGoodHandShowsNothing) {
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    const HandCheck check = check_hand(somewhere(side));
    for (const bool doubt : check.doubts) EXPECT_FALSE(doubt);
    EXPECT_FALSE(check.cause);
    EXPECT_NEAR(check.bone_angle_rad, 0.0, 0.03);
    EXPECT_NEAR(check.length_m, 0.096, 0.001);
  }
}

TEST(HandCheck, AFistIsAHand) {
  HandAngles angles{};
  for (std::size_t d = 1; d < kDigitCount; ++d) {
    for (HingeAngles& hinge : angles[d]) hinge.flexion = test::rad(85.0);
  }
  EXPECT_FALSE(check_hand(test::sample_hand(Handedness::left, angles)).cause);
}

TEST(HandCheck, QuaternionsWithWFirst) {
  HandPose hand = somewhere();
  for (Pose& joint : hand.joints) {
    const Quat q = joint.rotation;
    joint.rotation.coeffs() << q.w(), q.x(), q.y(), q.z();
  }
  EXPECT_EQ(check_hand(hand).cause, HandCause::quaternion_order);
}

TEST(HandCheck, ALeftHandedFrame) {
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    HandPose hand = somewhere(side);
    for (Pose& joint : hand.joints) {
      joint.position.z() *= -1.0;
      joint.rotation.x() *= -1.0;
      joint.rotation.y() *= -1.0;
    }
    const HandCheck check = check_hand(hand);
    EXPECT_TRUE(check.has(HandDoubt::bones));
    EXPECT_EQ(check.cause, HandCause::mirrored);
  }
}

TEST(HandCheck, AFrameMirroredFromThePalmToTheBack) {
  HandPose hand = test::sample_hand();
  for (Pose& joint : hand.joints) {
    joint.position.y() *= -1.0;
    joint.rotation.x() *= -1.0;
    joint.rotation.z() *= -1.0;
  }
  const HandCheck check = check_hand(hand);
  EXPECT_TRUE(check.has(HandDoubt::bend));
  EXPECT_EQ(check.cause, HandCause::upside_down);
}

TEST(HandCheck, SidesSwapped) {
  HandPose hand = somewhere();
  hand.side = Handedness::left;
  const HandCheck check = check_hand(hand);
  EXPECT_FALSE(check.has(HandDoubt::bones));
  EXPECT_TRUE(check.has(HandDoubt::back));
  EXPECT_EQ(check.cause, HandCause::swapped_sides);
}

TEST(HandCheck, OtherBoneAxesAreNamed) {
  const Quat quarter(Eigen::AngleAxisd(test::rad(90.0), Vec3::UnitY()));
  HandCheck check = check_hand(turned(somewhere(), quarter));
  EXPECT_EQ(check.cause, HandCause::other_bone_axes);
  EXPECT_EQ(name_of(check.bone_axis), "+X");
  EXPECT_EQ(name_of(check.back_axis), "+Y");
  const Quat rolled(Eigen::AngleAxisd(test::rad(-90.0), Vec3::UnitZ()));
  check = check_hand(turned(somewhere(), rolled));
  EXPECT_EQ(check.cause, HandCause::other_bone_axes);
  EXPECT_EQ(name_of(check.bone_axis), "-Z");
  EXPECT_EQ(name_of(check.back_axis), "-X");
}

TEST(HandCheck, RotationsThatWereNeverSet) {
  HandPose hand = somewhere();
  for (Pose& joint : hand.joints) joint.rotation = Quat::Identity();
  EXPECT_EQ(check_hand(hand).cause, HandCause::no_rotations);
}

TEST(HandCheck, UnitsOfLength) {
  for (const double metres : {1e-3, 1e-2, 0.0254, 0.3048, 1e3}) {
    const HandCheck check = check_hand(scaled(somewhere(), 1.0 / metres));
    EXPECT_TRUE(check.has(HandDoubt::length));
    EXPECT_EQ(check.cause, HandCause::other_units);
    EXPECT_EQ(check.unit_m, metres);
  }
  EXPECT_EQ(check_hand(scaled(somewhere(), 1.6)).cause, HandCause::unknown);
  EXPECT_FALSE(check_hand(scaled(somewhere(), 0.7)).cause) << "a child's";
}

TEST(HandCheck, AllJointsInOnePoint) {
  const HandCheck check = check_hand(scaled(somewhere(), 0.0));
  EXPECT_TRUE(check.has(HandDoubt::unusable));
  EXPECT_EQ(check.cause, HandCause::collapsed);
}

TEST(HandCheck, WhatIsNoHandAtAllIsUnusable) {
  HandPose hand = somewhere();
  hand[Joint::ring_tip].position.x() = std::numeric_limits<double>::quiet_NaN();
  const HandCheck check = check_hand(hand);
  EXPECT_TRUE(check.has(HandDoubt::unusable));
  EXPECT_FALSE(check.cause);
}

}  // namespace
}  // namespace nade
