#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "nade/corrector.h"
#include "nade/flesh.h"
#include "support/hand_checks.h"
#include "support/meshes.h"
#include "support/pressed_hand.h"

// Hands that strike the object: pats and slaps.

namespace nade {
namespace {

using test::kFrame_ns;
using test::lowest_skin;
using test::plane;
using test::pressed_hand;
using test::settling;

/// Of a part's lowest skin above y = 0.
double height_of(Part part, const HandPose& hand) {
  const HandFlesh& flesh = generic_flesh(hand.side);
  const double scale = hand_length(hand) / flesh.hand_length_m;
  double lowest = std::numeric_limits<double>::infinity();
  for (const FleshPad& pad : flesh.pads) {
    if (pad.part != part) continue;
    for (std::size_t k = pad.first; k < pad.first + pad.count; ++k) {
      lowest = std::min(lowest, position_of(flesh.skin[k], hand, scale).y());
    }
  }
  return lowest;
}

/// Three times a second up and down about a depth, and about a tilt.
struct Pats {
  double mean_depth_m = 0.0;
  double amplitude_m = 0.0;
  double amplitude_rad = 0.0;

  [[nodiscard]] HandPose at(int frame) const {
    const double swing = std::cos(3.0 * 2.0 * std::numbers::pi * frame / 90.0);
    return pressed_hand(mean_depth_m - amplitude_m * swing, amplitude_rad * swing);
  }
};

const Pats kFromTheArm{0.0, 0.1, 0.0};
const Pats kSmall{0.0, 0.05, 0.0};
const Pats kFromTheWrist{0.02, 0.0, 0.35};

/// The person's hand is sent off again while it is still deep in the table. The drawn one, which
/// takes on its speed, must not leave before: its parts hovered by 10 to 60 mm.
TEST(ProxyStrike, AHandThatPatsRestsForAsLongAsThePersonPresses) {
  for (const Pats& pats : {kFromTheArm, kSmall, kFromTheWrist}) {
    HandCorrector corrector(settling());
    for (int i = 0; i < 180; ++i) {
      const HandPose tracked = pats.at(i);
      const HandPose& drawn = corrector.update(tracked, plane(), i * kFrame_ns).pose;
      if (i < 15) continue;  // until it has come down once
      for (std::size_t p = 0; p < kPartCount; ++p) {
        const Part part = part_at(p);
        if (height_of(part, tracked) > -0.004) continue;
        EXPECT_LT(height_of(part, drawn), 0.02) << "part " << p << ", frame " << i;
      }
    }
  }
}

/// A slap goes right through a tabletop, and comes back from below. The drawn hand, sent off while
/// the person's was still under the table, was up to 170 mm above it.
TEST(ProxyStrike, AHandThatSlapsThroughATableStaysOnIt) {
  const auto top = test::block({0.4F, 0.01F, 0.4F});
  const Object table(*top);
  HandCorrector corrector(settling());
  for (int i = 0; i < 120; ++i) {
    const double down = std::clamp(i / 38.0, 0.0, 1.0);
    const double up = std::clamp((i - 56) / 38.0, 0.0, 1.0);
    const auto eased = [](double t) { return t * t * t * (10.0 - 15.0 * t + 6.0 * t * t); };
    const HandPose tracked = pressed_hand(-0.25 + 0.35 * (eased(down) - eased(up)));
    const HandPose& drawn = corrector.update(tracked, table, i * kFrame_ns).pose;
    if (height_of(Part::palm, tracked) > -0.004) continue;
    EXPECT_LT(height_of(Part::palm, drawn), 0.02) << "frame " << i;
    EXPECT_LT(lowest_skin(drawn, table), 0.002) << "frame " << i;
  }
}

/// Nor does it stay behind for long once that hand is out.
TEST(ProxyStrike, AHandThatPatsIsSoonWithThePersonsAgain) {
  HandCorrector corrector(settling());
  double sum = 0.0;
  int frames = 0;
  for (int i = 0; i < 180; ++i) {
    const HandPose tracked = kFromTheArm.at(i);
    const HandPose& drawn = corrector.update(tracked, plane(), i * kFrame_ns).pose;
    const Vec3 off = drawn[Joint::palm].position - tracked[Joint::palm].position;
    if (height_of(Part::palm, tracked) < 0.03) continue;
    sum += off.squaredNorm();
    ++frames;
  }
  EXPECT_LT(std::sqrt(sum / frames), 0.05);
}

}  // namespace
}  // namespace nade
