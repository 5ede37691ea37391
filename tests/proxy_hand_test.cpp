#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "nade/corrector.h"
#include "nade/mesh.h"
#include "support/allocation_counter.h"
#include "support/hand_checks.h"
#include "support/meshes.h"
#include "support/pressed_hand.h"
#include "support/random.h"
#include "support/sample_hand.h"
#include "support/sanitized.h"

namespace nade {
namespace {

using test::ball;
using test::generic_size_hand;
using test::gripping_hand;
using test::kFrame_ns;
using test::least_room;
using test::lowest_skin;
using test::on_the_way_down;
using test::plane;
using test::pressed_hand;
using test::rad;
using test::same_bits;
using test::settling;

TEST(ProxyHand, NoSkinIsInTheObjectAndSomeTouchesIt) {
  for (const Object& object : {plane(), ball()}) {
    for (const double tilt : {-0.4, 0.0, 0.4}) {
      if (test::kSanitized && tilt != 0.0) continue;
      HandCorrector corrector(settling());
      for (int i = 0; i <= 120; ++i) {
        const HandPose tracked = on_the_way_down(i, 90, 0.04, tilt);
        const CorrectedHand& result = corrector.update(tracked, object, i * kFrame_ns);
        const double lowest = lowest_skin(result.pose, object);
        ASSERT_GT(least_room(result.pose, object), -0.0005) << "frame " << i << ", tilt " << tilt;
        if (lowest_skin(tracked, object) < -0.002) {
          EXPECT_LT(lowest, 0.004) << "frame " << i << ", tilt " << tilt;
          EXPECT_EQ(result.status, HandStatus::corrected);
        }
      }
    }
  }
}

TEST(ProxyHand, TheCorrectionStartsFromNothingAtFirstTouch) {
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

TEST(ProxyHand, FingersThatArePushedUpKeepTheirCurl) {
  HandCorrector corrector(settling());
  HandAngles angles = test::relaxed_angles();
  std::int64_t time_ns = 0;
  for (int i = 0; i <= 90; ++i, time_ns += kFrame_ns) {
    corrector.update(on_the_way_down(i, 90, 0.02), plane(), time_ns);
  }
  const double relaxed = curl_of(measure_angles(generic_size_hand()));
  HandPose drawn;
  for (int i = 0; i <= 60; ++i, time_ns += kFrame_ns) {
    for (std::size_t d = 1; d < kDigitCount; ++d) {
      angles[d][1].flexion = rad(16.0 + 0.5 * i);
      angles[d][2].flexion = rad(4.0 + 0.3 * i);
    }
    const HandPose hand = generic_size_hand(Handedness::right, angles);
    drawn = corrector.update(pressed_hand(0.02, 0.0, Vec3::Zero(), hand), plane(), time_ns).pose;
    ASSERT_GT(least_room(drawn, plane()), -0.0005) << i;
  }
  EXPECT_GT(curl_of(measure_angles(drawn)) - relaxed, 0.5 * rad(48.0));
}

/// A mesh in millimetres is drawn at a thousandth of its size.
TEST(ProxyHand, AnObjectsOwnUnitsDoNotMatter) {
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

/// How far a hand sinks in says how high it is held, and that how far it sinks in.
TEST(ProxyHand, ASoftBallIsPressedSteadily) {
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

TEST(ProxyHand, ADeepHandThatIsFoundComesOut) {
  for (const Object& object : {plane(), ball()}) {
    HandCorrector corrector(settling());
    const HandPose tracked = pressed_hand(0.06, 0.2);
    EXPECT_GT(least_room(corrector.update(tracked, object, 0).pose, object), -0.002);
  }
}

TEST(ProxyHand, WhatIsPressedInOfAHandThatIsFoundLiesOnTheSurface) {
  // Tilted, deep, and its thumb farther from the surface than its skin would push it there.
  HandCorrector corrector(settling());
  const HandPose tracked = pressed_hand(0.042, 0.5);
  const CorrectedHand& result = corrector.update(tracked, plane(), 0);
  EXPECT_GT(least_room(result.pose, plane()), -0.0005);
  EXPECT_LT(tracked[Joint::thumb_tip].position.y(), -0.01);
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const auto skin_height_m = [&](const HandPose& hand) {
      return hand[joint_of(part_at(i))].position.y() - generic_skin_depths().depth_m[i];
    };
    if (skin_height_m(tracked) > -0.01) continue;
    EXPECT_LT(skin_height_m(result.pose), 0.008) << name_of(part_at(i));
  }
}

/// Fingers that reach through a board by 16 mm and more are drawn on the side that the palm is on.
TEST(ProxyHand, AHandThatIsFoundAcrossABoardIsDrawnOnItsPalmsSide) {
  const auto board = MeshSurface::build(test::box_mesh({0.2F, 0.004F, 0.2F}), "board").value();
  const Object object(*board);
  for (const double depth_m : {-0.02, 0.0, 0.01}) {
    for (const double tilt : {-0.35, -0.5}) {
      HandCorrector corrector(settling());
      const HandPose tracked = pressed_hand(depth_m, tilt);
      ASSERT_LT(tracked[Joint::middle_tip].position.y(), -0.02);
      for (int i = 0; i < 20; ++i) {
        const HandPose drawn = corrector.update(tracked, object, i * kFrame_ns).pose;
        EXPECT_GT(least_room(drawn, object), -0.001) << depth_m << ' ' << tilt << ' ' << i;
        for (const Joint tip : {Joint::index_tip, Joint::middle_tip, Joint::ring_tip}) {
          EXPECT_GT(drawn[tip].position.y(), 0.003) << depth_m << ' ' << tilt << ' ' << i;
        }
      }
    }
  }
}

/// Fingers that were deeper in it than its middle were drawn to its other side: the hand lay across
/// it, with skin 20 mm inside, and took up to 25 ms for it.
TEST(ProxyHand, AHandThatIsFoundInAThickBoardIsDrawnOnItsPalmsSide) {
  const auto board = MeshSurface::build(test::box_mesh({0.3F, 0.02F, 0.3F}), "board").value();
  const Object object(*board, {{{0.0, -0.02, 0.0}, Quat::Identity()}, 1.0});
  for (const double depth_m : {0.0, 0.01, 0.03}) {
    for (const double tilt : {0.0, -0.3}) {
      HandCorrector corrector(settling());
      const HandPose drawn = corrector.update(pressed_hand(depth_m, tilt), object, 0).pose;
      EXPECT_GT(least_room(drawn, object), -0.001) << depth_m << ' ' << tilt;
      EXPECT_GT(drawn[Joint::middle_tip].position.y(), -0.003) << depth_m << ' ' << tilt;
    }
  }
}

TEST(ProxyHand, AHandOnItsWayOutIsFreeInTheEnd) {
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
      EXPECT_LT(largest_motion(tracked, result.pose), 0.001);
    }
    before = result.pose;
  }
  const HandPose away = pressed_hand(-0.08);
  EXPECT_EQ(corrector.update(away, ball(), time_ns).status, HandStatus::free);
  EXPECT_TRUE(same_bits(corrector.update(away, ball(), time_ns).pose, away));
}

TEST(ProxyHand, TheLeftHandIsTheRightOneInTheMirror) {
  HandCorrector left(settling());
  HandCorrector right(settling());
  for (int i = 0; i <= 120; ++i) {
    const HandPose tracked = on_the_way_down(i, 90, 0.03, 0.2);
    const HandPose a = right.update(tracked, ball(), i * kFrame_ns).pose;
    const HandPose b = left.update(mirrored(tracked), ball(), i * kFrame_ns).pose;
    ASSERT_LT(largest_motion(a, mirrored(b)), 1e-6) << "frame " << i;
  }
}

TEST(ProxyHand, HandAndObjectMovedTogetherGiveTheSame) {
  test::Random random;
  SCOPED_TRACE(testing::Message() << "NADE_TEST_SEED=" << test::seed());
  for (int trial = 0; trial < 4; ++trial) {
    const Pose motion{random.point({-2.0, -2.0, -2.0}, {2.0, 2.0, 2.0}), random.rotation()};
    const Object moved_ball(test::kBall, {motion * ball().placement().pose, 1.0});
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

TEST(ProxyHand, AnObjectThatRisesCarriesTheHand) {
  HandCorrector corrector(settling());
  const HandPose tracked = pressed_hand(-0.06);
  HandPose before = tracked;
  for (int i = 0; i <= 120; ++i) {
    const double height_m = 0.001 * i;
    const Object object(test::kBall, {{{0.0, -0.15 + height_m, 0.0}, Quat::Identity()}, 1.0});
    const HandPose drawn = corrector.update(tracked, object, i * kFrame_ns).pose;
    ASSERT_GT(least_room(drawn, object), -0.001) << "frame " << i;
    ASSERT_LT(largest_motion(before, drawn), 0.006) << "frame " << i;
    before = drawn;
  }
}

TEST(ProxyHand, AMeshThatSwellsPushesTheHandOut) {
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
    ASSERT_GT(least_room(drawn, object), -0.001) << "frame " << i;
  }
}

TEST(ProxyHand, VisibleFrictionLagsByABoundedAmountAndNeverJumps) {
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

TEST(ProxyHand, SkinSinksIntoASoftObjectAsFarAsItIsSoft) {
  CorrectorOptions options = settling();
  options.settle.softness_m = 0.006;
  HandCorrector corrector(options);
  double lowest = 0.0;
  for (int i = 0; i <= 120; ++i) {
    const HandPose tracked = on_the_way_down(i, 90, 0.04);
    lowest = least_room(corrector.update(tracked, plane(), i * kFrame_ns).pose, plane());
    ASSERT_GT(lowest, -0.0065) << "frame " << i;
  }
  EXPECT_LT(lowest, -0.003);
}

/// As where it goes over to another object. At once it sank by 2 mm in a frame and rose by 7.
TEST(ProxyHand, AHandSinksAndRisesSlowlyWhereTheObjectBecomesSofterOrHarder) {
  HandCorrector corrector(settling());
  HandPose before;
  const auto lowest_after = [&](double softness_m, int from, int to) {
    SettleOptions settle;
    settle.softness_m = softness_m;
    corrector.set_settle(settle);
    for (int i = from; i < to; ++i) {
      const HandPose tracked = on_the_way_down(std::min(i, 120), 90, 0.03);
      const HandPose drawn = corrector.update(tracked, plane(), i * kFrame_ns).pose;
      if (i > 120) {
        EXPECT_LT(largest_motion(before, drawn), 0.001) << "frame " << i;
      }
      before = drawn;
    }
    return least_room(before, plane());
  };
  EXPECT_GT(lowest_after(0.0, 0, 180), -1e-4);
  EXPECT_LT(lowest_after(0.01, 180, 300), -0.006);
  EXPECT_GT(lowest_after(0.0, 300, 420), -1e-4);
}

/// What had stayed behind did so for ever.
TEST(ProxyHand, AHandIsLetGoWhereFrictionIsTakenAway) {
  CorrectorOptions options = settling();
  options.settle.friction.coefficient = 1.0;
  HandCorrector rubbed(options);
  HandCorrector smooth(settling());
  HandPose before;
  double longest_m = 0.0;
  double left_m = 0.0;
  for (int i = 0; i <= 400; ++i) {
    if (i == 250) rubbed.set_settle({});
    const double along_m = 0.001 * std::max(0, i - 120);
    const HandPose tracked =
        i < 120 ? on_the_way_down(i, 90, 0.02) : pressed_hand(0.02, 0.0, {0.0, 0.0, -along_m});
    const HandPose drawn = rubbed.update(tracked, plane(), i * kFrame_ns).pose;
    const HandPose free = smooth.update(tracked, plane(), i * kFrame_ns).pose;
    left_m = (drawn[Joint::palm].position - free[Joint::palm].position).norm();
    longest_m = std::max(longest_m, left_m);
    if (i > 120) {
      EXPECT_LT(largest_motion(before, drawn), 0.004) << "frame " << i;
    }
    before = drawn;
  }
  EXPECT_GT(longest_m, 0.01);
  EXPECT_LT(left_m, 0.003);
}

/// A tracker that has measured the hand anew: its size was the mean of the last 512 frames, and the
/// skin was 2.3 mm inside a second later.
TEST(ProxyHand, AHandThatIsSuddenlyLargerIsSoonAsThick) {
  HandCorrector corrector(settling());
  const HandPose hand = pressed_hand(0.02);
  HandPose larger = hand;
  for (Pose& joint : larger.joints) {
    joint.position =
        hand[Joint::palm].position + 1.1 * (joint.position - hand[Joint::palm].position);
  }
  for (int i = 0; i < 600; ++i) {
    const HandPose& tracked = i < 510 ? hand : larger;
    const HandPose drawn = corrector.update(tracked, plane(), i * kFrame_ns).pose;
    if (i < 599) continue;
    EXPECT_GT(least_room(drawn, plane()), -0.001);
  }
}

TEST(ProxyHand, AFrameAllocatesNothingAndRepeatsToTheBit) {
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
