#include "nade/surface.h"

#include <gtest/gtest.h>

#include <type_traits>

#include "support/surface_battery.h"

namespace nade {
namespace {

using test::Random;

// It would keep the address of a surface that is gone.
static_assert(!std::is_constructible_v<Object, SphereSurface>);
static_assert(std::is_constructible_v<Object, const SphereSurface&>);

TEST(Surface, PlaneBattery) {
  test::run_surface_battery(PlaneSurface{}, {Vec3(-1, -1, -1), Vec3(1, 1, 1), 1e-9, false});
}

TEST(Surface, SphereBattery) {
  test::run_surface_battery(SphereSurface(0.15), {Vec3(-.2, -.2, -.2), Vec3(.2, .2, .2), 1e-9});
}

TEST(Surface, NonsenseGetsNoAnswer) {
  test::expect_no_answer_to_nonsense(PlaneSurface{});
  test::expect_no_answer_to_nonsense(SphereSurface(0.15));
  const SphereSurface sphere(0.15);
  const Object object(sphere);
  SurfaceHint hint;
  EXPECT_FALSE(object.closest_point(Vec3::Constant(std::nan("")), 1.0, hint));
}

TEST(Surface, PlaneHasItsSolidBelow) {
  const PlaneSurface plane;
  SurfaceHint hint;
  EXPECT_DOUBLE_EQ(plane.closest_point({1.0, -0.02, 3.0}, 1.0, hint)->signed_distance, -0.02);
  const auto out = plane.first_hit({{1.0, -0.02, 3.0}, Vec3::UnitY()});
  ASSERT_TRUE(out.has_value());
  EXPECT_TRUE(out->from_inside);
  EXPECT_DOUBLE_EQ(out->distance, 0.02);
  EXPECT_FALSE(plane.first_hit({{1.0, 0.02, 3.0}, Vec3::UnitY()}));
  EXPECT_FALSE(plane.first_hit({{1.0, 0.0, 3.0}, Vec3::UnitX()}));
}

TEST(Surface, SphereCentreHasSomeNormal) {
  const SphereSurface sphere(0.15);
  SurfaceHint hint;
  const auto found = sphere.closest_point(Vec3::Zero(), 1.0, hint);
  ASSERT_TRUE(found.has_value());
  EXPECT_DOUBLE_EQ(found->normal.norm(), 1.0);
  EXPECT_DOUBLE_EQ(found->signed_distance, -0.15);
  EXPECT_DOUBLE_EQ(found->point.norm(), 0.15);
}

TEST(Surface, ObjectAnswersInTheWorld) {
  SCOPED_TRACE("NADE_TEST_SEED=" + std::to_string(test::seed()));
  Random random;
  const SphereSurface sphere(0.1);
  for (int i = 0; i < 200; ++i) {
    const Placement placement{{random.point(Vec3(-1, -1, -1), Vec3(1, 1, 1)), random.rotation()},
                              random.uniform(0.5, 2.0)};
    const Object object(sphere, placement);
    const Vec3 centre = placement.pose.position;
    const double radius = 0.1 * placement.scale;
    const Vec3 query = centre + random.direction() * random.uniform(0.0, 2.0 * radius);
    SurfaceHint hint;
    const auto found = object.closest_point(query, 1.0, hint);
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(found->signed_distance, (query - centre).norm() - radius, 1e-12);
    EXPECT_NEAR((found->point - centre).norm(), radius, 1e-12);
    EXPECT_NEAR(found->normal.dot((query - centre).normalized()), 1.0, 1e-9);
    const auto hit = object.first_hit({centre, random.direction(), 1.01 * radius});
    ASSERT_TRUE(hit.has_value());
    EXPECT_NEAR(hit->distance, radius, 1e-12);
    EXPECT_TRUE(hit->from_inside);
    EXPECT_FALSE(object.first_hit({centre, random.direction(), 0.99 * radius}));
  }
}

/// Leaves a mark in the hint, as a mesh does.
class MarkingSurface final : public Surface {
 public:
  [[nodiscard]] std::optional<RayHit> first_hit(const Ray& /*ray*/) const noexcept override {
    return std::nullopt;
  }
  [[nodiscard]] std::optional<SurfacePoint> closest_point(
      const Vec3& query, double /*max_distance*/, SurfaceHint& hint) const noexcept override {
    hint.element += 1;
    return SurfacePoint{query, Vec3::UnitY(), 0.0};
  }
};

TEST(Surface, ObjectPassesTheHintOn) {
  const MarkingSurface surface;
  const Object object(surface);
  SurfaceHint hint{41};
  ASSERT_TRUE(object.closest_point(Vec3::Zero(), 1.0, hint));
  EXPECT_EQ(hint.element, 42U);
}

/// A rotation 0.05 % too long, as of a lerp, left nothing to touch.
TEST(Surface, AnObjectsRotationIsNormalized) {
  const SphereSurface ball(0.1);
  const Quat turn(Eigen::AngleAxisd(0.5, Vec3(1.0, 2.0, 3.0).normalized()));
  Pose pose{{0.0, 0.2, 0.0}, turn};
  EXPECT_EQ(Object(ball, {pose, 1.0}).placement().pose.rotation.coeffs(), turn.coeffs());
  pose.rotation.coeffs() *= 1.1;
  const Object object(ball, {pose, 1.0});
  EXPECT_LT(object.placement().pose.rotation.angularDistance(turn), 1e-12);
  EXPECT_NEAR(object.placement().pose.rotation.norm(), 1.0, 1e-12);
}

TEST(Surface, NothingIsNowhere) {
  SurfaceHint hint;
  EXPECT_FALSE(nothing().closest_point(Vec3::Zero(), 10.0, hint));
  EXPECT_FALSE(nothing().first_hit({Vec3::Zero(), Vec3::UnitX(), 10.0}));
}

}  // namespace
}  // namespace nade
