#include "nade/mesh.h"

#include <gtest/gtest.h>

#include <iostream>
#include <numbers>
#include <set>

#include "nade/io/mesh_file.h"
#include "support/allocation_counter.h"
#include "support/brute_force.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/sanitized.h"
#include "support/surface_battery.h"

namespace nade {
namespace {

using test::BruteForce;
using test::Random;

std::unique_ptr<MeshSurface> build(const TriangleSoup& soup) {
  auto mesh = MeshSurface::build(soup, "test");
  EXPECT_TRUE(mesh.ok()) << (mesh.ok() ? "" : mesh.error().message);
  return std::move(mesh.value());
}

double signed_distance(const Surface& surface, const Vec3& query) {
  SurfaceHint hint;
  return surface.closest_point(query, test::kAnywhere, hint)->signed_distance;
}

Eigen::AlignedBox3d box_of(const TriangleSoup& soup) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : soup.vertices) box.extend(vertex.cast<double>());
  return box;
}

test::BatteryRegion region_of(const TriangleSoup& soup) {
  const Eigen::AlignedBox3d box = box_of(soup);
  return {box.min() - 0.2 * box.sizes(), box.max() + 0.2 * box.sizes(), 2e-6};
}

/// A bumpy ball with everything wrong at once, and still a ball to a person.
TriangleSoup broken_mesh() {
  TriangleSoup soup = test::bumpy_sphere(0.12F, 30, 30);
  Random random(7);
  const std::size_t count = soup.triangles.size();
  for (std::size_t i = 0; i < count; i += 11) {
    std::swap(soup.triangles[i][0], soup.triangles[i][1]);  // flipped
  }
  for (std::size_t i = 5; i < count; i += 97) soup.triangles.push_back(soup.triangles[i]);
  for (std::uint32_t i = 0; i < 20; ++i) {
    const std::uint32_t vertex = random.below(static_cast<std::uint32_t>(soup.vertices.size()));
    soup.triangles.push_back({vertex, vertex, 3});  // degenerate
  }
  soup.triangles.erase(soup.triangles.begin() + 600);  // holes
  soup.triangles.erase(soup.triangles.begin() + 1100);
  const auto& edge = soup.triangles[300];  // a fin on an edge
  soup.vertices.emplace_back(1.1F * soup.vertices[edge[0]]);
  soup.triangles.push_back(
      {edge[0], edge[1], static_cast<std::uint32_t>(soup.vertices.size() - 1)});
  return soup;
}

constexpr int kMany = test::kSanitized ? 5'000 : 100'000;

struct QueryCounts {
  int rays;
  int points;
  int signs;
};

/// Rays, closest points and signs against brute force. Signs where they are sure: away from the
/// surface and, where a mesh has holes, from the places where the winding number is undecided.
void expect_brute_force(const TriangleSoup& soup, const TriangleSoup& repaired,
                        const QueryCounts& counts) {
  SCOPED_TRACE("NADE_TEST_SEED=" + std::to_string(test::seed()));
  const auto mesh = build(soup);
  BruteForce brute(soup);
  const BruteForce clean(repaired);
  const auto [low, high, tolerance, bounded] = region_of(soup);
  Random random;
  int doubtful = 0;
  for (int i = 0; i < counts.rays; ++i) {
    const Vec3 origin = random.point(low, high);
    const Ray ray{origin, (random.point(low, high) - origin).normalized()};
    const auto ours = mesh->first_hit(ray);
    const auto [expected, is_doubtful] = brute.first_hit(ray);
    const bool agree = ours.has_value() == std::isfinite(expected) &&
                       (!ours || std::abs(ours->distance - expected) < 1e-6);
    // Along an edge or a silhouette, rounding may decide; nowhere else.
    ASSERT_TRUE(agree || is_doubtful) << "ray " << i;
    if (!agree) ++doubtful;
  }
  EXPECT_LE(doubtful, counts.rays / 1000);
  for (int i = 0; i < counts.points; ++i) {
    const Vec3 query = random.point(low, high);
    SurfaceHint hint{i % 3 == 0 ? random.below(4000) : SurfaceHint::kNone};
    const auto ours = mesh->closest_point(query, test::kAnywhere, hint);
    ASSERT_TRUE(ours.has_value());
    ASSERT_NEAR(std::abs(ours->signed_distance), brute.distance(query), 1e-6) << "point " << i;
  }
  for (int i = 0; i < counts.signs; ++i) {
    const Vec3 query = random.point(low, high);
    const double ours = signed_distance(*mesh, query);
    const double winding = clean.winding(query);
    if (std::abs(winding - 0.5) < 0.1 || std::abs(ours) < tolerance) continue;
    ASSERT_EQ(ours<0.0, winding> 0.5) << "point " << i << ", winding number " << winding;
  }
}

TEST(Mesh, AgreesWithBruteForceOnTheBunny) {
  const auto bunny = test::find_bunny();
  if (!bunny) GTEST_SKIP() << "the bunny is not in the asset cache";
  expect_brute_force(*bunny, *bunny, {kMany, kMany, kMany / 20});
}

TEST(Mesh, AgreesWithBruteForceOnTheDog) {
  const auto dog = load_mesh(NADE_TEST_DOG);
  if (!dog.ok()) GTEST_SKIP() << dog.error().message;
  expect_brute_force(dog->soup, dog->soup, {kMany / 10, kMany / 10, kMany / 200});
}

TEST(Mesh, AgreesWithBruteForceOnABrokenMesh) {
  expect_brute_force(broken_mesh(), test::bumpy_sphere(0.12F, 30, 30), {kMany, kMany, kMany / 10});
}

TEST(Mesh, Batteries) {
  for (const TriangleSoup& soup :
       {test::box_mesh({0.1F, 0.05F, 0.08F}), test::icosphere(0.15F, 3),
        test::bumpy_sphere(0.12F, 60, 60), test::subdivided(test::box_mesh({.1F, .1F, .1F}), 3)}) {
    test::run_surface_battery(*build(soup), region_of(soup));
  }
}

TEST(Mesh, BatteryFarFromItsOrigin) {
  TriangleSoup soup = test::shifted(test::icosphere(0.15F, 3), {20.0F, -30.0F, 40.0F});
  test::BatteryRegion region = region_of(soup);
  region.tolerance_m = 5e-5;
  test::run_surface_battery(*build(soup), region);
}

TEST(Mesh, NonsenseGetsNoAnswer) {
  test::expect_no_answer_to_nonsense(*build(test::icosphere(0.15F, 2)));
}

TEST(Mesh, FarAwayStillAnswers) {
  const auto mesh = build(test::icosphere(0.15F, 4));
  for (const double far : {10.0, 1e4, 1e9, 1e100}) {
    SurfaceHint hint;
    const auto found =
        mesh->closest_point({0.0, far, 0.0}, std::numeric_limits<double>::infinity(), hint);
    ASSERT_TRUE(found.has_value()) << far;
    EXPECT_NEAR(found->signed_distance / far, 1.0, 0.02) << far;
  }
  const auto hit = mesh->first_hit({{0.0, 1000.0, 0.0}, -Vec3::UnitY()});
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(hit->distance, 1000.0 - 0.15, 1e-3);
}

TEST(Mesh, EightyThousandTrianglesAreLikeTheSphere) {
  const auto mesh = build(test::uv_sphere(0.15F, 200, 201));
  EXPECT_EQ(mesh->report().triangles_used, 80000U);
  const SphereSurface sphere(0.15);
  Random random;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 query = random.uniform(0.12, 0.25) * random.direction();  // pressed 30 mm at most
    SurfaceHint hint;
    const auto ours = mesh->closest_point(query, 1.0, hint);
    const auto exact = sphere.closest_point(query, 1.0, hint);
    EXPECT_NEAR(ours->signed_distance, exact->signed_distance, 5e-5);
    EXPECT_GT(ours->normal.dot(exact->normal), std::cos(0.5 * kDegree));
    const Ray ray{0.1 * random.direction(), random.direction()};
    EXPECT_NEAR(mesh->first_hit(ray)->distance, sphere.first_hit(ray)->distance, 2e-4);
    EXPECT_GT(mesh->first_hit(ray)->normal.dot(sphere.first_hit(ray)->normal),
              std::cos(0.5 * kDegree));
  }
}

TEST(Mesh, CreasesStaySharp) {
  const auto mesh = build(test::subdivided(test::box_mesh({0.1F, 0.1F, 0.1F}), 2));
  Random random;
  for (int i = 0; i < 500; ++i) {
    const Vec3 query{random.uniform(-0.099, 0.099), 0.12, random.uniform(-0.099, 0.099)};
    SurfaceHint hint;
    EXPECT_GT(mesh->closest_point(query, 1.0, hint)->normal.y(), 1.0 - 1e-8);
    EXPECT_GT(mesh->first_hit({query, -Vec3::UnitY()})->normal.y(), 1.0 - 1e-8);
  }
}

TEST(Mesh, TipOfThinTrianglesPointsUp) {
  for (const std::uint32_t count : {12U, 200U, 3000U}) {
    TriangleSoup cone;
    cone.vertices = {{0.0F, 0.1F, 0.0F}, {0.0F, 0.0F, 0.0F}};
    for (std::uint32_t i = 0; i < count; ++i) {
      const float angle =
          2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(count);
      cone.vertices.emplace_back(0.3F * std::sin(angle), 0.0F, 0.3F * std::cos(angle));
      const std::uint32_t next = 2 + (i + 1) % count;
      cone.triangles.push_back({0, 2 + i, next});
      cone.triangles.push_back({1, next, 2 + i});
    }
    SurfaceHint hint;
    const auto point = build(cone)->closest_point({0.0, 0.2, 0.0}, test::kAnywhere, hint);
    EXPECT_NEAR(point->normal.y(), 1.0, 1e-6) << count;
    EXPECT_NEAR(point->signed_distance, 0.1, 1e-6) << count;
  }
}

TEST(Mesh, OnACreaseTheNormalIsBetweenTheFaces) {
  const TriangleSoup box = test::subdivided(test::box_mesh({0.1F, 0.1F, 0.1F}), 2);
  TriangleSoup holed = box;  // far from that crease
  holed.triangles.pop_back();
  for (const TriangleSoup& soup : {box, holed}) {
    const auto mesh = build(soup);
    for (const double beyond : {0.001, 0.01, 0.05}) {
      for (const Vec3& from : {Vec3(0.13, 0.09, 0.013), Vec3(0.09, 0.13, 0.013)}) {
        SurfaceHint hint;
        (void)mesh->closest_point(from, 1.0, hint);
        const auto nearest = mesh->closest_point({0.1 + beyond, 0.12, 0.013}, 1.0, hint);
        EXPECT_NEAR(nearest->normal.x(), std::sqrt(0.5), 1e-6);
        EXPECT_NEAR(nearest->normal.y(), std::sqrt(0.5), 1e-6);
      }
    }
  }
}

TEST(Mesh, InsideOutIsTurned) {
  const auto mesh = build(test::turned_inside_out(test::icosphere(0.15F, 2)));
  EXPECT_EQ(mesh->report().triangles_turned, 320U);
  EXPECT_EQ(mesh->report().solid, MeshSolid::closed);
  EXPECT_LT(signed_distance(*mesh, {0.0, 0.1, 0.0}), 0.0);
}

TEST(Mesh, CavityStaysHollow) {
  const TriangleSoup shell =
      test::joined(test::icosphere(0.15F, 3), test::turned_inside_out(test::icosphere(0.1F, 3)));
  for (const TriangleSoup& soup : {shell, test::turned_inside_out(shell)}) {
    const auto mesh = build(soup);
    EXPECT_EQ(mesh->report().solid, MeshSolid::closed);
    EXPECT_GT(signed_distance(*mesh, {0.0, 0.05, 0.0}), 0.0);
    EXPECT_LT(signed_distance(*mesh, {0.0, 0.12, 0.0}), 0.0);
    EXPECT_GT(signed_distance(*mesh, {0.0, 0.2, 0.0}), 0.0);
    EXPECT_FALSE(mesh->first_hit({Vec3::Zero(), Vec3::UnitX()})->from_inside);
  }
}

TEST(Mesh, InsideOutNeighbourIsTurnedAlone) {
  const TriangleSoup small = test::shifted(test::icosphere(0.05F, 2), {0.5F, 0.0F, 0.0F});
  const auto mesh = build(test::joined(test::icosphere(0.15F, 2), test::turned_inside_out(small)));
  EXPECT_EQ(mesh->report().triangles_turned, 320U);
  EXPECT_LT(signed_distance(*mesh, {0.5, 0.01, 0.0}), 0.0);
  EXPECT_LT(signed_distance(*mesh, {0.0, 0.01, 0.0}), 0.0);
}

TEST(Mesh, OverlappingPartsAreOneSolid) {
  const auto mesh = build(test::joined(test::icosphere(0.1F, 3),
                                       test::shifted(test::icosphere(0.1F, 3), {0.1F, 0, 0})));
  for (const double x : {-0.05, 0.01, 0.05, 0.09, 0.15}) {
    EXPECT_LT(signed_distance(*mesh, {x, 0.0, 0.0}), 0.0) << x;
  }
  EXPECT_GT(signed_distance(*mesh, {-0.11, 0.0, 0.0}), 0.0);
  EXPECT_GT(signed_distance(*mesh, {0.05, 0.11, 0.0}), 0.0);
}

TEST(Mesh, ReportsWhatItMends) {
  TriangleSoup soup = test::icosphere(0.15F, 2);
  std::swap(soup.triangles[7][0], soup.triangles[7][1]);
  soup.triangles.push_back(soup.triangles[3]);
  soup.triangles.push_back({5, 5, 9});
  const MeshReport report = build(soup)->report();
  EXPECT_EQ(report.triangles_used, 320U);
  EXPECT_EQ(report.triangles_turned, 1U);
  EXPECT_EQ(report.triangles_duplicate, 1U);
  EXPECT_EQ(report.triangles_degenerate, 1U);
  EXPECT_EQ(report.border_edges, 0U);
  EXPECT_EQ(report.solid, MeshSolid::closed);
}

TEST(Mesh, UnweldedTrianglesAreClosedAll) {
  const TriangleSoup welded = test::icosphere(0.15F, 2);
  TriangleSoup soup;
  for (const auto& triangle : welded.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t vertex : triangle) soup.vertices.push_back(welded.vertices[vertex]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_EQ(build(soup)->report().solid, MeshSolid::closed);
}

TEST(Mesh, FinIsNonManifold) {
  TriangleSoup soup = test::icosphere(0.15F, 2);
  soup.vertices.emplace_back(0.0F, 0.3F, 0.0F);
  soup.triangles.push_back({soup.triangles[0][0], soup.triangles[0][1],
                            static_cast<std::uint32_t>(soup.vertices.size() - 1)});
  const auto mesh = build(soup);
  EXPECT_EQ(mesh->report().nonmanifold_edges, 1U);
  EXPECT_EQ(mesh->report().solid, MeshSolid::defective);
  EXPECT_LT(signed_distance(*mesh, {0.0, -0.1, 0.0}), 0.0);
  EXPECT_GT(signed_distance(*mesh, {0.0, -0.2, 0.0}), 0.0);
}

TEST(Mesh, BoxWithSmallHolesKeepsItsInside) {
  TriangleSoup soup = test::subdivided(test::box_mesh({0.1F, 0.1F, 0.1F}), 4);
  for (std::size_t i = soup.triangles.size(); i > 300; i -= 300) {
    soup.triangles.erase(soup.triangles.begin() + static_cast<std::ptrdiff_t>(i) - 1);
  }
  const auto mesh = build(soup);
  EXPECT_EQ(mesh->report().solid, MeshSolid::defective);
  Random random;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 query = random.point(Vec3::Constant(-0.15), Vec3::Constant(0.15));
    const double outside = query.cwiseAbs().maxCoeff() - 0.1;
    if (std::abs(outside) < 0.01) continue;
    EXPECT_EQ(signed_distance(*mesh, query) > 0.0, outside > 0.0);
  }
}

TEST(Mesh, SheetIsSolidBehindAndFreeBesides) {
  const auto mesh = build(test::grid_mesh(0.2F, 10));
  EXPECT_EQ(mesh->report().solid, MeshSolid::sheet);
  EXPECT_NEAR(signed_distance(*mesh, {0.05, -0.03, 0.05}), -0.03, 1e-7);
  EXPECT_NEAR(signed_distance(*mesh, {0.05, 0.03, 0.05}), 0.03, 1e-7);
  EXPECT_GT(signed_distance(*mesh, {0.25, -0.03, 0.0}), 0.0);
  EXPECT_TRUE(mesh->first_hit({{0.05, -0.03, 0.05}, Vec3::UnitY()})->from_inside);
  EXPECT_FALSE(mesh->first_hit({{0.05, 0.03, 0.05}, -Vec3::UnitY()})->from_inside);
}

TEST(Mesh, TwoSidedSheetIsOneSheet) {
  const TriangleSoup grid = test::grid_mesh(0.2F, 4);
  const auto mesh = build(test::joined(grid, test::turned_inside_out(grid)));
  EXPECT_EQ(mesh->report().triangles_duplicate, 32U);
  EXPECT_EQ(mesh->report().solid, MeshSolid::sheet);
}

TEST(Mesh, ThinWallHasTwoSides) {
  const auto mesh = build(test::subdivided(test::box_mesh({0.1F, 0.0005F, 0.1F}), 4));
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const double x = random.uniform(-0.09, 0.09);
    const double z = random.uniform(-0.09, 0.09);
    EXPECT_NEAR(signed_distance(*mesh, {x, 0.0006, z}), 1e-4, 1e-7);
    EXPECT_NEAR(signed_distance(*mesh, {x, 0.0004, z}), -1e-4, 1e-7);
    EXPECT_NEAR(signed_distance(*mesh, {x, -0.0006, z}), 1e-4, 1e-7);
    const auto hit = mesh->first_hit({{x, 0.0, z}, Vec3::UnitY()});
    EXPECT_TRUE(hit->from_inside);
    EXPECT_NEAR(hit->distance, 0.0005, 1e-7);
  }
}

TEST(Mesh, RefitEqualsRebuild) {
  for (const bool defective : {false, true}) {
    TriangleSoup soup = test::bumpy_sphere(0.12F, 40, 40);
    if (defective) soup.triangles.erase(soup.triangles.begin() + 100);
    const auto refitted = build(soup);
    for (Eigen::Vector3f& vertex : soup.vertices) {
      vertex = Eigen::Vector3f(1.1F * vertex.x() + 0.1F, vertex.y(),
                               vertex.z() + 0.01F * std::sin(20.0F * vertex.x()));
    }
    EXPECT_EQ(test::allocations_of([&] { refitted->refit(soup.vertices); }), 0U);
    const auto rebuilt = build(soup);
    const auto [low, high, tolerance, bounded] = region_of(soup);
    Random random;
    for (int i = 0; i < 5000; ++i) {
      const Ray ray{random.point(low, high), random.direction()};
      const auto a = refitted->first_hit(ray);
      const auto b = rebuilt->first_hit(ray);
      ASSERT_EQ(a.has_value(), b.has_value());
      if (a) {
        EXPECT_NEAR(a->distance, b->distance, 1e-6);
        EXPECT_EQ(a->from_inside, b->from_inside);
      }
      EXPECT_NEAR(signed_distance(*refitted, ray.origin), signed_distance(*rebuilt, ray.origin),
                  1e-6);
    }
  }
}

TEST(Mesh, RefitLeavesWhatIsNotFinite) {
  TriangleSoup soup = test::icosphere(0.15F, 2);
  const auto mesh = build(soup);
  for (std::size_t i = 0; i < soup.vertices.size(); i += 5) soup.vertices[i].y() = std::nanf("");
  mesh->refit(soup.vertices);
  EXPECT_LT(signed_distance(*mesh, {0.0, 0.1, 0.0}), 0.0);
  EXPECT_GT(signed_distance(*mesh, {0.0, 0.2, 0.0}), 0.0);
}

TEST(Mesh, RefitLeavesWhatIsThrownFarOff) {
  const TriangleSoup soup = test::icosphere(0.15F, 3);
  const auto mesh = build(soup);
  for (const float far_m : {100.0F, 1e5F, 1e30F}) {
    TriangleSoup thrown = soup;
    for (std::size_t i = 0; i < thrown.vertices.size(); i += 9) thrown.vertices[i].x() = far_m;
    mesh->refit(thrown.vertices);
    EXPECT_NEAR(signed_distance(*mesh, {0.0, 0.1, 0.0}), -0.05, 0.002);
    EXPECT_NEAR(signed_distance(*mesh, {0.0, 0.2, 0.0}), 0.05, 0.002);
  }
  // What walks away as a whole is followed.
  TriangleSoup away = soup;
  for (Eigen::Vector3f& vertex : away.vertices) vertex.x() += 20.0F;
  mesh->refit(away.vertices);
  EXPECT_NEAR(signed_distance(*mesh, {20.0, 0.2, 0.0}), 0.05, 0.002);
}

TEST(Mesh, QueriesDoNotAllocate) {
  for (const TriangleSoup& soup : {test::bumpy_sphere(0.12F, 60, 60), broken_mesh()}) {
    const auto mesh = build(soup);
    Random random;
    SurfaceHint hint;
    const std::size_t allocations = test::allocations_of([&] {
      for (int i = 0; i < 1000; ++i) {
        const Vec3 query = random.point(Vec3::Constant(-0.2), Vec3::Constant(0.2));
        static_cast<void>(mesh->first_hit({query, random.direction()}));
        static_cast<void>(mesh->closest_point(query, 1.0, hint));
      }
    });
    EXPECT_EQ(allocations, 0U);
  }
}

TEST(Mesh, RefusesWhatHasNoSurface) {
  const auto message = [](const TriangleSoup& soup) {
    const auto mesh = MeshSurface::build(soup, "thing.obj");
    return mesh.ok() ? std::string("accepted") : mesh.error().message;
  };
  EXPECT_EQ(message({}), "thing.obj: expected at least one triangle with an area, found none");
  EXPECT_EQ(message({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}}),
            "thing.obj: expected at least one triangle with an area, found 1 without");
  TriangleSoup soup = test::icosphere(0.15F, 1);
  soup.vertices[5].y() = std::nanf("");
  EXPECT_EQ(message(soup), "thing.obj: vertex 5: expected finite coordinates");
  soup.vertices[5].y() = std::numeric_limits<float>::infinity();
  EXPECT_EQ(message(soup), "thing.obj: vertex 5: expected finite coordinates");
  soup = test::icosphere(0.15F, 1);
  soup.triangles[3][1] = 42;
  EXPECT_EQ(message(soup), "thing.obj: triangle 3: expected vertices below 42, found 42");
}

TEST(Mesh, TinyAndOddMeshes) {
  const auto one = build({{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}, {{0, 1, 2}}});
  EXPECT_EQ(one->report().solid, MeshSolid::sheet);
  EXPECT_LT(signed_distance(*one, {0.2, -0.1, 0.2}), 0.0);
  // Ten thousand triangles in one place, and slivers side by side.
  TriangleSoup pile;
  for (std::uint32_t i = 0; i < 10000; ++i) {
    const float lift = 1e-9F * static_cast<float>(i);
    pile.vertices.insert(pile.vertices.end(), {{0, lift, 0}, {0, lift, 1}, {1, lift, 0}});
    pile.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  EXPECT_NEAR(std::abs(signed_distance(*build(pile), {0.2, 0.1, 0.2})), 0.1, 1e-5);
  // A Moebius strip has no two sides; it must have an answer all the same.
  TriangleSoup strip;
  constexpr std::uint32_t kParts = 40;
  for (std::uint32_t i = 0; i < kParts; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / kParts;
    for (const double side : {-0.03, 0.03}) {
      const Vec3 out(std::cos(turn), 0.0, std::sin(turn));
      strip.vertices.emplace_back(
          ((0.1 + side * std::cos(turn / 2)) * out + side * std::sin(turn / 2) * Vec3::UnitY())
              .cast<float>());
    }
    const std::uint32_t a = 2 * i;
    const bool last = i + 1 == kParts;
    const std::uint32_t c = last ? 1 : a + 2;
    const std::uint32_t d = last ? 0 : a + 3;
    strip.triangles.push_back({a, a + 1, c});
    strip.triangles.push_back({a + 1, d, c});
  }
  const auto mesh = build(strip);
  EXPECT_GT(mesh->report().nonmanifold_edges, 0U);
  EXPECT_TRUE(std::isfinite(signed_distance(*mesh, {0.1, 0.01, 0.0})));
}

TEST(Mesh, AMillionTriangles) {
  const TriangleSoup soup = test::uv_sphere(0.15F, 708, 708);
  ASSERT_GT(soup.triangles.size(), 1000000U);
  const auto mesh = build(soup);
  EXPECT_EQ(mesh->report().solid, MeshSolid::closed);
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const double from_centre = random.uniform(0.05, 0.25);
    EXPECT_NEAR(signed_distance(*mesh, from_centre * random.direction()), from_centre - 0.15, 1e-5);
  }
}

TEST(Mesh, SameAnswersEveryTime) {
  const TriangleSoup soup = broken_mesh();
  const auto a = build(soup);
  const auto b = build(soup);
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 query = random.point(Vec3::Constant(-0.2), Vec3::Constant(0.2));
    EXPECT_EQ(signed_distance(*a, query), signed_distance(*b, query));
  }
}

}  // namespace
}  // namespace nade
