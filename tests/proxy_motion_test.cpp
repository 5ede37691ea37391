#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "nade/corrector.h"
#include "support/hand_checks.h"
#include "support/pressed_hand.h"

// How the drawn hand moves from frame to frame.

namespace nade {
namespace {

using test::ball;
using test::gripping_hand;
using test::kFrame_ns;
using test::lowest_skin;
using test::on_the_way_down;
using test::plane;
using test::pressed_hand;
using test::rad;
using test::settling;

/// How far a joint is from halfway between where it was and where it will be.
double unevenness(const HandPose& before, const HandPose& now, const HandPose& after) {
  double most = 0.0;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Vec3 halfway = 0.5 * (before.joints[i].position + after.joints[i].position);
    most = std::max(most, (halfway - now.joints[i].position).norm());
  }
  return most;
}

double most_uneven(std::span<const HandPose> drawn) {
  double most_m = 0.0;
  for (std::size_t i = 2; i < drawn.size(); ++i) {
    most_m = std::max(most_m, unevenness(drawn[i - 2], drawn[i - 1], drawn[i]));
  }
  return most_m;
}

/// The root of the sum of all joints' squared second differences, of which the metric
/// `jitter_ratio` is the ratio.
double jitter(std::span<const HandPose> hands) {
  double sum = 0.0;
  for (std::size_t i = 2; i < hands.size(); ++i) {
    for (std::size_t j = 0; j < kJointCount; ++j) {
      sum += (hands[i].joints[j].position - 2.0 * hands[i - 1].joints[j].position +
              hands[i - 2].joints[j].position)
                 .squaredNorm();
    }
  }
  return std::sqrt(sum);
}

/// Where digits reach around a ball, planes alone send bends to and fro, frame after frame.
TEST(ProxyMotion, AHandThatGripsABallAndGoesStraightOnDoesNotTremble) {
  const HandPose hand = gripping_hand();
  for (const auto& [radius_m, depth_m] : {std::pair{0.06, 0.02}, {0.06, 0.04}, {0.07, 0.06}}) {
    const SphereSurface surface(radius_m);
    HandCorrector corrector(settling());
    std::vector<HandPose> drawn;
    for (int i = 0; i < 60; ++i) {
      const Vec3 palm(0.0005 * (i - 30), radius_m - depth_m, 0.04);
      const HandPose tracked = test::placed_hand(hand, palm, Quat::Identity());
      drawn.push_back(corrector.update(tracked, Object(surface), kFrame_ns * i).pose);
    }
    std::vector<double> uneven;
    for (std::size_t i = 1; i + 1 < drawn.size(); ++i) {
      uneven.push_back(unevenness(drawn[i - 1], drawn[i], drawn[i + 1]));
    }
    std::sort(uneven.begin(), uneven.end());
    EXPECT_LT(uneven[uneven.size() / 2], 0.00015) << radius_m << " m, " << depth_m << " m deep";
  }
}

/// Where a surface turns, circle after circle leads the drawn hand a little farther aside.
TEST(ProxyMotion, CirclesOnABallDoNotLeadTheHandAway) {
  constexpr double kRadius_m = 0.05;
  constexpr double kSpeed_mps = 0.2;
  const SphereSurface surface(0.1);
  const Object object(surface, {{{0.0, -0.1, 0.0}, Quat::Identity()}, 1.0});
  HandCorrector corrector(settling());
  double farthest_m = 0.0;
  for (int i = 0; i < 30 * 90; ++i) {
    const double turn = kSpeed_mps / kRadius_m * i / 90.0;
    const Vec3 aside = kRadius_m * Vec3(std::cos(turn) - 1.0, 0.0, std::sin(turn));
    const HandPose tracked = pressed_hand(0.02, 0.0, aside);
    const HandPose drawn = corrector.update(tracked, object, kFrame_ns * i).pose;
    const Vec3 off = drawn[Joint::palm].position - tracked[Joint::palm].position;
    farthest_m = std::max(farthest_m, off.norm());
  }
  EXPECT_LT(farthest_m, 0.05);
}

/// A hand that stroked a ball's side and goes straight up has a correction left when it is free.
TEST(ProxyMotion, AHandThatLeavesABallIsNotThrownBack) {
  HandCorrector corrector(settling());
  std::vector<HandPose> drawn;
  std::size_t free_from = 0;
  for (int i = 0; i < 160; ++i) {
    const Vec3 along(0.0, 0.0, -0.001 * std::min(i, 60));
    const double depth_m = 0.02 - 0.002 * std::max(0, i - 80);
    const CorrectedHand& result =
        corrector.update(pressed_hand(depth_m, 0.0, along), ball(), i * kFrame_ns);
    drawn.push_back(result.pose);
    if (result.status == HandStatus::corrected) free_from = drawn.size();
  }
  ASSERT_GT(free_from, 0U);
  ASSERT_LT(free_from + 40, drawn.size());
  EXPECT_LT(most_uneven(std::span(drawn).subspan(free_from - 1)), 0.0006);
}

/// Pressed deep into a ball's side a hand is drawn far from the person's own. In the air it comes
/// back while that moves, and when that keeps still: it went by 12 mm a second then.
TEST(ProxyMotion, AHandThatLeavesFarFromThePersonsOwnComesBack) {
  HandCorrector corrector(settling());
  std::vector<double> away_m;
  std::vector<HandPose> drawn;
  for (int i = 0; i < 300; ++i) {
    const Vec3 along(0.0, 0.0, 0.001 * std::min(i, 60));
    const double depth_m = 0.08 - 0.01 * std::clamp(i - 90, 0, 16);  // then it rests in the air
    const HandPose tracked = pressed_hand(depth_m, 0.0, along);
    drawn.push_back(corrector.update(tracked, ball(), i * kFrame_ns).pose);
    away_m.push_back(largest_motion(tracked, drawn.back()));
  }
  EXPECT_GT(away_m[106], 0.015);
  EXPECT_LT(away_m[220], 0.01);  // a second later
  EXPECT_LT(away_m[299], 0.002);
  for (std::size_t i = 132; i < drawn.size(); ++i) {
    EXPECT_LT(largest_motion(drawn[i - 1], drawn[i]), 0.002) << "frame " << i;
  }
}

/// Skin that the person's own hovers over is drawn down to the ball and stays on it, however the
/// ball turns under it: it has landed, and needs no cushion to land on.
TEST(ProxyMotion, AStrokeRunsOverABallAndOffItWithoutAKick) {
  struct Crossing {
    double radius_m, depth_m, tilt_rad;
  };
  for (const Crossing& stroke :
       {Crossing{0.06, 0.005, 0.3}, {0.06, 0.0, 0.3}, {0.15, -0.004, 0.0}}) {
    const SphereSurface surface(stroke.radius_m);
    const Object object(surface, {{{0.0, -stroke.radius_m, 0.0}, Quat::Identity()}, 1.0});
    HandCorrector corrector(settling());
    std::vector<HandPose> drawn;
    for (int i = 0; i < 200; ++i) {
      const HandPose tracked =
          pressed_hand(stroke.depth_m, stroke.tilt_rad, {0.0, 0.0, 0.0015 * (i - 100)});
      drawn.push_back(corrector.update(tracked, object, i * kFrame_ns).pose);
    }
    EXPECT_LT(most_uneven(std::span(drawn).subspan(20)), 0.0004) << stroke.radius_m << " m";
  }
}

/// A palm that comes down at 0.2 m/s is braked over some frames, not in one, and then touches.
TEST(ProxyMotion, AHandLandsWithoutAJolt) {
  for (const Object& object : {plane(), ball()}) {
    HandCorrector corrector(settling());
    std::vector<HandPose> drawn;
    for (int i = 0; i < 60; ++i) {
      const double depth_m = -0.05 + 0.2 * (i / 90.0);
      drawn.push_back(corrector.update(pressed_hand(depth_m), object, i * kFrame_ns).pose);
    }
    EXPECT_LT(most_uneven(drawn), 0.0012);
    EXPECT_LT(lowest_skin(drawn.back(), object), 0.0015);
  }
}

/// One end of a tilted hand lands first. Then it turns about that by itself, and lands once more.
TEST(ProxyMotion, ATiltedHandLandsWithoutAJolt) {
  for (const double tilt_rad : {-0.5, -0.25, 0.25, 0.5}) {
    HandCorrector corrector(settling());
    std::vector<HandPose> drawn;
    for (int i = 0; i < 60; ++i) {
      const double depth_m = -0.07 + 0.2 * (i / 90.0);
      drawn.push_back(
          corrector.update(pressed_hand(depth_m, tilt_rad), plane(), i * kFrame_ns).pose);
    }
    EXPECT_LT(most_uneven(drawn), 0.0011) << tilt_rad << " rad";
  }
}

/// A hand that is thrown onto a table at 0.8 m/s, and whatever of it lands later, is brought to
/// rest over some frames.
TEST(ProxyMotion, AFastHandLandsSoftly) {
  constexpr double kStep_m = 0.8 / 90.0;
  const double stopped_dead = std::sqrt(static_cast<double>(kJointCount)) * kStep_m;
  for (const double tilt_rad : {-0.5, -0.25, 0.0, 0.25, 0.5}) {
    HandCorrector corrector(settling());
    std::vector<HandPose> drawn;
    for (int i = 0; i < 45; ++i) {
      const double depth_m = std::min(-0.09 + kStep_m * i, 0.03);
      drawn.push_back(
          corrector.update(pressed_hand(depth_m, tilt_rad), plane(), i * kFrame_ns).pose);
    }
    EXPECT_LT(jitter(drawn), 0.6 * stopped_dead) << tilt_rad << " rad";
    EXPECT_LT(lowest_skin(drawn.back(), plane()), 0.0015) << tilt_rad << " rad";
  }
}

/// One end of a tilted hand is the last to leave. The drawn one stays on the surface for as long as
/// that end of the person's own is in it, though the rest is already sent off.
TEST(ProxyMotion, ATiltedHandLeavesNoSoonerThanThePersonsOwn) {
  for (const double speeding_up_mpss : {0.8, 3.2}) {
    HandCorrector corrector(settling());
    for (int i = 0; i < 160; ++i) {
      const double risen_s = std::max(0, i - 90) / 90.0;
      const double risen_m = 0.5 * speeding_up_mpss * risen_s * risen_s;
      const double depth_m = std::min(-0.08 + 0.2 * (i / 90.0), 0.02) - risen_m;
      const HandPose tracked = pressed_hand(depth_m, 0.8);
      const HandPose& drawn = corrector.update(tracked, plane(), i * kFrame_ns).pose;
      if (lowest_skin(tracked, plane()) > -0.003) continue;
      EXPECT_LT(lowest_skin(drawn, plane()), 0.002) << speeding_up_mpss << ", frame " << i;
    }
  }
}

/// Down onto the surface, ten centimetres ahead, and up again, each from rest to rest.
TEST(ProxyMotion, AStrokeRunsAsCalmlyAsThePersonsOwn) {
  const auto eased = [](double time_s, double from_s, double seconds) {
    const double t = std::clamp((time_s - from_s) / seconds, 0.0, 1.0);
    return t * t * t * (10.0 + t * (6.0 * t - 15.0));
  };
  for (const Object& object : {plane(), ball()}) {
    HandCorrector corrector(settling());
    std::vector<HandPose> tracked;
    std::vector<HandPose> drawn;
    for (int i = 0; i < 260; ++i) {
      const double time_s = i / 90.0;
      const double depth_m = -0.05 + 0.07 * (eased(time_s, 0.0, 0.6) - eased(time_s, 2.2, 0.6));
      const Vec3 along(0.0, 0.0, 0.05 - 0.1 * eased(time_s, 0.6, 1.6));
      tracked.push_back(pressed_hand(depth_m, 0.0, along));
      drawn.push_back(corrector.update(tracked.back(), object, i * kFrame_ns).pose);
    }
    EXPECT_LT(jitter(drawn), 1.3 * jitter(tracked));
  }
}

/// While it strokes and is drawn 20 mm higher: its palm against the person's, along the ball.
TEST(ProxyMotion, ThePalmGoesAlongTheBallAsThePersonsDoes) {
  HandCorrector corrector(settling());
  Vec3 tracked_before = Vec3::Zero();
  Vec3 drawn_before = Vec3::Zero();
  SurfaceHint hint;
  double gone_m = 0.0;
  double strayed_m = 0.0;
  for (int i = 0; i < 260; ++i) {
    const double time_s = i / 90.0;
    const double depth_m = std::min(0.02, -0.05 + 0.15 * time_s);
    const double along_m = 0.05 * std::sin(3.0 * std::max(0.0, time_s - 1.0));
    const HandPose hand = pressed_hand(depth_m, 0.0, {0.0, 0.0, -along_m});
    const HandPose& pose = corrector.update(hand, ball(), i * kFrame_ns).pose;
    const Vec3 tracked = hand[Joint::palm].position;
    const Vec3 drawn = pose[Joint::palm].position;
    if (time_s > 1.0) {
      const Vec3 normal = ball().closest_point(tracked, 1.0, hint)->normal;
      const Vec3 way = tracked - tracked_before;
      gone_m += along_surface(way, normal).norm();
      strayed_m += along_surface(drawn - drawn_before - way, normal).norm();
    }
    tracked_before = tracked;
    drawn_before = drawn;
  }
  EXPECT_LT(strayed_m, 0.02 * gone_m);
}

/// At 500 frames a second the brake once undid what drew the fingers down: the thumb hovered 5 mm
/// above the table.
TEST(ProxyMotion, AHandRestsAlikeAtAnyFrameRate) {
  const auto rested = [](int rate_hz) {
    HandCorrector corrector(settling());
    HandPose drawn;
    for (int i = 0; i <= 2 * rate_hz; ++i) {
      const double time_s = static_cast<double>(i) / rate_hz;
      const HandPose tracked = pressed_hand(std::min(-0.08 + 0.15 * time_s, 0.02));
      drawn = corrector.update(tracked, plane(), std::llround(1e9 * time_s)).pose;
    }
    return drawn;
  };
  const HandPose usual = rested(90);
  for (const int rate_hz : {30, 240, 500}) {
    EXPECT_LT(largest_motion(usual, rested(rate_hz)), 0.001) << rate_hz << " frames a second";
  }
}

/// The fingers of a hand that came down and rests are not seen to sink on for seconds.
TEST(ProxyMotion, FingersLieSoonAfterTheHandRests) {
  struct Press {
    double depth_m;
    double tilt_rad;
    double later_s;
    double farthest_m;
  };
  for (const Press& press : {Press{0.01, 0.0, 0.6, 0.0025}, Press{0.02, rad(20), 1.0, 0.005}}) {
    HandCorrector corrector(settling());
    const int down = 60;
    HandPose later;
    HandPose drawn;
    for (int i = 0; i < down + 5 * 90; ++i) {
      const HandPose tracked = on_the_way_down(i, down, press.depth_m, press.tilt_rad);
      drawn = corrector.update(tracked, plane(), i * kFrame_ns).pose;
      if (i == down + std::lround(90.0 * press.later_s)) later = drawn;
    }
    EXPECT_LT(largest_motion(later, drawn), press.farthest_m) << press.depth_m << " m deep";
  }
}

/// A finger that the surface lets go of, and one that is drawn to it, take their time.
TEST(ProxyMotion, NoJointOutrunsThePerson) {
  for (const double speed_mps : {0.1, 0.3}) {
    HandCorrector corrector(settling());
    HandPose tracked_before;
    HandPose drawn_before;
    for (int i = 0; i < 120; ++i) {
      const Vec3 along(0.0, 0.0, 0.09 - speed_mps * (i / 90.0));
      const double depth_m = 0.02 - 0.002 * std::max(0, i - 100);
      const HandPose tracked = pressed_hand(depth_m, 0.0, along);
      const HandPose& drawn = corrector.update(tracked, ball(), i * kFrame_ns).pose;
      if (i > 0) {
        EXPECT_LT(largest_motion(drawn_before, drawn),
                  2.5 * largest_motion(tracked_before, tracked) + 0.0002)
            << "frame " << i << " at " << speed_mps << " m/s";
      }
      tracked_before = tracked;
      drawn_before = drawn;
    }
  }
}

}  // namespace
}  // namespace nade
