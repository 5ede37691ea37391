#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nade/corrector.h"
#include "nade/eval/noise.h"
#include "nade/skeleton.h"
#include "support/hand_checks.h"
#include "support/pressed_hand.h"

// The object draws a restless hand more strongly than a calm one.

namespace nade {
namespace {

using test::gripping_hand;
using test::kFrame_ns;
using test::placed_hand;
using test::plane;
using test::pressed_hand;
using test::settling;

/// How far a restless hand shifts by itself from frame to frame, as trackers' hands do.
constexpr double kTremor_m = 0.0003;

HandPose trembling(const HandPose& hand, Random& random) {
  const Vec3 shift(random.normal(), random.normal(), random.normal());
  return moved(hand, Pose{kTremor_m * shift, Quat::Identity()});
}

/// The drawn hand after three seconds, come down from 100 mm in the first.
HandPose drawn_at_rest(const HandPose& tracked, bool trembles) {
  HandCorrector corrector(settling());
  Random random(7);
  HandPose drawn;
  for (int i = 0; i < 270; ++i) {
    const double lift_m = 0.1 * std::max(0.0, 1.0 - i / 90.0);
    const HandPose hand = moved(tracked, Pose{Vec3(0.0, lift_m, 0.0), Quat::Identity()});
    drawn =
        corrector.update(trembles ? trembling(hand, random) : hand, plane(), i * kFrame_ns).pose;
  }
  return drawn;
}

/// Middle and last flexion, the fingers' mean.
double curl_rad(const HandPose& hand) {
  const HandAngles angles = measure_angles(hand);
  double sum = 0.0;
  for (const Digit digit : {Digit::index, Digit::middle, Digit::ring, Digit::little}) {
    sum += angles[index_of(digit)][1].flexion + angles[index_of(digit)][2].flexion;
  }
  return sum / 4.0;
}

/// On its heel, 20 mm deep, the fingers' tips up.
TEST(SettleUnrest, ARestlessHandLiesNearerToTheSurface) {
  const HandPose tracked = pressed_hand(0.02, 0.6);
  const HandPose calm = drawn_at_rest(tracked, false);
  const HandPose restless = drawn_at_rest(tracked, true);
  for (const Joint joint : {Joint::index_tip, Joint::middle_tip}) {
    EXPECT_LT(restless[joint].position.y(), 0.5 * calm[joint].position.y());
  }
}

/// Drawn as strongly as an open hand, a fist on a table was opened by 48 degrees.
TEST(SettleUnrest, AFistStaysAFist) {
  const HandPose tracked = pressed_hand(0.02, 0.0, Vec3::Zero(), gripping_hand());
  const double calm_rad = curl_rad(drawn_at_rest(tracked, false));
  EXPECT_NEAR(curl_rad(drawn_at_rest(tracked, true)), calm_rad, 0.05);
}

}  // namespace
}  // namespace nade
