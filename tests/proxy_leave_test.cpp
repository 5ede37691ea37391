#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "nade/corrector.h"
#include "support/hand_checks.h"
#include "support/meshes.h"
#include "support/pressed_hand.h"

// Hands that an object holds up after the person's own has left it.

namespace nade {
namespace {

using test::block;
using test::kFrame_ns;
using test::least_room;
using test::lowest_skin;
using test::pressed_hand;
using test::settling;

/// The share of a second from `from_s` on, both 0 to 1.
double gone(int frame, double from_s) { return std::clamp(frame / 90.0 - from_s, 0.0, 1.0); }

/// Frames of six seconds: how far the drawn hand is from the tracked one in each.
std::vector<double> away_from(const std::function<HandPose(int)>& tracked_at, const Object& object,
                              HandPose& drawn) {
  HandCorrector corrector(settling());
  std::vector<double> away_m;
  for (int i = 0; i < 540; ++i) {
    const HandPose tracked = tracked_at(i);
    drawn = corrector.update(tracked, object, i * kFrame_ns).pose;
    away_m.push_back(largest_motion(tracked, drawn));
  }
  return away_m;
}

/// From the side into a block, up, and to rest above it: it stayed at the side for
/// good.
TEST(ProxyLeave, AHandThatIsLiftedOverAnEdgeComesBack) {
  const auto surface = block({0.2F, 0.1F, 0.2F});
  HandPose drawn;
  const auto away_m = away_from(
      [](int i) {
        const double depth_m = 0.06 - 0.12 * gone(i, 1.5);
        return pressed_hand(depth_m, 0.0, {0.35 - 0.18 * gone(i, 0.0), 0.0, 0.0});
      },
      Object(*surface), drawn);
  EXPECT_GT(away_m[130], 0.05);
  EXPECT_LT(away_m.back(), 0.001);
}

/// Down through a block and on, to rest below it: it hung on the upper side for good. It is home
/// half a second after the person's hand is out.
TEST(ProxyLeave, AHandThatWentRightThroughComesBackInTheEnd) {
  const auto surface = block({0.05F, 0.05F, 0.05F});
  HandPose drawn;
  const auto away_m = away_from([](int i) { return pressed_hand(-0.1 + 0.4 * gone(i, 0.0)); },
                                Object(*surface), drawn);
  EXPECT_GT(*std::max_element(away_m.begin(), away_m.end()), 0.08);
  EXPECT_LT(away_m[90 + 45], 0.001);
  EXPECT_LT(away_m.back(), 0.001);
}

/// Where it was let go, 1.26 m from the person's.
TEST(ProxyLeave, AThrownBoardTakesTheHandAlongNoFartherThanItMust) {
  const auto surface = block({0.2F, 0.02F, 0.15F});
  const HandPose tracked = pressed_hand(0.0);
  HandCorrector corrector(settling());
  double farthest_m = 0.0;
  double away_m = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double height_m = -0.8 + 5.0 * i / 90.0;
    const Object object(*surface, {{{0.01, height_m, 0.01}, Quat::Identity()}, 1.0});
    away_m = largest_motion(tracked, corrector.update(tracked, object, i * kFrame_ns).pose);
    farthest_m = std::max(farthest_m, away_m);
  }
  EXPECT_LT(farthest_m, 0.65);
  EXPECT_LT(away_m, 0.01);
}

/// As before, and then into the block's top, soon after it was let go: it was drawn 85 mm deep in
/// it for two seconds, and jumped out of it by 76 mm.
TEST(ProxyLeave, AHandThatWasLetGoMayPressAgain) {
  const auto surface = block({0.2F, 0.15F, 0.2F});
  const Object object(*surface);
  HandCorrector corrector(settling());
  HandPose tracked = pressed_hand(0.06, 0.0, {0.32, 0.0, 0.0});
  HandPose drawn = tracked;
  int deep_frames = 0;
  for (int i = 0; i < 450; ++i) {
    const double lift_m = std::min(0.1, gone(i, 0.9) / 3.0);
    const double press_m = 0.3 * std::min(0.3, gone(i, 2.7));
    const HandPose next = pressed_hand(0.06 - lift_m + press_m, 0.0,
                                       {0.32 - 0.5 * std::min(0.6, gone(i, 0.2)), 0.0, 0.0});
    const HandPose out = corrector.update(next, object, i * kFrame_ns).pose;
    const double way_m = largest_motion(drawn, out);
    const bool pressed = lowest_skin(next, object) < 0.0;
    if (i < 243) {  // until then in the air, or in at the side
      EXPECT_LT(way_m, 0.003 + 3.0 * largest_motion(tracked, next)) << "frame " << i;
    }
    EXPECT_LT(way_m, 0.02) << "frame " << i;
    tracked = next;
    drawn = out;
    if (pressed && least_room(drawn, object) < -0.002) ++deep_frames;
  }
  EXPECT_LT(deep_frames, 27);
  EXPECT_TRUE(test::rests_on(object, drawn));
}

/// A thin board is no reason to be let go.
TEST(ProxyLeave, AHandPressedThroughABoardStaysOnTheSideItCameFrom) {
  const auto surface = block({0.2F, 0.005F, 0.2F});
  const Object object(*surface);
  HandPose drawn;
  (void)away_from([](int i) { return pressed_hand(-0.06 + 0.14 * gone(i, 0.0)); }, object, drawn);
  EXPECT_GT(drawn[Joint::palm].position.y(), 0.0);
  EXPECT_TRUE(test::rests_on(object, drawn));
}

/// Into a block's front, 20 mm below its top, onto the top and to rest there: it hung before the
/// front for good, 340 mm off.
TEST(ProxyLeave, AHandThatPressesElsewhereComesBack) {
  const auto surface = block({0.3F, 0.1F, 0.2F});
  const Object object(*surface);
  HandPose drawn;
  const auto away_m = away_from(
      [](int i) {
        return pressed_hand(0.02 - 0.01 * gone(i, 1.5), 0.0, {0.0, 0.0, 0.4 - 0.4 * gone(i, 0.5)});
      },
      object, drawn);
  EXPECT_GT(*std::max_element(away_m.begin(), away_m.end()), 0.08);
  EXPECT_LT(away_m.back(), 0.09);
  EXPECT_TRUE(test::rests_on(object, drawn));
}

}  // namespace
}  // namespace nade
