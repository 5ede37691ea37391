#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>

#include "nade/corrector.h"
#include "nade/mesh.h"
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

TEST(ProxyProperties, HoldForRandomHandsSurfacesAndMotions) {
  test::Random random;
  SCOPED_TRACE(testing::Message() << "NADE_TEST_SEED=" << test::seed());
  const int trials = frames_wanted() / kFramesPerTrial;
  for (int trial = 0; trial < trials; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    expect_properties(random);
    if (HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace nade
