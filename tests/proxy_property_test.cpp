#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>

#include "nade/corrector.h"
#include "nade/mesh.h"
#include "support/allocation_counter.h"
#include "support/hand_checks.h"
#include "support/meshes.h"
#include "support/random.h"

namespace nade {
namespace {

constexpr int kFramesPerTrial = 200;
constexpr double kSame_m = 1e-5;
/// What comes in is rounded to 60 nm, which turns a finger's bones by so much at the most.
constexpr double kSame_rad = 5e-6;

/// How many frames: NADE_TEST_FRAMES, 1000000 for a night.
int frames_wanted() {
  const char* wanted = std::getenv("NADE_TEST_FRAMES");
  return wanted != nullptr ? std::max(kFramesPerTrial, std::atoi(wanted)) : 10'000;
}

Placement mirrored(Placement placement) {
  placement.pose.position.x() = -placement.pose.position.x();
  Quat& rotation = placement.pose.rotation;
  rotation = Quat(rotation.w(), rotation.x(), -rotation.y(), -rotation.z());
  return placement;
}

/// `symmetric` ones are their own mirror images.
struct TestSurface {
  std::string name;
  std::shared_ptr<const Surface> surface;
  bool symmetric = false;
};

TestSurface random_surface(test::Random& random) {
  const auto size = static_cast<float>(random.uniform(0.03, 0.3));
  const auto mesh = [](const std::string& name, const TriangleSoup& soup) {
    return TestSurface{name, MeshSurface::build(soup, name).value()};
  };
  switch (random.below(5)) {
    case 0:
      return {"ball", std::make_shared<SphereSurface>(random.uniform(0.03, 0.4)), true};
    case 1:
      return {"plane", std::make_shared<PlaneSurface>(), true};
    case 2:
      return mesh("hills", test::bumpy_sphere(size, 48, 24));
    case 3:
      return mesh("box", test::box_mesh({size, 0.6F * size, 0.8F * size}));
    default:
      return mesh("sheet", test::grid_mesh(size, 8));
  }
}

HandPose random_hand(test::Random& random) {
  HandAngles angles = test::relaxed_angles();
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    for (std::size_t i = 0; i < kHingeCount; ++i) {
      const HingeRange range = range_of_motion(digit_at(d), i);
      angles[d][i].flexion = random.uniform(range.flexion_min, range.flexion_max);
    }
  }
  const Handedness side = random.below(2) == 0 ? Handedness::right : Handedness::left;
  HandPose hand = test::generic_size_hand(side, angles);
  const double size = random.uniform(0.7, 1.3);
  for (Pose& joint : hand.joints) joint.position *= size;
  return hand;
}

/// Where a hand wanders: about the object's middle, or about a place on its surface.
Vec3 middle_of_wandering(test::Random& random, const Object& object) {
  const Vec3& middle = object.placement().pose.position;
  const Vec3 seen_from = middle + random.direction();
  SurfaceHint hint;
  const auto nearest = object.closest_point(seen_from, 10.0, hint);
  return random.below(2) == 0 && nearest ? nearest->point : middle;
}

/// How an object goes to and fro, turns and breathes; in half of the trials not at all.
struct Wandering {
  Placement middle;
  Vec3 way = Vec3::Zero();
  Vec3 turn = Vec3::Zero();  ///< about this, by its length
  double growth = 0.0;
  double speed = 0.0;

  [[nodiscard]] Placement in(int frame) const {
    const double swing = std::sin(speed * frame);
    Placement placement = middle;
    placement.pose.position += swing * way;
    placement.pose.rotation =
        Quat(Eigen::AngleAxisd(swing * turn.norm(), turn.normalized())) * middle.pose.rotation;
    placement.scale *= 1.0 + growth * swing;
    return placement;
  }
};

Wandering random_wandering(test::Random& random, const Placement& middle) {
  Wandering object{middle, Vec3::Zero(), Vec3::Zero(), 0.0, 0.0};
  if (random.below(2) == 0) return object;
  object.way = random.uniform(0.0, 0.1) * random.direction();
  object.turn = random.uniform(0.0, 1.0) * random.direction();
  object.growth = random.uniform(0.0, 0.3);
  object.speed = random.uniform(0.01, 0.2);
  return object;
}

/// One hand that wanders through one object, three times over: as it is, in the mirror, and moved
/// together with the object.
void expect_properties(test::Random& random) {
  const TestSurface surface = random_surface(random);
  const Placement placement{{random.point({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}), random.rotation()},
                            random.uniform(0.7, 1.4)};
  const Pose motion{random.point({-2.0, -2.0, -2.0}, {2.0, 2.0, 2.0}), random.rotation()};
  const Wandering wandering = random_wandering(random, placement);
  const HandPose hand = random_hand(random);
  const Quat turn = random.rotation();
  const Vec3 middle = middle_of_wandering(random, Object(*surface.surface, placement));
  const Vec3 roll = random.direction();
  const double reach_m = random.uniform(0.005, 0.2);
  const double speed = random.uniform(0.01, 0.2);
  HandCorrector corrector;
  HandCorrector again;
  HandCorrector moved_along;
  HandCorrector other_side;
  std::int64_t time_ns = 0;
  for (int i = 0; i < kFramesPerTrial; ++i) {
    time_ns += 5'000'000 + random.below(15'000'000);
    const Vec3 palm(reach_m * std::sin(speed * i), reach_m * std::cos(1.3 * speed * i),
                    reach_m * std::sin(0.7 * speed * i));
    const Quat rolled(Eigen::AngleAxisd(0.3 * std::sin(0.4 * speed * i), roll));
    const HandPose tracked = test::placed_hand(hand, middle + palm, rolled * turn);
    const Placement now = wandering.in(i);
    const Object here(*surface.surface, now);
    const Object there(*surface.surface, {motion * now.pose, now.scale});
    const Object in_mirror(*surface.surface, mirrored(now));
    const CorrectedHand& corrected = corrector.update(tracked, here, time_ns);
    const HandPose drawn = corrected.pose;
    SCOPED_TRACE(testing::Message() << surface.name << ", frame " << i);
    ASSERT_TRUE(test::all_finite(drawn));
    ASSERT_LT(test::limit_violation(tracked, drawn), kSame_rad);
    if (corrected.status == HandStatus::free) {
      ASSERT_TRUE(test::same_bits(tracked, drawn));
    }
    ASSERT_TRUE(test::same_bits(drawn, again.update(tracked, here, time_ns).pose));
    const HandPose moved_drawn = moved_along.update(moved(tracked, motion), there, time_ns).pose;
    ASSERT_LT(largest_motion(moved(drawn, motion), moved_drawn), kSame_m);
    if (!surface.symmetric) continue;
    const HandPose mirror_drawn = other_side.update(mirrored(tracked), in_mirror, time_ns).pose;
    ASSERT_LT(largest_motion(drawn, mirrored(mirror_drawn)), kSame_m);
  }
  if (surface.name == "plane") return;
  const Object here(*surface.surface, wandering.in(kFramesPerTrial));
  const HandPose away =
      test::placed_hand(hand, here.placement().pose.position + Vec3(0.0, 3.0, 0.0), turn);
  corrector.update(away, here, time_ns + 1'000'000'000);
  EXPECT_TRUE(test::same_bits(away, corrector.update(away, here, time_ns + 2'000'000'000).pose));
}

/// A tracker at its worst: it jumps by a few centimetres or metres, misses frames, and its clock
/// stands still or goes back; now and then the object jumps, grows, or is another.
void expect_calm_in_a_storm(test::Random& random) {
  const TestSurface one = random_surface(random);
  const TestSurface two = random_surface(random);
  const HandPose hand = random_hand(random);
  HandCorrector corrector;
  HandCorrector again;
  Placement placement;
  std::int64_t time_ns = 0;
  Vec3 palm = random.point({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1});
  for (int i = 0; i < kFramesPerTrial; ++i) {
    const bool calm = random.below(8) != 0;
    time_ns += calm ? 11'000'000 : static_cast<std::int64_t>(random.below(2'000)) * 1'000'000;
    if (random.below(40) == 0) time_ns -= 30'000'000;
    palm += 0.003 * random.direction();
    if (random.below(30) == 0) palm += random.uniform(0.0, 0.3) * random.direction();
    if (random.below(50) == 0) placement.pose.position += 0.1 * random.direction();
    if (random.below(50) == 0) placement.scale = random.uniform(0.0, 2.0);
    Vec3 seen = palm;
    if (!calm) seen += std::pow(10.0, random.uniform(-3.0, 3.0)) * random.direction();
    HandPose tracked =
        test::placed_hand(hand, seen, calm ? Quat(1.0, 0.0, 0.0, 0.0) : random.rotation());
    if (random.below(60) == 0) tracked.joints[random.below(kJointCount)].position.x() = NAN;
    const Object object(random.below(30) == 0 ? *two.surface : *one.surface, placement);
    SCOPED_TRACE(testing::Message() << one.name << ", " << two.name << ", frame " << i);
    const CorrectedHand* drawn = nullptr;
    ASSERT_EQ(test::allocations_of([&] { drawn = &corrector.update(tracked, object, time_ns); }),
              0U);
    const HandPose& second = again.update(tracked, object, time_ns).pose;
    if (drawn->status == HandStatus::untracked) continue;
    ASSERT_TRUE(test::all_finite(drawn->pose));
    ASSERT_TRUE(test::same_bits(drawn->pose, second));
  }
}

/// On a table, where nothing lets it go, the drawn hand goes about as fast as the tracked one.
void expect_speed_bound(test::Random& random) {
  constexpr double kFrame_s = 0.011;
  constexpr double kFaster = 1.5;
  constexpr double kByItself_mps = 0.2;  // home, or what comes back of a shift
  const PlaneSurface table;
  const HandPose hand = random_hand(random);
  const Quat turn(Eigen::AngleAxisd(random.uniform(-0.6, 0.6), random.direction()));
  const double speed = random.uniform(0.005, 0.05);
  const double deep_m = random.uniform(0.01, 0.08);
  HandCorrector corrector;
  std::optional<HandPose> last;
  HandPose last_drawn;
  for (int i = 0; i < kFramesPerTrial; ++i) {
    const Vec3 palm(0.2 * std::sin(speed * i), 0.08 - deep_m * std::sin(0.7 * speed * i),
                    0.1 * std::cos(speed * i));
    const HandPose tracked = test::placed_hand(hand, palm, turn);
    const HandPose drawn = corrector.update(tracked, Object(table), i * 11'000'000LL).pose;
    if (last) {
      const double most_m = kFaster * largest_motion(*last, tracked) + kByItself_mps * kFrame_s;
      ASSERT_LT(largest_motion(last_drawn, drawn), most_m) << "frame " << i;
    }
    last = tracked;
    last_drawn = drawn;
  }
}

template <class Trial>
void run_trials(Trial trial) {
  test::Random random;
  SCOPED_TRACE(testing::Message() << "NADE_TEST_SEED=" << test::seed());
  const int trials = frames_wanted() / kFramesPerTrial;
  for (int i = 0; i < trials; ++i) {
    SCOPED_TRACE(testing::Message() << "trial " << i);
    trial(random);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(ProxyProperties, NothingOfAStormIsDrawnAsNoNumber) { run_trials(expect_calm_in_a_storm); }

TEST(ProxyProperties, TheDrawnHandGoesNoFasterThanThePerson) { run_trials(expect_speed_bound); }

TEST(ProxyProperties, HoldForRandomHandsSurfacesAndMotions) { run_trials(expect_properties); }

}  // namespace
}  // namespace nade
