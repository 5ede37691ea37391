// Cameras by name and by numbers: what they look at is in the picture.

#include "nade/draw/camera.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nade::draw {
namespace {

/// Where a point is in the picture: both within [-1, 1] inside it; positive depth before the eye.
struct Seen {
  double across = 0.0;
  double up = 0.0;
  double depth_m = 0.0;
};

Seen seen_by(const Camera& camera, const Vec3& point) {
  const Vec3 local = camera.pose.inverse().apply(point);
  const double depth = -local.z();
  return {local.x() / depth / std::tan(camera.view.right),
          local.y() / depth / std::tan(camera.view.up), depth};
}

TEST(Camera, NamesComeBack) {
  for (const View view :
       {View::front, View::side, View::top, View::three_quarter, View::first_person}) {
    EXPECT_EQ(view_from_name(name_of(view)), view);
  }
  EXPECT_EQ(view_from_name("below"), std::nullopt);
  EXPECT_EQ(view_from_name(""), std::nullopt);
}

TEST(Camera, NamedViewsFrameTheBall) {
  const Vec3 center(0.3, -0.2, 1.0);
  constexpr double kRadius = 0.13;
  for (const View view : {View::front, View::side, View::top, View::three_quarter}) {
    const Camera camera = framed(view, center, kRadius).camera(1.5);
    const Seen middle = seen_by(camera, center);
    EXPECT_NEAR(middle.across, 0.0, 1e-9);
    EXPECT_NEAR(middle.up, 0.0, 1e-9);
    double highest = 0.0;
    for (int i = 0; i < 200; ++i) {
      const double polar = std::acos(1.0 - 2.0 * (i + 0.5) / 200.0);
      const Vec3 way(std::sin(polar) * std::cos(2.4 * i), std::cos(polar),
                     std::sin(polar) * std::sin(2.4 * i));
      const Seen seen = seen_by(camera, center + kRadius * way);
      EXPECT_GT(seen.depth_m, camera.near_m) << name_of(view);
      EXPECT_LE(std::abs(seen.up), 1.0) << name_of(view);
      EXPECT_LE(std::abs(seen.across), 1.0) << name_of(view);
      highest = std::max(highest, std::abs(seen.up));
    }
    EXPECT_GT(highest, 0.8) << name_of(view) << ": the ball should fill the picture";
  }
}

TEST(Camera, UpIsUp) {
  const Camera camera = looking_at({1.0, 1.0, 1.0}, Vec3::Zero(), 0.6, 1.0);
  EXPECT_GT(seen_by(camera, {0.0, 0.1, 0.0}).up, 0.0);
}

TEST(Camera, StraightDownHasMinusZUp) {
  const Camera camera = looking_at({0.0, 1.0, 0.0}, Vec3::Zero(), 0.6, 1.0);
  EXPECT_NEAR(camera.pose.rotation.norm(), 1.0, 1e-9);
  EXPECT_GT(seen_by(camera, {0.0, 0.0, -0.1}).up, 0.1);
  EXPECT_GT(seen_by(camera, {0.1, 0.0, 0.0}).across, 0.1);
}

TEST(Camera, EyeAtItsTargetStillLooksSomewhere) {
  const Camera camera = looking_at(Vec3::Ones(), Vec3::Ones(), 0.6, 1.0);
  EXPECT_TRUE(camera.pose.rotation.coeffs().allFinite());
}

TEST(Camera, SteepOrbitsStopShortOfThePole) {
  Orbit orbit;
  orbit.elevation_rad = 3.0;
  const Camera camera = orbit.camera(1.0);
  EXPECT_GT(camera.pose.position.y(), 0.99 * orbit.distance_m);
  EXPECT_TRUE(camera.pose.rotation.coeffs().allFinite());
}

TEST(Camera, FirstPersonSeesTheHandFromBehindAndAbove) {
  HandPose hand;
  hand[Joint::wrist].position = {0.5, 0.1, 0.0};
  hand[Joint::middle_proximal].position = {0.5, 0.1, -0.09};
  const Camera camera = first_person(hand, 1.6);
  EXPECT_GT(camera.pose.position.y(), 0.2);
  EXPECT_GT(camera.pose.position.z(), 0.05);
  const Seen fingers = seen_by(camera, {0.5, 0.1, -0.18});
  const Seen wrist = seen_by(camera, hand[Joint::wrist].position);
  EXPECT_LT(std::abs(fingers.up), 0.9);
  EXPECT_GT(fingers.up, wrist.up);
  EXPECT_LT(std::abs(wrist.up), 1.0);
}

TEST(Camera, FirstPersonOfAHandThatPointsDown) {
  HandPose hand;
  hand[Joint::wrist].position = {0.0, 0.1, 0.0};
  hand[Joint::middle_proximal].position = {0.0, 0.0, 0.0};
  EXPECT_TRUE(first_person(hand, 1.6).pose.rotation.coeffs().allFinite());
}

}  // namespace
}  // namespace nade::draw
