#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>

#include "nade/corrector.h"
#include "nade/mesh.h"
#include "support/hand_checks.h"
#include "support/meshes.h"
#include "support/pressed_hand.h"

// What is remembered from frame to frame, and what has to be forgotten.

namespace nade {
namespace {

using test::all_finite;
using test::ball;
using test::kFrame_ns;
using test::least_room;
using test::on_the_way_down;
using test::plane;
using test::pressed_hand;
using test::settling;

// A copy had no room for its rows: it allocated in the frame, and wrote to what it had freed.
static_assert(!std::is_copy_constructible_v<HandCorrector>);
static_assert(std::is_nothrow_move_constructible_v<HandCorrector>);

/// A hitch of 150 ms: the pads did not see so far, took the solid for air, and the hand stayed in
/// it.
TEST(ProxyMemory, AHandThatSinksFarInOneFrameIsDrawnOut) {
  for (const double depth_m : {0.04, 0.07, 0.09, 0.11, 0.13}) {
    HandCorrector corrector(settling());
    HandPose drawn;
    for (int i = 0; i < 10; ++i) {
      drawn = corrector.update(pressed_hand(-0.01), plane(), i * kFrame_ns).pose;
    }
    for (int i = 0; i < 90; ++i) {
      const std::int64_t time_ns = (10 + 14 + i) * kFrame_ns;
      drawn = corrector.update(pressed_hand(depth_m), plane(), time_ns).pose;
    }
    EXPECT_GT(least_room(drawn, plane()), -0.001) << depth_m << " m deep";
  }
}

TEST(ProxyMemory, ABallThatGrowsUnderAHandDoesNotSwallowIt) {
  for (const double scale : {1.3, 1.7, 2.5}) {
    HandCorrector corrector(settling());
    HandPose drawn;
    Placement placement{{{0.0, -0.15, 0.0}, Quat::Identity()}, 1.0};
    for (int i = 0; i < 180; ++i) {
      if (i == 90) placement.scale = scale;
      drawn =
          corrector.update(pressed_hand(0.01), Object(test::kBall, placement), i * kFrame_ns).pose;
    }
    EXPECT_GT(least_room(drawn, Object(test::kBall, placement)), -0.001) << scale;
  }
}

/// One such frame made the hand NaN for good.
/// It jumped by 76 mm, and on a board it was found on the other side for good.
TEST(ProxyMemory, AnObjectThatIsNowhereForAFrameLosesNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Pose on_top{{0.0, -0.01, 0.0}, Quat::Identity()};
  const auto board = MeshSurface::build(test::box_mesh({0.2F, 0.01F, 0.2F}), "board").value();
  for (const Object& object :
       {Object(test::kPlane, {on_top, 1.0}), Object(*board, {on_top, 1.0})}) {
    for (const Pose& nowhere :
         {Pose{{0.0, nan, 0.0}, Quat::Identity()}, Pose{{}, Quat(0.0, 0.0, 0.0, 0.0)},
          Pose{{2e6, 0.0, 0.0}, Quat::Identity()}}) {
      HandCorrector corrector(settling());
      HandPose drawn;
      for (int i = 0; i < 160; ++i) {
        const Object now(object.surface(), {i == 0 || i == 120 ? nowhere : on_top, 1.0});
        const HandPose tracked = on_the_way_down(std::min(i, 90), 90, 0.06);
        const HandPose next = corrector.update(tracked, now, i * kFrame_ns).pose;
        ASSERT_TRUE(all_finite(next)) << "frame " << i;
        if (i > 100) {
          EXPECT_LT(largest_motion(drawn, next), 0.004) << "frame " << i;
        }
        drawn = next;
      }
      EXPECT_GT(least_room(drawn, object), -0.001);
      EXPECT_GT(drawn[Joint::palm].position.y(), 0.0);
    }
  }
}

/// A surface built where another was has the same address.
TEST(ProxyMemory, AnotherBallInItsPlaceIsSeen) {
  HandCorrector corrector(settling());
  std::optional<SphereSurface> surface;
  HandPose drawn;
  for (int i = 0; i < 60; ++i) {
    surface.emplace(0.1 + 0.001 * i);
    const Object object(*surface, {{{0.0, -0.12, 0.0}, Quat::Identity()}, 1.0});
    drawn = corrector.update(pressed_hand(0.0), object, i * kFrame_ns).pose;
    ASSERT_GT(least_room(drawn, object), -0.002) << "frame " << i;
  }
}

/// One much larger, in one frame: the hand lay 141 mm deep in it for good. It is out in less
/// than half a second.
TEST(ProxyMemory, AMuchLargerBallInItsPlaceDoesNotSwallowTheHand) {
  HandCorrector corrector(settling());
  std::optional<SphereSurface> surface;
  HandPose drawn;
  for (int i = 0; i < 120; ++i) {
    surface.emplace(i < 60 ? 0.15 : 0.26);
    const Object object(*surface, {{{0.0, -0.15, 0.0}, Quat::Identity()}, 1.0});
    const HandPose now = corrector.update(pressed_hand(0.01), object, i * kFrame_ns).pose;
    if (i > 0) {
      ASSERT_LT(largest_motion(drawn, now), 0.02) << "frame " << i;
    }
    if (i < 60 || i > 98) {
      ASSERT_GT(least_room(now, object), -0.002) << "frame " << i;
    }
    drawn = now;
  }
}

/// The little finger's knuckle stays just above a ball while the hand rolls about it: a pad whose
/// middle stayed was not looked at, and its skin turned in (by 1.3 mm once).
TEST(ProxyMemory, SkinThatTurnsAboutItsPadIsSeen) {
  const HandPose hand = test::generic_size_hand();
  const Pose& pivot = hand[Joint::little_proximal];
  for (int trial = 0; trial < 10; ++trial) {
    HandCorrector corrector(settling());
    for (int i = 0; i < 300; ++i) {
      const double time_s = i / 90.0;
      const double angle = -1.65 + 0.01 * trial + 1.58 * std::sin(1.25 * time_s);
      const Quat turn(Eigen::AngleAxisd(angle, pivot.rotation * Vec3::UnitZ()));
      const double aside_m = 0.001 * std::sin(3.0 * time_s);
      const Vec3 place = Vec3(aside_m, 0.0049, aside_m) - turn * pivot.position;
      const HandPose drawn =
          corrector.update(moved(hand, {place, turn}), ball(), i * kFrame_ns).pose;
      ASSERT_GT(least_room(drawn, ball()), -0.0001) << "trial " << trial << ", frame " << i;
    }
  }
}

/// A frame far out, and whatever was stroked before: after a reset all of it is as if it was not.
TEST(ProxyMemory, AResetForgetsEverything) {
  HandCorrector used(settling());
  for (int i = 0; i < 60; ++i) {
    (void)used.update(pressed_hand(0.02, 0.1, {0.002 * i, 0.0, 0.0}), ball(), i * kFrame_ns);
  }
  (void)used.update(pressed_hand(0.0, 0.0, {1e14, 0.0, 0.0}), ball(), 60 * kFrame_ns);
  used.reset();
  HandCorrector anew(settling());
  for (int i = 0; i < 90; ++i) {
    const HandPose tracked = pressed_hand(-0.05 + 0.001 * i, 0.0, {0.001 * i, 0.0, 0.0});
    const HandPose& expected = anew.update(tracked, ball(), i * kFrame_ns).pose;
    const HandPose& drawn = used.update(tracked, ball(), i * kFrame_ns).pose;
    for (std::size_t j = 0; j < kJointCount; ++j) {
      ASSERT_EQ(drawn.joints[j].position, expected.joints[j].position) << "frame " << i;
    }
  }
}

/// Times of any origin are farther apart than 64 bits hold.
TEST(ProxyMemory, TimesMayBeAnyWayApart) {
  HandCorrector corrector(settling());
  constexpr std::int64_t kFirst_ns = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kLast_ns = std::numeric_limits<std::int64_t>::max();
  (void)corrector.update(pressed_hand(0.02), plane(), kFirst_ns);
  const HandPose& drawn = corrector.update(pressed_hand(0.03), plane(), kLast_ns).pose;
  EXPECT_GT(least_room(drawn, plane()), -0.001);
}

}  // namespace
}  // namespace nade
