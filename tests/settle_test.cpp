#include "nade/settle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "nade/corrector.h"
#include "nade/mesh.h"
#include "support/allocation_counter.h"
#include "support/hand_checks.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/sample_hand.h"

namespace nade {
namespace {

using test::generic_size_hand;
using test::lowest_skin;
using test::rad;
using test::same_bits;
using test::settling;

constexpr std::int64_t kFrame_ns = 11'111'111;

const PlaneSurface kPlane;
const SphereSurface kBall(0.15);

Object plane() { return Object(kPlane); }
/// Its top at y = 0.
Object ball() { return Object(kBall, {{{0.0, -0.15, 0.0}, Quat::Identity()}, 1.0}); }

/// The palm's skin `depth_m` below y = 0, tilted about the hand's lateral axis.
HandPose pressed_hand(double depth_m, double tilt_rad = 0.0, const Vec3& along = Vec3::Zero(),
                      const HandPose& hand = generic_size_hand()) {
  const Quat tilt(Eigen::AngleAxisd(tilt_rad, Vec3::UnitX()));
  const double skin_m = generic_skin_depths()[Part::palm];
  return test::placed_hand(hand, tilt * Vec3(0.0, skin_m, 0.0) - Vec3(0.0, depth_m, 0.0) + along,
                           tilt);
}

/// Flexion of PIP and DIP, the mean of the four fingers.
double curl_of(const HandPose& hand) {
  const HandAngles angles = measure_angles(hand);
  double sum = 0.0;
  for (std::size_t d = 1; d < kDigitCount; ++d) sum += angles[d][1].flexion + angles[d][2].flexion;
  return sum / 4.0;
}

/// Down from above, `frames` frames, to the palm's depth.
HandPose on_the_way_down(int frame, int frames, double depth_m, double tilt_rad = 0.0) {
  const double share = std::min(1.0, static_cast<double>(frame) / frames);
  return pressed_hand(-0.08 + share * (0.08 + depth_m), tilt_rad);
}

TEST(Settle, AnUntouchedHandComesBackBitEqual) {
  HandCorrector corrector(settling());
  for (int i = 0; i < 5; ++i) {
    const HandPose hand = pressed_hand(-0.2, 0.1, {0.01 * i, 0.0, 0.0});
    const CorrectedHand& result = corrector.update(hand, ball(), i * kFrame_ns);
    EXPECT_EQ(result.status, HandStatus::free);
    EXPECT_TRUE(same_bits(result.pose, hand));
  }
}

TEST(Settle, NoSkinIsInTheObjectAndSomeTouchesIt) {
  for (const Object& object : {plane(), ball()}) {
    for (const double tilt : {-0.4, 0.0, 0.4}) {
      HandCorrector corrector(settling());
      for (int i = 0; i <= 120; ++i) {
        const HandPose tracked = on_the_way_down(i, 90, 0.04, tilt);
        const CorrectedHand& result = corrector.update(tracked, object, i * kFrame_ns);
        const double lowest = lowest_skin(result.pose, object);
        ASSERT_GT(lowest, -0.0005) << "frame " << i << ", tilt " << tilt;
        if (lowest_skin(tracked, object) < -0.002) {
          EXPECT_LT(lowest, 0.002) << "frame " << i << ", tilt " << tilt;
          EXPECT_EQ(result.status, HandStatus::corrected);
        }
      }
    }
  }
}

TEST(Settle, TheCorrectionStartsFromNothingAtFirstTouch) {
  HandCorrector corrector(settling());
  double depth_m = -0.08;
  HandPose tracked = pressed_hand(depth_m);
  std::int64_t time_ns = 0;
  while (corrector.update(tracked, plane(), time_ns).status == HandStatus::free) {
    time_ns += kFrame_ns;
    depth_m += 5e-5;
    tracked = pressed_hand(depth_m);
    ASSERT_LT(depth_m, 0.0);
  }
  EXPECT_LT(largest_motion(tracked, corrector.update(tracked, plane(), time_ns).pose), 0.001);
}

TEST(Settle, FingersThatArePushedUpKeepTheirCurl) {
  HandCorrector corrector(settling());
  HandAngles angles = test::relaxed_angles();
  std::int64_t time_ns = 0;
  for (int i = 0; i <= 90; ++i, time_ns += kFrame_ns) {
    corrector.update(on_the_way_down(i, 90, 0.02), plane(), time_ns);
  }
  const double relaxed = curl_of(generic_size_hand());
  HandPose drawn;
  for (int i = 0; i <= 60; ++i, time_ns += kFrame_ns) {
    for (std::size_t d = 1; d < kDigitCount; ++d) {
      angles[d][1].flexion = rad(16.0 + 0.5 * i);
      angles[d][2].flexion = rad(4.0 + 0.3 * i);
    }
    const HandPose hand = generic_size_hand(Handedness::right, angles);
    drawn = corrector.update(pressed_hand(0.02, 0.0, Vec3::Zero(), hand), plane(), time_ns).pose;
    ASSERT_GT(lowest_skin(drawn, plane()), -0.0005) << i;
  }
  EXPECT_GT(curl_of(drawn) - relaxed, 0.8 * rad(48.0));
}

/// All joints flexed by 0.7 rad, as far as they can be.
HandPose gripping_hand() {
  HandAngles angles = test::relaxed_angles();
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    for (std::size_t i = 0; i < kHingeCount; ++i) {
      const HingeRange range = range_of_motion(digit_at(d), i);
      angles[d][i].flexion = std::clamp(0.7, range.flexion_min, range.flexion_max);
    }
  }
  return generic_size_hand(Handedness::right, angles);
}

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

/// Where digits reach around a ball, planes alone send bends to and fro, frame after frame.
TEST(Settle, AHandThatGripsABallAndGoesStraightOnDoesNotTremble) {
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

/// A hand that stroked a ball's side and goes straight up has a correction left when it is free.
TEST(Settle, AHandThatLeavesABallIsNotThrownBack) {
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

/// A palm that comes down at 0.2 m/s is braked over some frames, not in one, and then touches.
TEST(Settle, AHandLandsWithoutAJolt) {
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

/// A mesh in millimetres is drawn at a thousandth of its size.
TEST(Settle, AnObjectsOwnUnitsDoNotMatter) {
  const SphereSurface in_metres(0.06);
  const SphereSurface in_millimetres(60.0);
  HandCorrector first(settling());
  HandCorrector second(settling());
  for (int i = 0; i < 60; ++i) {
    const Vec3 palm(0.001 * (i - 30), 0.04, 0.04);
    const HandPose tracked = test::placed_hand(gripping_hand(), palm, Quat::Identity());
    const CorrectedHand& one = first.update(tracked, Object(in_metres), kFrame_ns * i);
    const CorrectedHand& other =
        second.update(tracked, Object(in_millimetres, {Pose{}, 0.001}), kFrame_ns * i);
    ASSERT_EQ(one.status, HandStatus::corrected) << "frame " << i;
    ASSERT_LT(largest_motion(one.pose, other.pose), 1e-5) << "frame " << i;
  }
}

/// One end of a tilted hand lands first. Then it turns about that by itself, and lands once more.
TEST(Settle, ATiltedHandLandsWithoutAJolt) {
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

/// Down onto the surface, ten centimetres ahead, and up again, each from rest to rest.
TEST(Settle, AStrokeRunsAsCalmlyAsThePersonsOwn) {
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
    EXPECT_LT(jitter(drawn), 1.2 * jitter(tracked));
  }
}

/// At 500 frames a second the brake once undid what drew the fingers down: the thumb hovered 5 mm
/// above the table.
TEST(Settle, AHandRestsAlikeAtAnyFrameRate) {
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

/// A finger that the surface lets go of, and one that is drawn to it, take their time.
TEST(Settle, NoJointOutrunsThePerson) {
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

/// How far a hand sinks in says how high it is held, and that how far it sinks in.
TEST(Settle, ASoftBallIsPressedSteadily) {
  CorrectorOptions options = settling();
  options.settle.softness_m = 0.01;
  HandCorrector corrector(options);
  for (int i = 0; i < 90; ++i) {
    const double depth_m = 0.01 + 0.001 * std::min(i, 30);
    const CorrectedHand& result = corrector.update(pressed_hand(depth_m), ball(), i * kFrame_ns);
    if (i > 5) {
      EXPECT_EQ(result.status, HandStatus::corrected) << "frame " << i;
    }
    if (i > 60) {
      EXPECT_LT(lowest_skin(result.pose, ball()), -0.004) << "frame " << i;
    }
  }
}

TEST(Settle, ADeepHandThatIsFoundComesOut) {
  for (const Object& object : {plane(), ball()}) {
    HandCorrector corrector(settling());
    const HandPose tracked = pressed_hand(0.06, 0.2);
    EXPECT_GT(lowest_skin(corrector.update(tracked, object, 0).pose, object), -0.002);
  }
}

TEST(Settle, AHandOnItsWayOutIsFreeInTheEnd) {
  HandCorrector corrector(settling());
  std::int64_t time_ns = 0;
  HandPose before;
  for (int i = 0; i <= 330; ++i, time_ns += kFrame_ns) {
    const HandPose tracked = on_the_way_down(i < 150 ? i : std::max(0, 300 - i), 90, 0.03);
    const CorrectedHand& result = corrector.update(tracked, ball(), time_ns);
    if (i > 0) {
      EXPECT_LT(largest_motion(before, result.pose), 0.009) << "frame " << i;
    }
    if (i == 290) {  // a third of a second after it left the ball
      EXPECT_LT(largest_motion(tracked, result.pose), 0.0005);
    }
    before = result.pose;
  }
  const HandPose away = pressed_hand(-0.08);
  EXPECT_EQ(corrector.update(away, ball(), time_ns).status, HandStatus::free);
  EXPECT_TRUE(same_bits(corrector.update(away, ball(), time_ns).pose, away));
}

TEST(Settle, TheLeftHandIsTheRightOneInTheMirror) {
  HandCorrector left(settling());
  HandCorrector right(settling());
  for (int i = 0; i <= 120; ++i) {
    const HandPose tracked = on_the_way_down(i, 90, 0.03, 0.2);
    const HandPose a = right.update(tracked, ball(), i * kFrame_ns).pose;
    const HandPose b = left.update(mirrored(tracked), ball(), i * kFrame_ns).pose;
    ASSERT_LT(largest_motion(a, mirrored(b)), 1e-6) << "frame " << i;
  }
}

TEST(Settle, HandAndObjectMovedTogetherGiveTheSame) {
  test::Random random;
  SCOPED_TRACE(testing::Message() << "NADE_TEST_SEED=" << test::seed());
  for (int trial = 0; trial < 4; ++trial) {
    const Pose motion{random.point({-2.0, -2.0, -2.0}, {2.0, 2.0, 2.0}), random.rotation()};
    const Object moved_ball(kBall, {motion * ball().placement().pose, 1.0});
    HandCorrector here(settling());
    HandCorrector there(settling());
    for (int i = 0; i <= 120; ++i) {
      const HandPose tracked = on_the_way_down(i, 90, 0.03, 0.2);
      const HandPose a = here.update(tracked, ball(), i * kFrame_ns).pose;
      const HandPose b = there.update(moved(tracked, motion), moved_ball, i * kFrame_ns).pose;
      ASSERT_LT(largest_motion(moved(a, motion), b), 1e-5) << "frame " << i;
    }
  }
}

TEST(Settle, AnObjectThatRisesCarriesTheHand) {
  HandCorrector corrector(settling());
  const HandPose tracked = pressed_hand(-0.06);
  HandPose before = tracked;
  for (int i = 0; i <= 120; ++i) {
    const double height_m = 0.001 * i;
    const Object object(kBall, {{{0.0, -0.15 + height_m, 0.0}, Quat::Identity()}, 1.0});
    const HandPose drawn = corrector.update(tracked, object, i * kFrame_ns).pose;
    ASSERT_GT(lowest_skin(drawn, object), -0.001) << "frame " << i;
    ASSERT_LT(largest_motion(before, drawn), 0.006) << "frame " << i;
    before = drawn;
  }
}

TEST(Settle, AMeshThatSwellsPushesTheHandOut) {
  const TriangleSoup soup = test::icosphere(0.15F, 4);
  const auto surface = MeshSurface::build(soup, "ball").value();
  HandCorrector corrector(settling());
  const HandPose tracked = pressed_hand(-0.01, 0.0, {0.0, 0.15, 0.0});
  std::vector<Eigen::Vector3f> vertices = soup.vertices;
  for (int i = 0; i <= 60; ++i) {
    const float growth = 1.0F + 0.002F * static_cast<float>(i);
    for (std::size_t k = 0; k < vertices.size(); ++k) vertices[k] = growth * soup.vertices[k];
    surface->refit(vertices);
    const Object object(*surface);
    const HandPose drawn = corrector.update(tracked, object, i * kFrame_ns).pose;
    ASSERT_GT(lowest_skin(drawn, object), -0.001) << "frame " << i;
  }
}

TEST(Settle, VisibleFrictionLagsByABoundedAmountAndNeverJumps) {
  CorrectorOptions options = settling();
  options.settle.friction.coefficient = 0.5;
  HandCorrector rubbing(options);
  HandCorrector smooth(settling());
  constexpr double kDepth_m = 0.02;
  double longest_m = 0.0;
  HandPose before;
  for (int i = 0; i <= 400; ++i) {
    const double along_m = 0.001 * std::max(0, i - 120);
    HandPose tracked = i < 120 ? on_the_way_down(i, 90, kDepth_m)
                               : pressed_hand(kDepth_m, 0.0, {0.0, 0.0, -along_m});
    const HandPose drawn = rubbing.update(tracked, plane(), i * kFrame_ns).pose;
    const HandPose free = smooth.update(tracked, plane(), i * kFrame_ns).pose;
    longest_m =
        std::max(longest_m, (drawn[Joint::palm].position - free[Joint::palm].position).norm());
    if (i > 120) {
      EXPECT_LT(largest_motion(before, drawn), 0.004) << "frame " << i;
    }
    before = drawn;
  }
  EXPECT_GT(longest_m, 0.004);
  EXPECT_LT(longest_m, 0.5 * (kDepth_m + 0.03));
}

TEST(Settle, SkinSinksIntoASoftObjectAsFarAsItIsSoft) {
  CorrectorOptions options = settling();
  options.settle.softness_m = 0.006;
  HandCorrector corrector(options);
  double lowest = 0.0;
  for (int i = 0; i <= 120; ++i) {
    const HandPose tracked = on_the_way_down(i, 90, 0.04);
    lowest = lowest_skin(corrector.update(tracked, plane(), i * kFrame_ns).pose, plane());
    ASSERT_GT(lowest, -0.0065) << "frame " << i;
  }
  EXPECT_LT(lowest, -0.003);
}

TEST(Settle, AFrameAllocatesNothingAndRepeatsToTheBit) {
  HandCorrector first(settling());
  HandCorrector second(settling());
  for (int i = 0; i <= 100; ++i) {
    const HandPose tracked = on_the_way_down(i, 90, 0.03, 0.3);
    HandPose a;
    const auto count =
        test::allocations_of([&] { a = first.update(tracked, ball(), i * kFrame_ns).pose; });
    EXPECT_EQ(count, 0U) << "frame " << i;
    EXPECT_TRUE(same_bits(a, second.update(tracked, ball(), i * kFrame_ns).pose)) << i;
  }
}

}  // namespace
}  // namespace nade
