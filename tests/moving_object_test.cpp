#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "nade/corrector.h"
#include "nade/io/object_file.h"
#include "support/allocation_counter.h"
#include "support/hand_checks.h"
#include "support/meshes.h"
#include "support/sample_hand.h"
#include "support/sanitized.h"

namespace nade {
namespace {

constexpr std::int64_t kFrame_ns = 11'111'111;
constexpr double kFrame_s = 1e-9 * kFrame_ns;
constexpr double kNear_m = 0.05;

/// A hand that lies on a place of an object, the palm's skin so deep.
HandPose laid_hand(const Pose& place, double depth_m) {
  const double skin_m = generic_skin_depths()[Part::palm];
  return test::placed_hand(test::generic_size_hand(),
                           place.position + (skin_m - depth_m) * (place.rotation * Vec3::UnitY()),
                           place.rotation);
}

struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] double length() const { return high - low; }
};

/// What a hand saw that came down onto a moving object and stayed where it was, in the world.
struct Rest {
  double deepest_m = 0.0;   ///< of the drawn skin in the object
  double farthest_m = 0.0;  ///< of the drawn hand off the object
  double fastest_m = 0.0;   ///< of a drawn joint, from one frame to the next
  Span drawn_height_m;      ///< of the drawn palm, along the place's normal
  Span surface_height_m;    ///< of the object under it
};

/// `move` puts the object where and how it is at a time, seconds, and gives it.
template <class Move>
Rest rest_on(const Pose& place, double depth_m, double seconds, const Move& move) {
  constexpr int kSkinEvery = test::kSanitized ? 10 : 1;
  constexpr double kComing_s = 1.0;
  HandCorrector corrector(test::settling());
  const Vec3 up = place.rotation * Vec3::UnitY();
  Rest rest;
  std::optional<HandPose> before;
  for (int i = 0; i * kFrame_s < kComing_s + seconds; ++i) {
    const double time_s = i * kFrame_s;
    const double share = std::min(1.0, time_s / (0.7 * kComing_s));
    const HandPose tracked = laid_hand(place, depth_m - (1.0 - share) * (0.08 + depth_m));
    const Object object = move(std::max(0.0, time_s - kComing_s));
    const HandPose drawn = corrector.update(tracked, object, i * kFrame_ns).pose;
    EXPECT_TRUE(test::all_finite(drawn)) << "frame " << i;
    if (time_s > kComing_s) {
      if (i % kSkinEvery == 0) {
        const double lowest_m = test::lowest_skin(drawn, object, kNear_m);
        rest.deepest_m = std::max(rest.deepest_m, -test::least_room(drawn, object, kNear_m));
        rest.farthest_m = std::max(rest.farthest_m, lowest_m);
      }
      rest.fastest_m = std::max(rest.fastest_m, largest_motion(*before, drawn));
      rest.drawn_height_m.add(up.dot(drawn[Joint::palm].position - place.position));
      const auto hit = object.first_hit({place.position + 0.05 * up, -up, 0.1});
      if (hit) rest.surface_height_m.add(up.dot(hit->point - place.position));
    }
    before = drawn;
  }
  return rest;
}

class LivingDog : public testing::Test {
 protected:
  void SetUp() override {
    Result<LoadedObject> loaded = load_object(NADE_TEST_DOG ":alive");
    ASSERT_TRUE(loaded.ok()) << loaded.error().message;
    dog_.emplace(std::move(loaded).value());
  }
  [[nodiscard]] Pose place(const char* name) const { return dog_->place(name)->pose; }
  [[nodiscard]] Rest rest_at(const Pose& place, double depth_m) {
    return rest_on(place, depth_m, dog_->animation->duration_s(), [this](double time_s) {
      dog_->move_to(time_s);
      return dog_->placed();
    });
  }

  std::optional<LoadedObject> dog_;
};

void expect_ride(const Rest& rest, double breath_min_m) {
  EXPECT_GT(rest.surface_height_m.length(), breath_min_m);
  EXPECT_NEAR(rest.drawn_height_m.length(), rest.surface_height_m.length(), 0.002);
  EXPECT_LT(rest.deepest_m, 0.002);
  EXPECT_LT(rest.farthest_m, 0.002);
  EXPECT_LT(rest.fastest_m, 0.0015);
}

TEST_F(LivingDog, AHandAtRestOnItsFlankRidesOnItsBreath) {
  if (test::kSanitized) GTEST_SKIP() << "as on its back, which the sanitizers see";
  expect_ride(rest_at(place("flank"), 0.01), 0.004);
}

TEST_F(LivingDog, AHandAtRestOnItsBackRidesOnItsBreath) {
  expect_ride(rest_at(place("back"), 0.01), 0.002);
}

TEST_F(LivingDog, ItsHeadTurnsUnderThePalm) {
  if (test::kSanitized) GTEST_SKIP() << "as on its back, which the sanitizers see";
  const Rest rest = rest_at(place("head"), 0.01);
  EXPECT_LT(rest.deepest_m, 0.002);
  EXPECT_LT(rest.fastest_m, 0.004);
}

TEST_F(LivingDog, ItsTailStrikesAHandWithoutGoingThrough) {
  // Lies across the tail, above its rest.
  const Vec3 on_tail(0.33, 0.398, 0.0);
  SurfaceHint hint;
  const auto skin = dog_->placed().closest_point(on_tail, 0.05, hint);
  ASSERT_TRUE(skin.has_value());
  const Pose place{skin->point, Quat(Eigen::AngleAxisd(1.57, Vec3::UnitY()))};
  const Rest rest = rest_at(place, 0.005);
  EXPECT_LT(rest.deepest_m, 0.002);
  EXPECT_LT(rest.fastest_m, 0.02);
}

TEST_F(LivingDog, AFrameWithItsMotionAllocatesNothing) {
  HandCorrector corrector(test::settling());
  const HandPose tracked = laid_hand(place("flank"), 0.01);
  dog_->move_to(0.0);
  for (int i = 0; i < 60; ++i) {
    const auto count = test::allocations_of([&] {
      dog_->move_to(i * kFrame_s);
      corrector.update(tracked, dog_->placed(), i * kFrame_ns);
    });
    EXPECT_EQ(count, 0U) << "frame " << i;
  }
}

TEST(MovingObject, AHandAtRestRidesOnWhatRisesTurnsAndGrows) {
  const SphereSurface ball(0.15);
  const Pose top{{0.0, 0.0, 0.0}, Quat::Identity()};
  const auto at = [&](double rise_m, double turn_rad, double scale) {
    const Quat turn(Eigen::AngleAxisd(turn_rad, Vec3(0.3, 0.5, 0.8).normalized()));
    return Object(ball, {{{0.0, rise_m - 0.15 * scale, 0.0}, turn}, scale});
  };
  const double round = 2.0 * std::numbers::pi / 3.0;
  for (const int which : {0, 1, 2}) {
    SCOPED_TRACE(which);
    const Rest rest = rest_on(top, 0.012, 3.0, [&](double time_s) {
      const double swing = std::sin(round * time_s);
      if (which == 0) return at(0.008 * swing, 0.0, 1.0);
      if (which == 1) return at(0.0, 0.5 * swing, 1.0);
      // About its middle, so that its top rises and sinks.
      return at(0.15 * 0.05 * swing, 0.0, 1.0 + 0.05 * swing);
    });
    // The fingers bend to a ball that comes nearer, so that the palm rises less than it does.
    EXPECT_GT(rest.drawn_height_m.length(), 0.7 * rest.surface_height_m.length());
    EXPECT_LT(rest.drawn_height_m.length(), rest.surface_height_m.length() + 0.002);
    EXPECT_LT(rest.deepest_m, 0.002);
    EXPECT_LT(rest.farthest_m, 0.002);
    EXPECT_LT(rest.fastest_m, 0.002);
  }
}

/// As on one that moves as a whole, though it is its shape that changes.
TEST(MovingObject, AHandAtRestRidesOnWhatDeforms) {
  const double round = 2.0 * std::numbers::pi;
  const Pose top{{0.0, 0.0, 0.0}, Quat::Identity()};
  TriangleSoup block = test::box_mesh({0.2F, 0.1F, 0.15F});
  const auto surface = MeshSurface::build(block, "block").value();
  for (const bool tilts : {false, true}) {
    SCOPED_TRACE(tilts);
    const Rest rest = rest_on(top, 0.015, 2.0, [&](double time_s) {
      const double rise_m = 0.02 * std::sin(round * time_s);
      for (Eigen::Vector3f& corner : block.vertices) {
        if (corner.y() < 0.0F) continue;
        corner.y() = static_cast<float>(0.1 + rise_m * (tilts ? -corner.z() / 0.1 : 1.0));
      }
      surface->refit(block.vertices);
      return Object(*surface, {{{0.0, -0.1, 0.0}, Quat::Identity()}, 1.0});
    });
    EXPECT_LT(rest.deepest_m, 0.001);
    EXPECT_LT(rest.farthest_m, 0.001);
  }
}

TEST(MovingObject, AHandAtRestRidesOnABallThatGrowsAndShrinks) {
  const SphereSurface ball(0.15);
  const Pose top{{0.0, 0.0, 0.0}, Quat::Identity()};
  const Rest rest = rest_on(top, 0.015, 1.0, [&](double time_s) {
    const double scale = 1.25 - 0.25 * std::cos(2.0 * std::numbers::pi * time_s);
    return Object(ball, {{{0.0, -0.15, 0.0}, Quat::Identity()}, scale});
  });
  EXPECT_LT(rest.deepest_m, 0.001);
  EXPECT_LT(rest.farthest_m, 0.001);
}

/// Taken away, or put elsewhere, or not what the engine calls the nearest any more. The hand jumped
/// by 53 mm to the person's, which rested.
TEST(MovingObject, AHandComesBackFromAnObjectThatIsGone) {
  const SphereSurface surface(0.15);
  const SphereSurface another(0.15);
  const HandPose hand = laid_hand({{0.0, 0.15, 0.0}, Quat::Identity()}, 0.04);
  const Quat turned(Eigen::AngleAxisd(1.0, Vec3::UnitX()));
  for (const bool is_another : {false, true}) {
    SCOPED_TRACE(is_another ? "another" : "the same");
    const Object here(surface);
    const Object far(is_another ? another : surface, {{{5.0, 0.0, 0.0}, turned}, 1.0});
    HandCorrector corrector(test::settling());
    HandPose drawn;
    double fastest_m = 0.0;
    for (int i = 0; i < 300; ++i) {
      const Object& object = i < 120 ? here : far;
      const HandPose now = corrector.update(hand, object, i * kFrame_ns).pose;
      if (i >= 120) fastest_m = std::max(fastest_m, largest_motion(drawn, now));
      drawn = now;
    }
    EXPECT_LT(fastest_m, 0.004);
    EXPECT_LT(largest_motion(drawn, hand), 0.001);
  }
}

/// Over the joint of two tables of which the engine gives now one, now the other. Found anew each
/// time, the hand jumped by 59 mm and was drawn 46 mm deep.
TEST(MovingObject, AHandGoesOnFromOneObjectToAnother) {
  const auto left = MeshSurface::build(test::box_mesh({0.2F, 0.05F, 0.15F}), "left");
  const auto right = MeshSurface::build(test::box_mesh({0.2F, 0.05F, 0.15F}), "right");
  ASSERT_TRUE(left && right);
  const Quat over(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()));
  const std::array<Object, 2> tables{Object(**left, {{{-0.2, -0.05, 0.0}, Quat::Identity()}, 1.0}),
                                     Object(**right, {{{0.2, -0.05, 0.0}, over}, 1.0})};
  HandCorrector corrector(test::settling());
  HandPose drawn;
  double fastest_m = 0.0;
  double deepest_m = 0.0;
  for (int i = 0; i < 270; ++i) {
    const double time_s = i * kFrame_s;
    const Pose place{{0.05 * std::sin(2.0 * time_s), 0.0, 0.0}, Quat::Identity()};
    const HandPose hand = laid_hand(place, std::min(0.02, 0.05 * time_s - 0.08));
    const HandPose now =
        corrector.update(hand, tables[static_cast<std::size_t>(i % 2)], i * kFrame_ns).pose;
    if (i > 120) {
      fastest_m = std::max(fastest_m, largest_motion(drawn, now));
      for (const Object& table : tables) {
        deepest_m = std::max(deepest_m, -test::least_room(now, table, 0.1));
      }
    }
    drawn = now;
  }
  EXPECT_LT(fastest_m, 0.005);
  EXPECT_LT(deepest_m, 0.004);
}

/// What the drawn hand does beyond three times the tracked one's motion, and how deep it is in the
/// end; the hand and its objects go along at `speed_mps`.
struct Displaced {
  double pop_m = 0.0;
  double deepest_m = 0.0;
};
template <class Hand, class Give>
Displaced displaced(double speed_mps, const Hand& hand_at, const Give& give) {
  constexpr int kFrames = 300;
  HandCorrector corrector(test::settling());
  Displaced result;
  HandPose tracked;
  HandPose drawn;
  for (int i = 0; i < kFrames; ++i) {
    const Pose ride{{speed_mps * i * kFrame_s, 0.0, 0.0}, Quat::Identity()};
    const HandPose hand = hand_at(i * kFrame_s);
    const Object here = give(i * kFrame_s);
    const Placement there{
        {ride.position + here.placement().pose.position, here.placement().pose.rotation},
        here.placement().scale};
    const Object object(here.surface(), there, here.identity().instance);
    const HandPose now =
        moved(corrector.update(moved(hand, ride), object, i * kFrame_ns).pose, ride.inverse());
    if (i > 0) {
      const double allowed_m = 3.0 * largest_motion(tracked, hand);
      result.pop_m = std::max(result.pop_m, largest_motion(drawn, now) - allowed_m);
    }
    tracked = hand;
    drawn = now;
  }
  result.deepest_m = -test::least_room(drawn, give(kFrames * kFrame_s), 0.1);
  return result;
}

/// Two of a kind, which share their surface, are given by turns: the nearer one. Fingers over the
/// other sink in until it is that; at once out, they jumped by 20 mm, and where the two were taken
/// for one that is suddenly elsewhere by 97.
TEST(MovingObject, FingersComeSlowlyOutOfAnotherObjectOfItsKind) {
  const auto surface = MeshSurface::build(test::box_mesh({0.2F, 0.02F, 0.15F}), "table").value();
  const auto hand_at = [](double time_s) {
    const double x_m = -0.2 + 0.4 * std::clamp((time_s - 1.0) / 1.5, 0.0, 1.0);
    return laid_hand({{x_m, 0.0, 0.0}, Quat::Identity()}, std::min(0.03, 0.11 * time_s - 0.08));
  };
  const auto give = [&](double time_s) {
    const bool second = hand_at(time_s)[Joint::palm].position.x() > 0.0;
    const Pose place{{second ? 0.2 : -0.2, -0.02, 0.0}, Quat::Identity()};
    return Object(*surface, {place, 1.0}, second ? 2 : 1);
  };
  for (const double speed_mps : {0.0, 5.0, 20.0}) {
    const Displaced result = displaced(speed_mps, hand_at, give);
    EXPECT_LT(result.pop_m, 0.004) << speed_mps << " m/s";
    EXPECT_LT(result.deepest_m, 0.001) << speed_mps << " m/s";
  }
}

/// It jumped by 86 mm.
TEST(MovingObject, AHandComesSlowlyOutOfAnObjectThatAppearsInIt) {
  const PlaneSurface table;
  const SphereSurface ball(0.06);
  const auto hand_at = [](double time_s) {
    return laid_hand({{}, Quat::Identity()}, std::min(0.03, 0.11 * time_s - 0.08));
  };
  const auto give = [&](double time_s) { return time_s < 2.0 ? Object(table) : Object(ball); };
  const Displaced result = displaced(0.0, hand_at, give);
  EXPECT_LT(result.pop_m, 0.006);
  EXPECT_LT(result.deepest_m, 0.001);
}

/// As where an animation's key is broken: that frame has no object, the others have one.
TEST(MovingObject, AnObjectOfNoUsableSizeIsNotThere) {
  const SphereSurface ball(0.15);
  const HandPose hand = laid_hand({{0.0, 0.15, 0.0}, Quat::Identity()}, 0.03);
  for (const double scale : {-1.0, std::nan(""), HUGE_VAL}) {
    HandCorrector corrector(test::settling());
    const Object object(ball, {{}, scale});
    EXPECT_TRUE(test::same_bits(hand, corrector.update(hand, object, 0).pose)) << scale;
  }
}

/// Some engines hide what they do not need so, or let it grow from nothing.
TEST(MovingObject, AnObjectOfScaleZeroIsNotThere) {
  const SphereSurface ball(0.15);
  const HandPose hand = laid_hand({{0.0, 0.15, 0.0}, Quat::Identity()}, 0.03);
  HandCorrector corrector(test::settling());
  EXPECT_TRUE(test::same_bits(hand, corrector.update(hand, Object(ball, {{}, 0.0}), 0).pose));
  HandPose drawn;
  for (int i = 1; i < 120; ++i) {
    const Object object(ball, {{}, std::min(1.0, i / 60.0)});
    drawn = corrector.update(hand, object, i * kFrame_ns).pose;
    EXPECT_TRUE(test::all_finite(drawn)) << i;
  }
  EXPECT_GT(test::least_room(drawn, Object(ball)), -0.001);
}

/// Together they may go and turn as they like: the drawn hand lies on the object as it does on one
/// that stands still.
TEST(MovingObject, AHandThatGoesAlongWithItsObjectLiesAsOnOneAtRest) {
  const SphereSurface ball(0.15);
  HandCorrector at_rest(test::settling());
  HandCorrector on_the_way(test::settling());
  double farthest_m = 0.0;
  for (int i = 0; i < 270; ++i) {
    const double time_s = i * kFrame_s;
    const Vec3 palm(0.05 * std::sin(2.0 * time_s), 0.15 + 0.01 * std::cos(2.0 * time_s), 0.02);
    const HandPose tracked = test::placed_hand(test::generic_size_hand(), palm, Quat::Identity());
    const Quat turn(Eigen::AngleAxisd(0.8 * time_s, Vec3(0.3, 0.5, 0.8).normalized()));
    const Pose place{{0.1 * time_s, 0.0, 0.05 * time_s}, turn};
    const HandPose still = at_rest.update(tracked, Object(ball), i * kFrame_ns).pose;
    const HandPose along =
        on_the_way.update(moved(tracked, place), Object(ball, {place, 1.0}), i * kFrame_ns).pose;
    farthest_m = std::max(farthest_m, largest_motion(still, moved(along, place.inverse())));
  }
  EXPECT_LT(farthest_m, 6e-4);
}

}  // namespace
}  // namespace nade
