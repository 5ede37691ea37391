#include <gtest/gtest.h>

#include <algorithm>

#include "nade/corrector.h"
#include "nade/skeleton.h"
#include "nade/surface_group.h"
#include "support/hand_checks.h"
#include "support/meshes.h"
#include "support/pressed_hand.h"
#include "support/sanitized.h"

// Hands whose digits meet a side of the object on their way over it.

namespace nade {
namespace {

using test::block;
using test::kFrame_ns;
using test::least_room;
using test::pressed_hand;
using test::settling;

/// A thumb that hangs before the edge, lower than the palm, was left there when the hand went on,
/// fingers first, and turned it by 37 to 40 degrees.
TEST(ProxyLift, AThumbBeforeAnEdgeComesOverIt) {
  constexpr int kDown = 60;
  constexpr int kWay = 170;
  const auto surface = block({0.16F, 0.0125F, 0.07F});
  const Object object(*surface);
  for (const double depth_m : {0.015, 0.025}) {
    if (test::kSanitized && depth_m < 0.02) continue;
    HandCorrector corrector(settling());
    double turned_rad = 0.0;
    double deepest_m = 0.0;
    for (int i = 0; i < kDown + 2 * kWay; ++i) {
      const double down = std::min(1.0, static_cast<double>(i) / kDown);
      const int gone = std::clamp(i - kDown, 0, kWay) - std::clamp(i - kDown - kWay, 0, kWay);
      const HandPose tracked =
          pressed_hand(-0.06 + down * (0.06 + depth_m), 0.0, {0.0, 0.0, 0.13 - 0.0015 * gone});
      const HandPose drawn = corrector.update(tracked, object, i * kFrame_ns).pose;
      const Quat& wrist = drawn[Joint::wrist].rotation;
      turned_rad = std::max(turned_rad, wrist.angularDistance(tracked[Joint::wrist].rotation));
      deepest_m = std::max(deepest_m, -least_room(drawn, object));
    }
    // It may come through, on the way back of a hand that was let go.
    EXPECT_LT(deepest_m, 0.015) << depth_m << " m deep";
    EXPECT_LT(turned_rad, 0.75) << depth_m << " m deep";
  }
}

/// What became of a stroke along a table, fingers first.
struct Stroke {
  double flexed_rad = 0.0;  ///< a finger's knuckle, the most
  double farthest_m = 0.0;  ///< a joint from the tracked one, the most
  double last_m = 0.0;      ///< the same in the end
  double deepest_m = 0.0;   ///< drawn skin below the surface, the most
};

/// 10 mm deep at 0.3 m/s, over a bar that is so high and 100 mm long.
Stroke stroke_over_bar(float height_m) {
  const PlaneSurface table;
  const auto bar = block({0.6F, 0.5F * height_m, 0.05F});
  const Pose there{{0.0, height_m, -0.25}, Quat::Identity()};
  const SurfaceGroup group({Object(table), Object(*bar, {there, 1.0})});
  const Object object(group);
  HandCorrector corrector(settling());
  Stroke stroke;
  for (int i = 0; i < 300; ++i) {
    const double depth_m = std::min(0.01, -0.05 + 0.0015 * i);
    const double way_m = std::clamp((i - 60) / 300.0, 0.0, 0.7);
    const HandPose tracked = pressed_hand(depth_m, 0.0, {0.0, 0.0, 0.1 - way_m});
    const HandPose drawn = corrector.update(tracked, object, i * kFrame_ns).pose;
    stroke.last_m = largest_motion(tracked, drawn);
    stroke.farthest_m = std::max(stroke.farthest_m, stroke.last_m);
    stroke.deepest_m = std::max(stroke.deepest_m, -least_room(drawn, object));
    const HandAngles angles = measure_angles(drawn);
    for (std::size_t d = 1; d < kDigitCount; ++d) {
      stroke.flexed_rad = std::max(stroke.flexed_rad, angles[d][0].flexion);
    }
  }
  return stroke;
}

/// They folded under the hand, by 90 degrees, and stayed so.
TEST(ProxyLift, FingersGoOverALowBar) {
  for (const float height_m : {0.005F, 0.01F, 0.02F, 0.03F}) {
    if (test::kSanitized && height_m < 0.03F) continue;
    SCOPED_TRACE(testing::Message() << "bar of " << height_m << " m");
    const Stroke stroke = stroke_over_bar(height_m);
    EXPECT_LT(stroke.flexed_rad, 65.0 * kDegree);
    EXPECT_LT(stroke.farthest_m, 0.16);
    EXPECT_LT(stroke.last_m, 0.1);
    EXPECT_LT(stroke.deepest_m, 0.003);
  }
}

/// Before a high one they cannot; once the hand is past it, they come back.
TEST(ProxyLift, AHandPastAHighBarIsWhole) { EXPECT_LT(stroke_over_bar(0.1F).last_m, 0.06); }

/// Nor do they climb a wall that the hand rests before.
TEST(ProxyLift, FingersStayBeforeAWall) {
  const PlaneSurface table;
  const auto wall = block({0.6F, 0.2F, 0.05F});
  const Pose there{{0.0, 0.4, -0.25}, Quat::Identity()};
  const SurfaceGroup group({Object(table), Object(*wall, {there, 1.0})});
  const Object object(group);
  HandCorrector corrector(settling());
  for (int i = 0; i < 300; ++i) {
    const double way_m = std::min(0.001 * i, 0.12);
    const HandPose tracked = pressed_hand(0.0, 0.0, {0.0, 0.0, 0.0 - way_m});
    const HandPose drawn = corrector.update(tracked, object, i * kFrame_ns).pose;
    EXPECT_LT(drawn[Joint::middle_tip].position.y(), 0.05) << "frame " << i;
    EXPECT_GT(least_room(drawn, object), -0.003) << "frame " << i;
  }
}

}  // namespace
}  // namespace nade
