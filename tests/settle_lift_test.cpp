#include <gtest/gtest.h>

#include <algorithm>

#include "nade/corrector.h"
#include "support/hand_checks.h"
#include "support/meshes.h"
#include "support/pressed_hand.h"

// Hands whose digits meet a side of the object on their way over it.

namespace nade {
namespace {

using test::kFrame_ns;
using test::pressed_hand;

/// A thumb that hangs before the edge, lower than the palm, was left there when the hand went on,
/// fingers first, and turned it by 37 to 40 degrees.
TEST(SettleLift, AThumbBeforeAnEdgeComesOverIt) {
  constexpr int kDown = 60;
  constexpr int kWay = 170;
  const auto surface = test::block({0.16F, 0.0125F, 0.07F});
  const Object object(*surface);
  for (const double depth_m : {0.015, 0.025}) {
    HandCorrector corrector(test::settling());
    double turned_rad = 0.0;
    for (int i = 0; i < kDown + 2 * kWay; ++i) {
      const double down = std::min(1.0, static_cast<double>(i) / kDown);
      const int gone = std::clamp(i - kDown, 0, kWay) - std::clamp(i - kDown - kWay, 0, kWay);
      const HandPose tracked =
          pressed_hand(-0.06 + down * (0.06 + depth_m), 0.0, {0.0, 0.0, 0.13 - 0.0015 * gone});
      const HandPose drawn = corrector.update(tracked, object, i * kFrame_ns).pose;
      const Quat& wrist = drawn[Joint::wrist].rotation;
      turned_rad = std::max(turned_rad, wrist.angularDistance(tracked[Joint::wrist].rotation));
      EXPECT_LT(-test::lowest_skin(drawn, object), 0.001);
    }
    EXPECT_LT(turned_rad, 0.45) << depth_m << " m deep";
  }
}

}  // namespace
}  // namespace nade
