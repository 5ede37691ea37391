#include "mouse_hand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "nade/eval/noise.h"
#include "nade/eval/press.h"
#include "nade/eval/synth.h"
#include "support/viewer_assets.h"

namespace nade::viewer {
namespace {

constexpr double kStep_s = 1.0 / 60.0;

/// From above, with -Z up in the picture.
Aim from_above(double x, double z) {
  Aim aim;
  aim.ray = Ray{Vec3(x, 0.5, z), -Vec3::UnitY()};
  aim.viewer_ahead = -Vec3::UnitY();
  aim.viewer_up = -Vec3::UnitZ();
  return aim;
}

Vec3 palm_skin_of(const HandPose& hand) { return *palm_skin(hand); }

class MouseHandTest : public testing::Test {
 protected:
  MouseHandTest() : hand_(test::relaxed_hand()) { hand_.place(plane_object_, {}); }

  HandPose rest(const Object& object, const Aim& aim, double seconds) {
    HandPose pose;
    for (double t = 0.0; t < seconds; t += kStep_s) pose = hand_.update(object, aim, kStep_s);
    return pose;
  }

  PlaneSurface plane_;
  Object plane_object_{plane_};
  MouseHand hand_;
};

TEST_F(MouseHandTest, PalmSkinLiesUnderTheCursorAtTheDepthSet) {
  hand_.settings().depth_m = 0.015;
  const HandPose pose = rest(plane_object_, from_above(0.1, -0.05), 1.0);
  EXPECT_TRUE(is_usable(pose));
  EXPECT_LT((palm_skin_of(pose) - Vec3(0.1, -0.015, -0.05)).norm(), 1e-3);
  EXPECT_GT(pose.back().y(), 0.999);
}

TEST_F(MouseHandTest, FingersPointAwayFromTheViewer) {
  const HandPose pose = rest(plane_object_, from_above(0.0, 0.0), 1.0);
  const Vec3 ahead = pose[Joint::palm].rotation * -Vec3::UnitZ();
  EXPECT_GT(ahead.dot(-Vec3::UnitZ()), 0.85);
  EXPECT_LT(ahead.x(), -0.4) << "a right hand comes from the right";
  hand_.settings().turn_rad = 90.0 * kDegree;
  const HandPose turned = rest(plane_object_, from_above(0.0, 0.0), 1.0);
  const Vec3 now = turned[Joint::palm].rotation * -Vec3::UnitZ();
  EXPECT_NEAR(std::acos(now.dot(ahead)), 90.0 * kDegree, 0.5 * kDegree);
  EXPECT_GT(ahead.cross(now).y(), 0.99);
}

TEST_F(MouseHandTest, FingersFollowTheMotionWhereAsked) {
  hand_.settings().heading = Heading::with_motion;
  HandPose pose;
  for (int i = 0; i < 120; ++i) {
    pose = hand_.update(plane_object_, from_above(0.15 * i * kStep_s, 0.0), kStep_s);
  }
  EXPECT_GT((pose[Joint::palm].rotation * -Vec3::UnitZ()).dot(Vec3::UnitX()), 0.95);
}

TEST_F(MouseHandTest, StrokeLagsLessThanTwoFrames) {
  constexpr double kSpeed = 0.2;
  HandPose pose;
  double x = 0.0;
  for (int i = 0; i < 90; ++i) {
    x = kSpeed * i * kStep_s;
    pose = hand_.update(plane_object_, from_above(x, 0.0), kStep_s);
  }
  EXPECT_LT((x - palm_skin_of(pose).x()) / kSpeed, 2.0 * kStep_s);
}

TEST_F(MouseHandTest, StillCursorThatTremblesByAPixelIsSteadied) {
  rest(plane_object_, from_above(0.0, 0.0), 0.5);
  double largest = 0.0;
  Vec3 before = palm_skin_of(hand_.update(plane_object_, from_above(0.0, 0.0), kStep_s));
  for (int i = 0; i < 60; ++i) {
    const double x = i % 2 == 0 ? 0.001 : 0.0;
    const Vec3 now = palm_skin_of(hand_.update(plane_object_, from_above(x, 0.0), kStep_s));
    largest = std::max(largest, (now - before).norm());
    before = now;
  }
  EXPECT_LT(largest, 0.0006);
}

TEST_F(MouseHandTest, LeapOfTheCursorDoesNotFlingTheHand) {
  rest(plane_object_, from_above(0.0, 0.0), 0.5);
  Vec3 before = palm_skin_of(hand_.update(plane_object_, from_above(0.0, 0.0), kStep_s));
  for (int i = 0; i < 30; ++i) {
    const Vec3 now = palm_skin_of(hand_.update(plane_object_, from_above(1.0, 0.0), kStep_s));
    EXPECT_LT((now - before).norm() / kStep_s, 2.6);
    before = now;
  }
}

TEST_F(MouseHandTest, BesideTheObjectTheHandIsFree) {
  const SphereSurface sphere(0.1);
  const Object ball(sphere);
  hand_.place(ball, {Vec3(0.0, 0.1, 0.0), Quat::Identity()});
  rest(ball, from_above(0.0, 0.0), 0.5);
  const HandPose pose = rest(ball, from_above(0.25, 0.0), 1.0);
  EXPECT_GT(palm_skin_of(pose).norm(), 0.13);
  EXPECT_TRUE(is_usable(pose));
}

TEST_F(MouseHandTest, CurlsSpreadsTiltsAndChangesSides) {
  const HandPose flat = rest(plane_object_, from_above(0.0, 0.0), 1.0);
  hand_.settings().shape.curl = 1.0;
  hand_.settings().tilt_rad = 20.0 * kDegree;
  const HandPose curled = rest(plane_object_, from_above(0.0, 0.0), 1.0);
  const auto bend = [](const HandPose& hand) {
    return measure_angles(hand)[index_of(Digit::middle)][1].flexion;
  };
  EXPECT_NEAR(bend(curled) - bend(flat), 27.0 * kDegree, 0.5 * kDegree);
  EXPECT_NEAR(curled.back().y(), std::cos(20.0 * kDegree), 1e-3);
  hand_.settings().side = Handedness::left;
  const HandPose left = rest(plane_object_, from_above(0.0, 0.0), 0.1);
  EXPECT_EQ(left.side, Handedness::left);
  EXPECT_TRUE(is_usable(left));
}

TEST_F(MouseHandTest, WildCursorsGiveUsableHands) {
  Result<LoadedObject> dog = load_object("dog");
  ASSERT_TRUE(dog.ok());
  const Object object = dog->placed();
  hand_.place(object, dog->place()->pose);
  Random random(7);
  for (int i = 0; i < 2'000; ++i) {
    Aim aim;
    const Vec3 direction(random.normal(), random.normal(), random.normal());
    if (i % 7 != 0) aim.ray = Ray{-1.5 * direction.normalized(), direction.normalized()};
    aim.viewer_ahead = direction.normalized();
    aim.viewer_up = direction.unitOrthogonal();
    ASSERT_TRUE(is_usable(hand_.update(object, aim, i % 3 == 0 ? 0.1 : 1e-4))) << i;
  }
}

}  // namespace
}  // namespace nade::viewer
