#include "nade/openxr.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "support/hand_checks.h"
#include "support/sample_hand.h"

namespace nade {
namespace {

constexpr XrSpaceLocationFlags kAll =
    XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT |
    XR_SPACE_LOCATION_POSITION_TRACKED_BIT | XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT;

std::array<XrHandJointLocationEXT, XR_HAND_JOINT_COUNT_EXT> located(const HandPose& hand) {
  std::array<XrHandJointLocationEXT, XR_HAND_JOINT_COUNT_EXT> joints{};
  for (XrHandJointLocationEXT& joint : joints) {
    joint.locationFlags = kAll;
    joint.radius = 0.01F;
  }
  openxr::put_hand(hand, joints);
  return joints;
}

TEST(OpenXr, AHandGoesThereAndBack) {
  const HandPose hand = test::generic_size_hand();
  const auto joints = located(hand);
  const auto back = openxr::hand_from(Handedness::right, joints);
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->confidence, 1.0);
  for (std::size_t i = 0; i < kJointCount; ++i) {
    EXPECT_LT((back->joints[i].position - hand.joints[i].position).norm(), 1e-7);
    EXPECT_LT(back->joints[i].rotation.angularDistance(hand.joints[i].rotation), 1e-6);
    EXPECT_FLOAT_EQ(static_cast<float>(back->radius[i]), 0.01F);
  }
}

TEST(OpenXr, AJointThatIsInferredHalvesTheConfidence) {
  auto joints = located(test::generic_size_hand());
  joints[XR_HAND_JOINT_RING_TIP_EXT].locationFlags =
      XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT;
  EXPECT_EQ(openxr::hand_from(Handedness::right, joints)->confidence, 0.5);
}

TEST(OpenXr, WhatIsNoHandHasNoValue) {
  auto joints = located(test::generic_size_hand());
  joints[XR_HAND_JOINT_RING_TIP_EXT].locationFlags = XR_SPACE_LOCATION_POSITION_VALID_BIT;
  EXPECT_FALSE(openxr::hand_from(Handedness::right, joints));
  joints = located(test::generic_size_hand());
  joints[XR_HAND_JOINT_WRIST_EXT].pose.position.y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(openxr::hand_from(Handedness::right, joints));
}

TEST(OpenXr, VelocitiesAreThoseOfTheDrawnHand) {
  const HandPose before = test::generic_size_hand();
  HandPose now = before;
  const Quat turn(Eigen::AngleAxisd(0.02, Vec3::UnitY()));
  for (Pose& joint : now.joints) {
    joint.position += Vec3(0.001, 0.0, -0.002);
    joint.rotation = turn * joint.rotation;
  }
  std::array<XrHandJointVelocityEXT, XR_HAND_JOINT_COUNT_EXT> joints{};
  openxr::put_velocities(before, now, 0.01, joints);
  for (const XrHandJointVelocityEXT& joint : joints) {
    EXPECT_EQ(joint.velocityFlags,
              XR_SPACE_VELOCITY_LINEAR_VALID_BIT | XR_SPACE_VELOCITY_ANGULAR_VALID_BIT);
    EXPECT_NEAR(joint.linearVelocity.x, 0.1, 1e-6);
    EXPECT_NEAR(joint.linearVelocity.z, -0.2, 1e-6);
    EXPECT_NEAR(joint.angularVelocity.y, 2.0, 1e-5);
  }
  openxr::put_velocities(before, now, 0.0, joints);
  EXPECT_EQ(joints[0].velocityFlags, 0U);
}

}  // namespace
}  // namespace nade
