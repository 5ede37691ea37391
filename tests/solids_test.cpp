#include "nade/solids.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "support/surface_battery.h"

namespace nade {
namespace {

using test::Random;
using Vec2 = Eigen::Vector2d;

const test::BatteryRegion kRegion{Vec3(-.3, -.3, -.3), Vec3(.3, .3, .3), 1e-9};

/// Concave, clockwise from above: an L.
const std::vector<Vec2> kL{{-0.2, -0.2}, {-0.2, 0.2}, {0.0, 0.2},
                           {0.0, 0.05},  {0.2, 0.05}, {0.2, -0.2}};

std::vector<std::unique_ptr<Surface>> all_solids() {
  std::vector<std::unique_ptr<Surface>> solids;
  solids.push_back(std::make_unique<BoxSurface>(Vec3(0.1, 0.2, 0.05)));
  solids.push_back(std::make_unique<BoxSurface>(Vec3(0.1, 0.2, 0.05), 0.02));
  solids.push_back(std::make_unique<BoxSurface>(Vec3(0.1, 0.2, 0.05), 0.05));
  solids.push_back(std::make_unique<CylinderSurface>(0.2, 0.1));
  solids.push_back(std::make_unique<CylinderSurface>(0.02, 0.15, 0.01));
  solids.push_back(std::make_unique<CylinderSurface>(capsule_surface(0.2, 0.06)));
  solids.push_back(std::make_unique<CylinderSurface>(capsule_surface(0.0, 0.15)));
  solids.push_back(std::make_unique<EllipsoidSurface>(Vec3(0.1, 0.2, 0.05)));
  solids.push_back(std::make_unique<EllipsoidSurface>(Vec3(0.15, 0.15, 0.15)));
  solids.push_back(std::make_unique<EllipsoidSurface>(Vec3(0.2, 0.02, 0.02)));
  solids.push_back(std::make_unique<PlateSurface>(kL, 0.03));
  solids.push_back(
      std::make_unique<PlateSurface>(std::vector<Vec2>{{-.2, -.1}, {.2, -.1}, {.1, .2}}, 0.2));
  return solids;
}

TEST(Solids, Battery) {
  for (const auto& solid : all_solids()) test::run_surface_battery(*solid, kRegion);
}

TEST(Solids, NonsenseGetsNoAnswer) {
  for (const auto& solid : all_solids()) test::expect_no_answer_to_nonsense(*solid);
}

/// Middles, axes, corners and edges, where more than one point is as near.
TEST(Solids, EveryPlaceOfAGridHasAnAnswer) {
  for (const auto& solid : all_solids()) {
    for (int i = 0; i < 9 * 9 * 9; ++i) {
      const Vec3 query(0.05 * (i % 9 - 4), 0.05 * (i / 9 % 9 - 4), 0.05 * (i / 81 - 4));
      SurfaceHint hint;
      const auto found = solid->closest_point(query, 1.0, hint);
      ASSERT_TRUE(found.has_value()) << query.transpose();
      EXPECT_NEAR(found->normal.norm(), 1.0, 1e-9) << query.transpose();
      EXPECT_NEAR((found->point - query).norm(), std::abs(found->signed_distance), 1e-9);
      const auto on_it = solid->closest_point(found->point, 1.0, hint);
      ASSERT_TRUE(on_it.has_value());
      EXPECT_NEAR(on_it->signed_distance, 0.0, 1e-9) << query.transpose();
      for (const Vec3& way : {Vec3(Vec3::UnitX()), Vec3(-Vec3::UnitY()), Vec3(0.0, 0.6, 0.8)}) {
        const auto hit = solid->first_hit({query, way, 1.0});
        if (!hit) continue;
        EXPECT_GE(hit->distance, std::abs(found->signed_distance) - 1e-9);
        EXPECT_NEAR(solid->closest_point(hit->point, 1.0, hint)->signed_distance, 0.0, 1e-9);
      }
    }
  }
}

/// Against the same solids as triangles, which another program answers for.
TEST(Solids, AgreeWithTheirHulls) {
  Random random;
  const Vec3 half(0.1, 0.2, 0.05);
  std::vector<Eigen::Vector3f> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back(i & 1 ? 0.1F : -0.1F, i & 2 ? 0.2F : -0.2F, i & 4 ? 0.05F : -0.05F);
  }
  const auto hull = convex_hull(corners);
  ASSERT_TRUE(hull.ok()) << hull.error().message;
  EXPECT_EQ(hull->triangles.size(), 12U);
  const auto mesh = MeshSurface::build(*hull, "hull");
  ASSERT_TRUE(mesh.ok());
  EXPECT_EQ((*mesh)->report().solid, MeshSolid::closed);
  const BoxSurface box(half);
  for (int i = 0; i < 500; ++i) {
    const Vec3 query = random.point(kRegion.low, kRegion.high);
    SurfaceHint one;
    SurfaceHint other;
    EXPECT_NEAR(box.closest_point(query, 1.0, one)->signed_distance,
                (*mesh)->closest_point(query, 1.0, other)->signed_distance, 1e-6);
    const Ray ray{query, random.direction()};
    const auto exact = box.first_hit(ray);
    const auto meshed = (*mesh)->first_hit(ray);
    ASSERT_EQ(exact.has_value(), meshed.has_value());
    if (!exact) continue;
    EXPECT_NEAR(exact->distance, meshed->distance, 1e-6);
  }
}

TEST(Solids, ABallIsAnEllipsoidAndACapsule) {
  Random random;
  const SphereSurface ball(0.15);
  const EllipsoidSurface ellipsoid(Vec3(0.15, 0.15, 0.15));
  const CylinderSurface capsule = capsule_surface(0.0, 0.15);
  for (int i = 0; i < 500; ++i) {
    const Ray ray{random.point(kRegion.low, kRegion.high), random.direction()};
    SurfaceHint hint;
    const double distance = ball.closest_point(ray.origin, 1.0, hint)->signed_distance;
    for (const Surface* other :
         {static_cast<const Surface*>(&ellipsoid), static_cast<const Surface*>(&capsule)}) {
      EXPECT_NEAR(other->closest_point(ray.origin, 1.0, hint)->signed_distance, distance, 1e-12);
      const auto expected = ball.first_hit(ray);
      const auto hit = other->first_hit(ray);
      ASSERT_EQ(hit.has_value(), expected.has_value());
      if (!hit) continue;
      EXPECT_NEAR(hit->distance, expected->distance, 1e-9);
    }
  }
}

TEST(Solids, APlateIsSolidBelowItsOutlineOnly) {
  const PlateSurface plate(kL, 0.03);
  SurfaceHint hint;
  EXPECT_NEAR(plate.closest_point({-0.1, -0.01, 0.1}, 1.0, hint)->signed_distance, -0.01, 1e-12);
  EXPECT_NEAR(plate.closest_point({-0.1, -0.021, 0.1}, 1.0, hint)->signed_distance, -0.009, 1e-12);
  EXPECT_NEAR(plate.closest_point({0.1, -0.01, 0.1}, 1.0, hint)->signed_distance, 0.05, 1e-12);
  EXPECT_NEAR(plate.closest_point({-0.1, -1.0, 0.1}, 2.0, hint)->signed_distance, 0.97, 1e-12);
  EXPECT_FALSE(plate.first_hit({{0.1, 0.5, 0.1}, -Vec3::UnitY()}));
  EXPECT_NEAR(plate.first_hit({{-0.1, 0.5, 0.1}, -Vec3::UnitY()})->distance, 0.5, 1e-12);
}

TEST(Solids, AHullHoldsAllItsPoints) {
  Random random;
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 300; ++i) {
    points.push_back(random.point(Vec3(-0.2, -0.1, -0.1), Vec3(0.1, 0.2, 0.3)).cast<float>());
  }
  // Many in one plane, and doubles.
  for (int i = 0; i < 36; ++i) {
    points.emplace_back(0.1F * static_cast<float>(i % 6) - 0.25F, 0.3F,
                        0.1F * static_cast<float>(i / 6) - 0.25F);
    points.push_back(points.back());
  }
  const auto hull = convex_hull(points);
  ASSERT_TRUE(hull.ok());
  const auto mesh = MeshSurface::build(*hull, "hull");
  ASSERT_TRUE(mesh.ok());
  EXPECT_EQ((*mesh)->report().solid, MeshSolid::closed);
  EXPECT_EQ((*mesh)->report().triangles_turned, 0U);
  SurfaceHint hint;
  for (const Eigen::Vector3f& point : points) {
    EXPECT_LE((*mesh)->closest_point(point.cast<double>(), 1.0, hint)->signed_distance, 1e-6);
  }
}

TEST(Solids, PointsThatMakeNoHullAreRefused) {
  const std::vector<Eigen::Vector3f> flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  EXPECT_EQ(convex_hull(flat).error().message,
            "convex hull: expected points in a solid, found all in a plane");
  EXPECT_FALSE(convex_hull(std::span(flat).first(3)).ok());
  EXPECT_FALSE(convex_hull(std::vector<Eigen::Vector3f>(5, {1, 2, 3})).ok());
  std::vector<Eigen::Vector3f> bad = flat;
  bad[3].x() = std::nanf("");
  EXPECT_EQ(convex_hull(bad).error().message, "convex hull: point 3: expected finite coordinates");
}

TEST(Solids, AHeightFieldIsSolidBelow) {
  const std::vector<float> heights{0.0F, 0.0F, 0.0F, 0.0F, 0.1F, 0.0F, 0.0F, 0.0F, 0.0F};
  const auto soup = height_field(heights, 3, 0.5);
  ASSERT_TRUE(soup.ok());
  const auto mesh = MeshSurface::build(*soup, "hill");
  ASSERT_TRUE(mesh.ok());
  EXPECT_EQ((*mesh)->report().solid, MeshSolid::sheet);
  EXPECT_NEAR((*mesh)->first_hit({{0.0, 1.0, 0.0}, -Vec3::UnitY()})->distance, 0.9, 1e-6);
  SurfaceHint hint;
  EXPECT_LT((*mesh)->closest_point({0.0, 0.05, 0.0}, 1.0, hint)->signed_distance, 0.0);
  EXPECT_FALSE(height_field(heights, 4, 0.5).ok());
  EXPECT_FALSE(height_field(heights, 3, 0.0).ok());
}

TEST(Solids, AMeshScaledInAMirrorKeepsItsOutside) {
  std::vector<Eigen::Vector3f> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back(i & 1 ? 0.1F : -0.1F, i & 2 ? 0.1F : -0.1F, i & 4 ? 0.1F : -0.1F);
  }
  const auto mesh = MeshSurface::build(scaled(*convex_hull(corners), {-1.0, 2.0, 0.5}), "box");
  ASSERT_TRUE(mesh.ok());
  EXPECT_EQ((*mesh)->report().triangles_turned, 0U);
  SurfaceHint hint;
  EXPECT_NEAR((*mesh)->closest_point({0.0, 0.25, 0.0}, 1.0, hint)->signed_distance, 0.05, 1e-6);
  EXPECT_NEAR((*mesh)->closest_point(Vec3::Zero(), 1.0, hint)->signed_distance, -0.05, 1e-6);
}

}  // namespace
}  // namespace nade
