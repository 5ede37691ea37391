#include "nade/eval/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "generic_hand.h"
#include "nade/mesh.h"
#include "nade/skeleton.h"
#include "support/meshes.h"
#include "toy_hand.h"

namespace nade {
namespace {

using test::at_height;
using test::toy_mesh;

constexpr double kRate = 90.0;
/// Of the joints: the palm's skin is then 30 mm deep in a plane, all other skin 28 mm.
constexpr double kDeep = -0.02;
/// Lifts a hand at `kDeep` so that its palm's skin lies on the plane.
const Vec3 kOnto(0.0, 0.03, 0.0);

const PlaneSurface kPlane;

struct Pair {
  HandPose tracked;
  HandPose corrected;
};
using Motion = std::function<Pair(double seconds)>;

HandPose shifted(const HandPose& hand, const Vec3& by) { return moved(hand, {by, {1, 0, 0, 0}}); }

/// The hinge of a digit bent further, with all beyond it.
HandPose bent(const HandPose& hand, Digit digit, std::size_t hinge, double angle_rad) {
  const DigitChain chain = measure_chain(hand, digit);
  DigitAngles angles = chain.angles;
  angles[hinge].flexion += angle_rad;
  HandPose result = hand;
  set_digit(result, digit, pose_chain(chain, angles));
  return result;
}

/// PIP and DIP of the four fingers bent by half of `angle_rad` each.
HandPose curled(HandPose hand, double angle_rad) {
  for (const Digit digit : {Digit::index, Digit::middle, Digit::ring, Digit::little}) {
    for (const std::size_t hinge : {1U, 2U}) hand = bent(hand, digit, hinge, 0.5 * angle_rad);
  }
  return hand;
}

Metrics measure(int frames, const Motion& motion) {
  const HandMesh mesh = toy_mesh(Handedness::right);
  MetricsMeter meter(mesh);
  for (int i = 0; i < frames; ++i) {
    const double seconds = i / kRate;
    const Pair pair = motion(seconds);
    meter.add(static_cast<std::int64_t>(seconds * 1e9), pair.tracked, pair.corrected,
              Object(kPlane));
  }
  return meter.finish();
}

/// A stroke that keeps changing its speed and direction.
Vec3 wander(double seconds) {
  return {0.05 * std::sin(4.4 * seconds), 0.0, 0.03 * std::cos(6.9 * seconds + 0.5)};
}

TEST(Metrics, NothingAdded) {
  const HandMesh mesh = toy_mesh(Handedness::right);
  const Metrics metrics = MetricsMeter(mesh).finish();
  EXPECT_EQ(metrics.frames, 0U);
  for (const MetricInfo& info : metric_table()) EXPECT_FALSE(metrics.*info.value) << info.key;
}

TEST(Metrics, TableHasTheKeysOfTheContract) {
  std::set<std::string> keys;
  for (const MetricInfo& info : metric_table()) keys.insert(info.key);
  const std::set<std::string> expected{"penetration_max_mm",
                                       "penetration_p99_mm",
                                       "penetration_mean_mm",
                                       "contact_ratio",
                                       "part_gap_mean_mm",
                                       "part_gap_p95_mm",
                                       "linkage_gain",
                                       "linkage_r",
                                       "linkage_lag_ms",
                                       "amplification_p999",
                                       "amplification_max",
                                       "pop_max_mm",
                                       "jitter_ratio",
                                       "bend_added_median_deg",
                                       "bend_added_p95_deg",
                                       "limit_violation_max_deg",
                                       "curl_kept",
                                       "print_share",
                                       "hover_mm",
                                       "heel_share",
                                       "excess_max_mm",
                                       "excess_mean_mm",
                                       "along_p95_mm",
                                       "free_max_mm",
                                       "turn_median_deg",
                                       "turn_p95_deg",
                                       "thumb_open_max_deg",
                                       "overlap_p99_mm",
                                       "jolt_p999_mm",
                                       "tremble_mm",
                                       "own_jolt_p999_mm",
                                       "own_tremble_mm"};
  EXPECT_EQ(keys, expected);
}

/// A board whose top is at y = 0.
struct Board {
  explicit Board(float thickness_m)
      : surface(
            MeshSurface::build(test::box_mesh({0.3F, 0.5F * thickness_m, 0.3F}), "board").value()),
        object(*surface, {{Vec3(0.0, -0.5 * thickness_m, 0.0), Quat::Identity()}, 1.0}) {}
  std::unique_ptr<MeshSurface> surface;
  Object object;
};

/// A hand's joints come down to `kDeep` in half a second, and stay as long.
double height_at(double seconds) { return std::max(kDeep, 0.05 - 0.14 * seconds); }

Metrics measure_on(const Object& object, const Motion& motion) {
  const HandMesh toy = toy_mesh(Handedness::right);
  MetricsMeter meter(toy);
  for (int i = 0; i < 90; ++i) {
    const Pair pair = motion(i / kRate);
    meter.add(i * std::int64_t{11'111'111}, pair.tracked, pair.corrected, object);
  }
  return meter.finish();
}

TEST(Metrics, InAWallDepthCountsFromTheSideThatWasEntered) {
  const PlaneSurface plane;
  for (const float thickness_m : {0.001F, 0.01F, 0.025F}) {
    const Board board(thickness_m);
    for (const double drawn_height_m : {kDeep, 0.01}) {
      const Motion motion = [&](double seconds) {
        const HandPose hand = shifted(at_height(height_at(seconds)), wander(seconds));
        const double up_m = std::max(0.0, drawn_height_m - height_at(seconds));
        return Pair{hand, shifted(hand, Vec3(0.0, up_m, 0.0))};
      };
      const Metrics on_board = measure_on(board.object, motion);
      const Metrics on_plane = measure_on(Object(plane), motion);
      EXPECT_GT(on_board.pressing_frames, 40U);
      EXPECT_EQ(on_board.pressing_frames, on_plane.pressing_frames);
      EXPECT_EQ(on_board.part_samples, on_plane.part_samples);
      EXPECT_NEAR(*on_board.penetration_max_mm, *on_plane.penetration_max_mm, 1e-3);
      EXPECT_NEAR(*on_board.penetration_mean_mm, *on_plane.penetration_mean_mm, 1e-3);
    }
  }
}

TEST(Metrics, HandThatGoesRoundABoardsEdgeIsNotInIt) {
  const Board board(0.01F);
  const Metrics metrics = measure_on(board.object, [](double seconds) {
    // Down beside it, then under it.
    const double along_m = std::max(0.0, seconds - 0.5);
    const HandPose hand =
        shifted(at_height(height_at(seconds) - 0.01), Vec3(0.4 - 0.4 * along_m, 0.0, 0.0));
    return Pair{hand, hand};
  });
  EXPECT_EQ(metrics.frames, 90U);
  EXPECT_EQ(metrics.pressing_frames, 0U);
}

/// It was taken for pressed in from below, the deeper the higher it went.
TEST(Metrics, FingerThatComesBackThroughABoardToItsHandIsOut) {
  const Board board(0.01F);
  const Metrics metrics = measure_on(board.object, [](double seconds) {
    HandPose hand = at_height(0.05);
    const DigitJoints index = joints_of(Digit::index);
    // Around the edge to below the palm, and up.
    const double aside_m = std::max(0.0, 0.4 - std::max(0.0, seconds - 0.2));
    const double down_m =
        0.07 * (std::min(1.0, seconds / 0.1) - std::clamp((seconds - 0.7) / 0.1, 0.0, 1.0));
    for (std::size_t i = index_of(index.metacarpal); i <= index_of(index.tip); ++i) {
      hand.joints[i].position += Vec3(aside_m, -down_m, 0.0);
    }
    return Pair{hand, hand};
  });
  EXPECT_EQ(metrics.frames, 90U);
  EXPECT_GT(metrics.pressing_frames, 0U);
  EXPECT_LT(metrics.pressing_frames, 10U);
}

TEST(Metrics, HandInTheAirPressesNothing) {
  const Metrics metrics = measure(100, [](double seconds) {
    const HandPose hand = shifted(at_height(0.3), wander(seconds));
    return Pair{hand, hand};
  });
  EXPECT_EQ(metrics.frames, 100U);
  EXPECT_EQ(metrics.pressing_frames, 0U);
  EXPECT_FALSE(metrics.penetration_max_mm);
  EXPECT_FALSE(metrics.contact_ratio);
  EXPECT_FALSE(metrics.linkage_gain);
  EXPECT_EQ(metrics.amplification_max, 1.0);
  EXPECT_EQ(metrics.pop_max_mm, 0.0);
  EXPECT_EQ(metrics.jitter_ratio, 1.0);
  EXPECT_EQ(metrics.limit_violation_max_deg, 0.0);
}

TEST(Metrics, UncorrectedHandSinksInAsDeepAsItIs) {
  const Metrics metrics = measure(200, [](double seconds) {
    const HandPose hand = shifted(at_height(kDeep), wander(seconds));
    return Pair{hand, hand};
  });
  EXPECT_EQ(metrics.pressing_frames, 200U);
  EXPECT_NEAR(*metrics.penetration_max_mm, 30.0, 1e-3);
  EXPECT_NEAR(*metrics.penetration_mean_mm, 30.0, 1e-3);
  EXPECT_EQ(metrics.contact_ratio, 0.0);
  // What is sunk in leaves no gap: that is penetration's business.
  EXPECT_EQ(metrics.part_gap_p95_mm, 0.0);
  EXPECT_NEAR(*metrics.linkage_gain, 1.0, 1e-9);
  EXPECT_NEAR(*metrics.linkage_r, 1.0, 1e-9);
  EXPECT_NEAR(*metrics.linkage_lag_ms, 0.0, 1e-6);
  EXPECT_NEAR(*metrics.bend_added_p95_deg, 0.0, 1e-6);
}

TEST(Metrics, LiftedHandTouchesWithItsPalmAndLeavesAGapUnderItsTips) {
  const Metrics metrics = measure(50, [](double) {
    const HandPose hand = at_height(kDeep);
    return Pair{hand, shifted(hand, kOnto)};
  });
  EXPECT_NEAR(*metrics.penetration_max_mm, 0.0, 1e-3);
  EXPECT_EQ(metrics.contact_ratio, 1.0);
  EXPECT_EQ(metrics.part_samples, 50U * kPartCount);
  // The palm none, five tips 2 mm.
  EXPECT_NEAR(*metrics.part_gap_mean_mm, 10.0 / 6.0, 1e-3);
  EXPECT_NEAR(*metrics.part_gap_p95_mm, 2.0, 1e-3);
}

TEST(Metrics, HandHeldOffTheSurfaceDoesNotTouch) {
  const Metrics metrics = measure(10, [](double) {
    const HandPose hand = at_height(kDeep);
    return Pair{hand, shifted(hand, 1.1 * kOnto)};
  });
  EXPECT_EQ(metrics.contact_ratio, 0.0);
  EXPECT_NEAR(*metrics.part_gap_p95_mm, 5.0, 1e-3);
}

TEST(Metrics, ShallowTouchIsNotPressing) {
  const Metrics metrics = measure(10, [](double) {
    const HandPose hand = at_height(0.0085);
    return Pair{hand, hand};
  });
  EXPECT_EQ(metrics.pressing_frames, 0U);
}

TEST(Metrics, HandScaleThickensTheSkin) {
  const HandMesh mesh = toy_mesh(Handedness::right);
  MetricsOptions options;
  options.hand_scale = 1.5;
  MetricsMeter meter(mesh, options);
  meter.add(0, at_height(kDeep), at_height(kDeep), Object(kPlane));
  EXPECT_NEAR(*meter.finish().penetration_max_mm, 35.0, 1e-3);
}

TEST(Metrics, ObjectPlacedElsewhere) {
  const HandMesh mesh = toy_mesh(Handedness::right);
  MetricsMeter meter(mesh);
  const Object table(kPlane, {{{0.0, -0.015, 0.0}, Quat::Identity()}, 2.0});
  meter.add(0, at_height(kDeep), at_height(kDeep), table);
  EXPECT_NEAR(*meter.finish().penetration_max_mm, 15.0, 1e-3);
}

TEST(Metrics, GainOfAHandThatFollowsHalfWay) {
  const Metrics metrics = measure(300, [](double seconds) {
    const HandPose hand = at_height(kDeep);
    return Pair{shifted(hand, wander(seconds)), shifted(hand, kOnto + 0.5 * wander(seconds))};
  });
  EXPECT_NEAR(*metrics.linkage_gain, 0.5, 1e-9);
  EXPECT_NEAR(*metrics.linkage_r, 1.0, 1e-9);
  EXPECT_NEAR(*metrics.linkage_lag_ms, 0.0, 1e-6);
  EXPECT_NEAR(*metrics.amplification_max, 0.5, 1e-9);
}

TEST(Metrics, MotionAlongTheNormalIsNotLinkage) {
  const Metrics metrics = measure(300, [](double seconds) {
    const HandPose hand = at_height(kDeep);
    const Vec3 bob(0.0, 0.01 * std::sin(9.0 * seconds), 0.0);
    return Pair{shifted(hand, wander(seconds) + bob), shifted(hand, kOnto + wander(seconds))};
  });
  EXPECT_NEAR(*metrics.linkage_gain, 1.0, 1e-9);
  EXPECT_NEAR(*metrics.linkage_r, 1.0, 1e-9);
}

TEST(Metrics, LagOfADelayedHand) {
  for (const double frames : {1.0, 1.5, 3.0, 10.0, -2.0}) {
    const Metrics metrics = measure(900, [frames](double seconds) {
      const HandPose hand = at_height(kDeep);
      return Pair{shifted(hand, wander(seconds)),
                  shifted(hand, kOnto + wander(seconds - frames / kRate))};
    });
    EXPECT_NEAR(*metrics.linkage_lag_ms, 1e3 * frames / kRate, 0.3) << frames;
    EXPECT_LT(*metrics.linkage_r, 1.0);
  }
}

TEST(Metrics, ConstantVelocityShowsNoLag) {
  const Metrics metrics = measure(200, [](double seconds) {
    const HandPose hand = shifted(at_height(kDeep), {0.03 * seconds, 0.0, 0.0});
    return Pair{hand, shifted(hand, kOnto)};
  });
  EXPECT_NEAR(*metrics.linkage_gain, 1.0, 1e-9);
  EXPECT_FALSE(metrics.linkage_lag_ms);
}

TEST(Metrics, AHandThatPressesInOnePlaceDoesNotStroke) {
  const Metrics metrics = measure(200, [](double seconds) {
    const HandPose hand = shifted(at_height(kDeep), {0.004 * std::sin(2.0 * seconds), 0.0, 0.0});
    return Pair{hand, shifted(hand, kOnto + Vec3(0.01 * seconds, 0.0, 0.0))};
  });
  EXPECT_TRUE(metrics.contact_ratio);
  EXPECT_FALSE(metrics.linkage_gain);
  EXPECT_FALSE(metrics.linkage_r);
  EXPECT_FALSE(metrics.linkage_lag_ms);
}

TEST(Metrics, UnevenFramesDoNotDisturbTheLinkage) {
  const HandMesh mesh = toy_mesh(Handedness::right);
  MetricsMeter meter(mesh);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> pause(0.004, 0.02);
  double seconds = 0.0;
  for (int i = 0; i < 500; ++i, seconds += pause(random)) {
    const HandPose hand = shifted(at_height(kDeep), wander(seconds));
    meter.add(static_cast<std::int64_t>(seconds * 1e9), hand, shifted(hand, kOnto), Object(kPlane));
  }
  const Metrics metrics = meter.finish();
  EXPECT_NEAR(*metrics.linkage_gain, 1.0, 1e-9);
  EXPECT_NEAR(*metrics.linkage_lag_ms, 0.0, 0.2);
}

TEST(Metrics, PopOfAStillHand) {
  const Metrics metrics = measure(100, [](double seconds) {
    const HandPose hand = at_height(kDeep);
    const double jump = seconds > 0.5 ? 0.005 : 0.0;
    return Pair{hand, shifted(hand, kOnto + Vec3(jump, 0.0, 0.0))};
  });
  EXPECT_NEAR(*metrics.pop_max_mm, 5.0, 1e-9);
  // A tracked hand that stands still counts as if it moved by 0.2 mm.
  EXPECT_NEAR(*metrics.amplification_max, 25.0, 1e-9);
}

TEST(Metrics, PopBeyondThreeTimesTheTrackedMotion) {
  const Metrics metrics = measure(100, [](double seconds) {
    const HandPose hand = shifted(at_height(kDeep), {0.001 * kRate * seconds, 0.0, 0.0});
    const double jump = seconds > 0.5 ? 0.004 : 0.0;
    return Pair{hand, shifted(hand, kOnto + Vec3(jump, 0.0, 0.0))};
  });
  EXPECT_NEAR(*metrics.pop_max_mm, 2.0, 1e-9);
  EXPECT_NEAR(*metrics.amplification_max, 5.0, 1e-9);
}

TEST(Metrics, JitterOfAHandThatShakesTwiceAsMuch) {
  const Metrics metrics = measure(300, [](double seconds) {
    const HandPose hand = at_height(0.2);
    return Pair{shifted(hand, wander(seconds)), shifted(hand, 2.0 * wander(seconds))};
  });
  EXPECT_NEAR(*metrics.jitter_ratio, 2.0, 1e-9);
  EXPECT_NEAR(*metrics.amplification_p999, 2.0, 1e-9);
}

TEST(Metrics, BendAddedToOneJointOfFifteen) {
  const Metrics metrics = measure(20, [](double) {
    const HandPose hand = at_height(kDeep);
    return Pair{hand, bent(hand, Digit::index, 1, 20.0 * kDegree)};
  });
  EXPECT_NEAR(*metrics.bend_added_median_deg, 0.0, 1e-6);
  EXPECT_NEAR(*metrics.bend_added_p95_deg, 20.0, 1e-3);
}

TEST(Metrics, LimitViolationThatTheTrackedHandDidNotHave) {
  const double beyond = 30.0 * kDegree;
  const auto violation = [&](double tracked_rad, double corrected_rad) {
    const Metrics metrics = measure(5, [&](double) {
      const HandPose hand = at_height(kDeep);
      return Pair{bent(hand, Digit::ring, 1, -tracked_rad),
                  bent(hand, Digit::ring, 1, -corrected_rad)};
    });
    return *metrics.limit_violation_max_deg;
  };
  EXPECT_NEAR(violation(0.0, beyond), 30.0, 1e-6);
  EXPECT_NEAR(violation(beyond, beyond), 0.0, 1e-6);
  EXPECT_NEAR(violation(0.5 * beyond, beyond), 15.0, 1e-6);
  EXPECT_NEAR(violation(beyond, 0.0), 0.0, 1e-6);
}

TEST(Metrics, CurlKeptInPart) {
  const auto curl = [](double share) {
    return measure(90, [share](double seconds) {
      const double angle = 60.0 * kDegree * seconds;
      const HandPose hand = at_height(kDeep);
      return Pair{curled(hand, angle), shifted(curled(hand, share * angle), 1.2 * kOnto)};
    });
  };
  EXPECT_NEAR(*curl(0.4).curl_kept, 0.4, 1e-6);
  EXPECT_NEAR(*curl(0.0).curl_kept, 0.0, 1e-6);
  const Metrics whole = curl(1.0);
  EXPECT_NEAR(*whole.curl_kept, 1.0, 1e-6);
  // Beyond 15 degrees: the last three quarters of a second; there the palm may rise.
  EXPECT_NEAR(static_cast<double>(whole.curling_frames), 67.0, 1.0);
  EXPECT_EQ(whole.part_samples, 90U * kPartCount - whole.curling_frames);
}

TEST(Metrics, StraightFingersAreNoCurl) {
  const Metrics metrics = measure(20, [](double) {
    const HandPose hand = curled(at_height(kDeep), 40.0 * kDegree);
    return Pair{hand, shifted(at_height(kDeep), kOnto)};
  });
  EXPECT_FALSE(metrics.curl_kept);
}

TEST(Metrics, LostAndBrokenHandsAreGaps) {
  const HandMesh mesh = toy_mesh(Handedness::right);
  MetricsMeter meter(mesh);
  HandPose broken = at_height(kDeep);
  broken[Joint::ring_tip].position.x() = std::numeric_limits<double>::quiet_NaN();
  // Ten times the hand is lost or broken, and comes back elsewhere.
  std::int64_t time_ns = 0;
  for (int i = 0; i < 200; ++i, time_ns += 11'111'111) {
    const double place = 0.5 * (i / 20);
    const HandPose hand = shifted(at_height(kDeep), Vec3(place, 0.0, 0.0) + wander(0.01 * i));
    if (i % 20 != 0) {
      meter.add(time_ns, hand, shifted(hand, kOnto), Object(kPlane));
    } else if (i % 40 == 0) {
      meter.add_gap();
    } else {
      meter.add(time_ns, hand, broken, Object(kPlane));
      meter.add(time_ns + 1, broken, hand, Object(kPlane));
    }
  }
  const Metrics metrics = meter.finish();
  EXPECT_EQ(metrics.frames, 190U);
  EXPECT_NEAR(*metrics.linkage_gain, 1.0, 1e-9);
  EXPECT_NEAR(*metrics.amplification_max, 1.0, 1e-9);
  for (const MetricInfo& info : metric_table()) {
    if (metrics.*info.value) {
      EXPECT_TRUE(std::isfinite(*(metrics.*info.value))) << info.key;
    }
  }
}

TEST(Metrics, MotionIsNotMeasuredAcrossAPause) {
  const HandMesh mesh = toy_mesh(Handedness::right);
  MetricsMeter meter(mesh);
  const HandPose hand = at_height(0.3);
  meter.add(0, hand, hand, Object(kPlane));
  meter.add(10'000'000, hand, hand, Object(kPlane));
  meter.add(900'000'000, hand, shifted(hand, Vec3(0.1, 0.0, 0.0)), Object(kPlane));
  EXPECT_EQ(meter.finish().pop_max_mm, 0.0);
}

TEST(Metrics, BothHandsMerged) {
  const HandMesh right = toy_mesh(Handedness::right);
  const HandMesh left = toy_mesh(Handedness::left);
  MetricsMeter right_meter(right);
  MetricsMeter left_meter(left);
  for (int i = 0; i < 100; ++i) {
    const HandPose hand = shifted(at_height(kDeep), wander(i / kRate));
    const HandPose mirror = mirrored(hand);
    right_meter.add(i * 11'111'111LL, hand, shifted(hand, kOnto), Object(kPlane));
    left_meter.add(i * 11'111'111LL, mirror, mirror, Object(kPlane));
  }
  const Metrics alone = left_meter.finish();
  right_meter.merge(left_meter);
  const Metrics both = right_meter.finish();
  EXPECT_EQ(both.frames, 200U);
  EXPECT_EQ(both.contact_ratio, 0.5);
  EXPECT_NEAR(*both.penetration_max_mm, 30.0, 1e-3);
  EXPECT_NEAR(*both.penetration_mean_mm, 15.0, 1e-3);
  EXPECT_NEAR(*both.linkage_gain, 1.0, 1e-9);
  EXPECT_EQ(alone.contact_ratio, 0.0);
}

TEST(Metrics, SkinIsMeasuredAsByBruteForce) {
  NADE_TEST_GENERIC_HAND(mesh, Handedness::right);
  const SphereSurface ball(0.06);
  std::vector<Eigen::Vector3f> skin(mesh.vertices.size());
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto random_vector = [&] {
    return Vec3(uniform(random), uniform(random), uniform(random));
  };
  for (int round = 0; round < 200; ++round) {
    const Pose motion{0.08 * random_vector(),
                      Quat(Eigen::AngleAxisd(3.0 * uniform(random), random_vector().normalized()))};
    const HandPose hand = moved(curled(mesh.bind, uniform(random)), motion);
    pose_skin(mesh, hand, 1.0, skin, {});
    double deepest = std::numeric_limits<double>::infinity();
    double nearest = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3f& vertex : skin) {
      const double distance = vertex.cast<double>().norm() - ball.radius();
      deepest = std::min(deepest, distance);
      nearest = std::min(nearest, std::abs(distance));
    }
    MetricsMeter meter(mesh);
    meter.add(0, hand, hand, Object(ball));
    const Metrics metrics = meter.finish();
    ASSERT_EQ(metrics.pressing_frames, deepest < -0.002 ? 1U : 0U) << round;
    if (metrics.pressing_frames == 0) continue;
    EXPECT_NEAR(*metrics.penetration_max_mm, -1e3 * deepest, 1e-9) << round;
    EXPECT_EQ(metrics.contact_ratio, nearest <= 0.002 ? 1.0 : 0.0) << round;
  }
}

/// The hand 30 mm deep, and as drawn.
Metrics measure_look(const std::function<HandPose(const HandPose& tracked)>& draw) {
  return measure(90, [&](double seconds) {
    const HandPose hand = shifted(at_height(kDeep), wander(seconds));
    return Pair{hand, draw(hand)};
  });
}

TEST(Metrics, SkinThatIsLiftedOrSunkBeyondItsFleshHoversAndDoesNotPrint) {
  NADE_TEST_GENERIC_HAND(mesh, Handedness::right);
  // Palm down, its joint at the origin.
  const HandPose flat = moved(mesh.bind, mesh.bind[Joint::palm].inverse());
  const auto look = [&](double height_m) {
    MetricsMeter meter(mesh);
    const Placement table{{0.01 * Vec3::UnitY(), Quat::Identity()}, 1.0};
    for (int i = 0; i < 3; ++i) {
      meter.add(i * 11'111'111LL, flat, shifted(flat, {0.0, height_m, 0.0}), Object(kPlane, table));
    }
    return meter.finish();
  };
  const Metrics sunk = look(-0.1);
  EXPECT_EQ(sunk.print_share, 0.0);
  EXPECT_EQ(sunk.heel_share, 0.0);
  EXPECT_GT(*sunk.excess_max_mm, 100.0);
  EXPECT_NEAR(*look(-0.101).hover_mm - *sunk.hover_mm, 1.0, 1e-4);
  // Its heel lies on the plane; the thumb of this rigid pose hangs lower.
  const Metrics pressed = look(0.018);
  EXPECT_GT(*pressed.heel_share, 0.5);
  EXPECT_GT(*pressed.print_share, 0.3);
  EXPECT_LT(*pressed.hover_mm, 10.0);
  const Metrics high = look(0.1);
  EXPECT_EQ(high.print_share, 0.0);
  EXPECT_EQ(high.heel_share, 0.0);
  EXPECT_EQ(high.excess_max_mm, 0.0);
  EXPECT_NEAR(*look(0.101).hover_mm - *high.hover_mm, 1.0, 1e-4);
}

TEST(Metrics, DrawnAsideAndTurned) {
  const Metrics metrics = measure_look([](const HandPose& hand) {
    const Quat turn(Eigen::AngleAxisd(20.0 * kDegree, Vec3::UnitY()));
    const Vec3& palm = hand[Joint::palm].position;
    return moved(hand, {palm - turn * palm + Vec3(0.01, 0.05, 0.0), turn});
  });
  EXPECT_NEAR(*metrics.along_p95_mm, 10.0, 1e-6);
  EXPECT_NEAR(*metrics.turn_median_deg, 20.0, 1e-6);
  EXPECT_NEAR(*metrics.turn_p95_deg, 20.0, 1e-6);
}

TEST(Metrics, AwayInFreeAirCountsAfterHalfASecond) {
  const auto away_mm = [](double seconds_free) {
    const int frames = static_cast<int>(std::lround(kRate * seconds_free));
    return measure(frames,
                   [](double) {
                     const HandPose hand = at_height(0.2);
                     return Pair{hand, shifted(hand, {0.03, 0.0, 0.0})};
                   })
        .free_max_mm;
  };
  EXPECT_FALSE(away_mm(0.45));
  EXPECT_NEAR(*away_mm(0.6), 30.0, 1e-9);
}

TEST(Metrics, ThumbOpenedInThePalmsPlane) {
  const Metrics metrics = measure_look([](HandPose hand) {
    // 45 degrees forward and aside, however far down.
    hand[Joint::thumb_proximal].position =
        hand[Joint::thumb_metacarpal].position + Vec3(-0.02, -0.01, -0.02);
    return hand;
  });
  EXPECT_NEAR(*metrics.thumb_open_max_deg, 45.0, 1e-6);
}

TEST(Metrics, FingersIntoEachOther) {
  const auto overlap_mm = [](double apart_m) {
    return *measure_look([&](HandPose hand) {
              for (std::size_t i = 0; i < 5; ++i) {
                hand.joints[index_of(Joint::index_metacarpal) + i].position.x() =
                    hand[Joint::middle_metacarpal].position.x() - apart_m;
              }
              return hand;
            }).overlap_p99_mm;
  };
  EXPECT_EQ(overlap_mm(0.015), 0.0);
  EXPECT_NEAR(overlap_mm(0.004) - overlap_mm(0.006), 2.0, 1e-6);
}

TEST(Metrics, JoltsAreToldAtOneRate) {
  const auto bob = [](double rate) {
    const HandMesh mesh = toy_mesh(Handedness::right);
    MetricsMeter meter(mesh);
    for (int i = 0; i < 200; ++i) {
      const double seconds = i / rate;
      const HandPose hand = at_height(kDeep);
      meter.add(std::llround(1e9 * seconds), hand,
                shifted(hand, {0.0, 5.0 * seconds * seconds, 0.0}), Object(kPlane));
    }
    return meter.finish();
  };
  for (const double rate : {30.0, 90.0}) {
    const Metrics metrics = bob(rate);
    EXPECT_NEAR(*metrics.jolt_p999_mm, 1e3 * 10.0 / (90.0 * 90.0), 1e-4) << rate;
    EXPECT_NEAR(*metrics.tremble_mm, 1e3 * 10.0 / (90.0 * 90.0), 1e-4) << rate;
    EXPECT_EQ(metrics.own_jolt_p999_mm, 0.0);
    EXPECT_EQ(metrics.own_tremble_mm, 0.0);
  }
}

MetricTarget target_of(const std::string& key) {
  for (const MetricInfo& info : metric_table()) {
    if (info.key == key) return info.target;
  }
  ADD_FAILURE() << "no metric " << key;
  return {};
}

TEST(Metrics, Targets) {
  const auto met = [](const char* key, double value) {
    return meets(bounds_in(target_of(key), {}), value);
  };
  EXPECT_EQ(met("excess_max_mm", 1.5), true);
  EXPECT_EQ(met("excess_max_mm", 1.6), false);
  EXPECT_EQ(met("contact_ratio", 0.98), false);
  EXPECT_EQ(met("linkage_gain", 0.92), false);
  EXPECT_EQ(met("linkage_gain", 1.05), true);
  EXPECT_EQ(met("linkage_lag_ms", -11.0), false);
  for (const char* const key : {"penetration_max_mm", "part_gap_p95_mm", "jitter_ratio"}) {
    EXPECT_FALSE(met(key, 1.0)) << key << " is reported without a target";
    EXPECT_EQ(words_of(target_of(key)), "") << key;
  }
}

TEST(Metrics, TargetsRelativeToTheTrackedHandsOwnMotion) {
  Metrics shaky;
  EXPECT_FALSE(meets(bounds_in(target_of("tremble_mm"), shaky), 0.1)) << "its own is not known";
  shaky.own_tremble_mm = 0.4;
  shaky.own_jolt_p999_mm = 2.0;
  EXPECT_EQ(meets(bounds_in(target_of("tremble_mm"), shaky), 0.34), true);
  EXPECT_EQ(meets(bounds_in(target_of("tremble_mm"), shaky), 0.36), false);
  EXPECT_EQ(meets(bounds_in(target_of("jolt_p999_mm"), shaky), 4.9), true);
  EXPECT_EQ(meets(bounds_in(target_of("jolt_p999_mm"), shaky), 5.1), false);
  EXPECT_EQ(words_of(target_of("tremble_mm")), "at most 0.15 + 0.5 own");
  EXPECT_EQ(words_of(target_of("jolt_p999_mm")), "at most 3 + own");
}

TEST(Metrics, TargetsRelativeToThePapersMethod) {
  EXPECT_FALSE(meets(bounds_in(target_of("print_share"), {}), 0.9)) << "the paper's is not known";
  EXPECT_EQ(meets(bounds_in(target_of("print_share"), {}, 0.3), 0.3), true);
  EXPECT_EQ(meets(bounds_in(target_of("print_share"), {}, 0.3), 0.29), false);
  EXPECT_EQ(meets(bounds_in(target_of("hover_mm"), {}, 5.0), 4.0), true);
  EXPECT_EQ(meets(bounds_in(target_of("hover_mm"), {}, 5.0), 5.1), false);
  EXPECT_EQ(words_of(target_of("print_share")), "at least the paper's");
}

TEST(Metrics, TargetsSayInHowManyCases) {
  for (const MetricInfo& info : metric_table()) {
    EXPECT_EQ(info.target.share.has_value(), info.target.bounds.any()) << info.key;
  }
  EXPECT_EQ(target_of("limit_violation_max_deg").share, 1.0);
  EXPECT_EQ(target_of("print_share").share, 0.85);
}

}  // namespace
}  // namespace nade
