#pragma once

// What every surface must do, whatever it is made of.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "nade/surface.h"
#include "support/random.h"

namespace nade::test {

/// Farther than anything is looked for.
inline constexpr double kAnywhere = 1e9;

struct BatteryRegion {
  Vec3 low;
  Vec3 high;
  double tolerance_m = 1e-6;
  bool bounded = true;  ///< whether every way from the inside leads out
};

/// Samples are all over the surface.
inline void expect_bounds_around(const Surface& surface, const std::vector<Vec3>& samples,
                                 const BatteryRegion& region) {
  const auto bounds = surface.bounds();
  EXPECT_TRUE(bounds || !region.bounded);
  if (!bounds) return;
  Vec3 low = samples.front();
  Vec3 high = low;
  for (const Vec3& sample : samples) {
    EXPECT_LE(bounds->distance(sample), region.tolerance_m);
    low = low.cwiseMin(sample);
    high = high.cwiseMax(sample);
  }
  EXPECT_LT((bounds->high - bounds->low).norm(), 3.0 * (high - low).norm());
}

/// Rays and points in the region: hits lie on the surface and say rightly on which side they
/// were; normals are unit; no hit is nearer than the closest point; the sign changes along a ray
/// exactly where it hits; what bounds it has hold all of it, and are not three times as large.
inline void run_surface_battery(const Surface& surface, const BatteryRegion& region) {
  SCOPED_TRACE("NADE_TEST_SEED=" + std::to_string(seed()));
  Random random;
  std::vector<Vec3> samples;
  for (int i = 0; i < 2000; ++i) {
    const Ray ray{random.point(region.low, region.high), random.direction()};
    SurfaceHint hint;
    const auto start = surface.closest_point(ray.origin, kAnywhere, hint);
    ASSERT_TRUE(start.has_value());
    EXPECT_NEAR(start->normal.norm(), 1.0, 1e-9);
    EXPECT_NEAR((start->point - ray.origin).norm(), std::abs(start->signed_distance), 1e-9);
    EXPECT_FALSE(
        surface.closest_point(ray.origin, 0.999 * std::abs(start->signed_distance) - 1e-9, hint));
    const auto hit = surface.first_hit(ray);
    if (!hit) {
      EXPECT_TRUE(!region.bounded || start->signed_distance > -region.tolerance_m);
      continue;
    }
    EXPECT_NEAR(hit->normal.norm(), 1.0, 1e-9);
    EXPECT_NEAR((ray.origin + hit->distance * ray.direction - hit->point).norm(), 0.0,
                region.tolerance_m);
    EXPECT_EQ(hit->from_inside, hit->normal.dot(ray.direction) > 0.0);
    EXPECT_GE(hit->distance, std::abs(start->signed_distance) - region.tolerance_m);
    if (std::abs(start->signed_distance) > region.tolerance_m) {
      EXPECT_EQ(hit->from_inside, start->signed_distance < 0.0);
    }
    const auto at_hit = surface.closest_point(hit->point, kAnywhere, hint);
    ASSERT_TRUE(at_hit.has_value());
    EXPECT_NEAR(at_hit->signed_distance, 0.0, region.tolerance_m);
    EXPECT_FALSE(surface.first_hit({ray.origin, ray.direction, 0.999 * hit->distance - 1e-9}));
    samples.push_back(hit->point);
  }
  ASSERT_FALSE(samples.empty());
  expect_bounds_around(surface, samples, region);
  SurfaceHint hint;
  for (int i = 0; i < 200; ++i) {
    const Vec3 query = random.point(region.low, region.high);
    const auto nearest = surface.closest_point(query, kAnywhere, hint);
    ASSERT_TRUE(nearest.has_value());
    for (const Vec3& sample : samples) {
      EXPECT_LE(std::abs(nearest->signed_distance), (sample - query).norm() + region.tolerance_m);
    }
  }
}

/// Queries that are not finite get no answer.
inline void expect_no_answer_to_nonsense(const Surface& surface) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (const double bad : {kNan, kInf, -kInf}) {
    SurfaceHint hint;
    EXPECT_FALSE(surface.first_hit({{0.0, bad, 0.0}, -Vec3::UnitY()}));
    EXPECT_FALSE(surface.first_hit({{0.0, 1.0, 0.0}, {0.0, bad, 0.0}}));
    EXPECT_FALSE(surface.closest_point({bad, 0.0, 0.0}, 1.0, hint));
  }
  SurfaceHint hint;
  EXPECT_FALSE(surface.first_hit({{0.0, 1.0, 0.0}, Vec3::Zero()}));
  EXPECT_FALSE(surface.first_hit({{0.0, 1.0, 0.0}, -Vec3::UnitY(), kNan}));
  EXPECT_FALSE(surface.closest_point({0.0, 1.0, 0.0}, kNan, hint));
}

}  // namespace nade::test
