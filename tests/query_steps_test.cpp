#include "surface/query_steps.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "nade/corrector.h"
#include "nade/mesh.h"
#include "support/hand_checks.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/sample_hand.h"
#include "surface/mesh_topology.h"
#include "surface/triangle_tree.h"

namespace nade {
namespace {

using detail::kMostFrameSteps;
using detail::kMostSteps;
using detail::kMostWindingSteps;
using detail::StepLimit;
using test::Random;

constexpr std::int64_t kEndless = std::numeric_limits<std::int64_t>::max();
/// What the query may take that uses the frame's up.
constexpr std::int64_t kLastQuery = 2 * kMostSteps + kMostWindingSteps;

std::unique_ptr<MeshSurface> mesh_of(const TriangleSoup& soup) {
  return MeshSurface::build(soup, "mesh").value();
}

/// Triangles through each other all over a cube.
TriangleSoup tangle(std::uint32_t triangles) {
  TriangleSoup soup;
  Random random;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3 point = random.point(Vec3::Constant(-0.1), Vec3::Constant(0.1));
      soup.vertices.push_back(point.cast<float>());
    }
    soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return soup;
}

/// The most that a query near the mesh looks at.
struct MostSteps {
  std::uint32_t ray = 0;
  std::uint32_t closest = 0;
  std::uint32_t winding = 0;
};
MostSteps most_steps(const TriangleSoup& soup) {
  MeshReport report;
  detail::WeldedMesh mesh = detail::weld(soup, report);
  detail::TriangleTree tree;
  detail::reorder(mesh, tree.build(mesh.vertices, mesh.triangles));
  tree.set_triangles(mesh.vertices, mesh.triangles);
  tree.set_dipoles();
  MostSteps most;
  Random random;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3f& on =
        mesh.vertices[random.below(static_cast<std::uint32_t>(mesh.vertices.size()))];
    const Eigen::Vector3f at = on + 0.02F * random.direction().cast<float>();
    const Eigen::Vector3f way = random.direction().cast<float>();
    most.ray = std::max(
        most.ray,
        tree.first_hit({{at.x(), at.y(), at.z()}, {way.x(), way.y(), way.z()}, 1.0F}).steps);
    most.closest = std::max(most.closest,
                            tree.closest({{at.x(), at.y(), at.z()}, 1.0F, detail::kNoSlot}).steps);
    most.winding = std::max(most.winding, tree.winding({at.x(), at.y(), at.z()}).steps);
  }
  return most;
}

TEST(QuerySteps, ASurfaceTakesFew) {
  for (const std::uint32_t rings : {20U, 100U, 300U}) {
    const MostSteps most = most_steps(test::bumpy_sphere(0.12F, rings, rings));
    EXPECT_LT(most.ray, kMostSteps / 4) << rings;
    EXPECT_LT(most.closest, kMostSteps / 2) << rings;
    EXPECT_LT(most.winding, kMostWindingSteps / 2) << rings;
  }
}

TEST(QuerySteps, ATangleTakesNoMoreThanAllowed) {
  const MostSteps most = most_steps(tangle(60'000));
  EXPECT_EQ(most.ray, kMostSteps);
  EXPECT_EQ(most.closest, kMostSteps);
  EXPECT_GT(most.winding, kMostWindingSteps / 2);
  EXPECT_LE(most.winding, kMostWindingSteps);
}

TEST(QuerySteps, CutShortTheAnswerIsStillOnTheSurfaceAndItsSideRight) {
  // From the middle of a ball every triangle is as far.
  const auto ball = mesh_of(test::icosphere(0.15F, 6));
  for (const double off_m : {0.0, 1e-5, 1e-3}) {
    StepLimit limit(kEndless);
    SurfaceHint hint;
    const auto nearest = ball->closest_point({off_m, 0.0, 0.0}, 1.0, hint);
    ASSERT_TRUE(nearest);
    EXPECT_GE(limit.used(), kMostSteps) << "the case does not cut a query short any more";
    EXPECT_NEAR(nearest->point.norm(), 0.15, 1e-4);
    EXPECT_NEAR(nearest->signed_distance, -0.15, 0.0015);
    EXPECT_GT(nearest->normal.dot(nearest->point), 0.149);
  }
}

/// The most steps of a frame of a hand that comes and goes over a cube's middle; every 20 frames
/// it is found anew.
std::int64_t most_in_a_frame(MeshSurface& mesh, Method method, TriangleSoup* thrown = nullptr) {
  CorrectorOptions options;
  options.method = method;
  HandCorrector corrector(options);
  const HandPose hand = test::sample_hand(Handedness::right);
  std::int64_t most = 0;
  Random random;
  for (int i = 0; i < 60; ++i) {
    if (thrown != nullptr) {
      TriangleSoup now = *thrown;
      for (int k = 0; k < 20; ++k) {
        const auto count = static_cast<std::uint32_t>(now.vertices.size());
        now.vertices[random.below(count)] +=
            random.point(Vec3::Constant(-10.0), Vec3::Constant(10.0)).cast<float>();
      }
      mesh.refit(now.vertices);
    }
    if (i % 20 == 0) corrector.reset();
    const Vec3 palm(0.002 * i, 0.10 + 0.05 * std::cos(0.3 * i), 0.02);
    const HandPose tracked = test::placed_hand(hand, palm);
    const StepLimit limit(kEndless);
    const CorrectedHand& drawn =
        corrector.update(tracked, Object(mesh), std::int64_t{11'000'000} * i);
    most = std::max(most, limit.used());
    EXPECT_TRUE(test::all_finite(drawn.pose));
    if (limit.used() >= kMostFrameSteps) {
      EXPECT_EQ(drawn.status, HandStatus::free);
      EXPECT_TRUE(test::same_bits(drawn.pose, tracked));
    }
  }
  return most;
}

TEST(QuerySteps, AFrameOnASurfaceTakesAFraction) {
  const auto ball = mesh_of(test::icosphere(0.1F, 4));
  for (const Method method : {Method::paper, Method::nade}) {
    EXPECT_LT(most_in_a_frame(*ball, method), kMostFrameSteps / 4);
  }
}

TEST(QuerySteps, AFrameOnATangleOrAmongThrownVerticesIsBounded) {
  const auto knot = mesh_of(tangle(5'000));
  TriangleSoup ball = test::icosphere(0.1F, 4);
  const auto torn = mesh_of(ball);
  for (const Method method : {Method::paper, Method::nade}) {
    EXPECT_LE(most_in_a_frame(*knot, method), kMostFrameSteps + kLastQuery);
    EXPECT_LE(most_in_a_frame(*torn, method, &ball), kMostFrameSteps + kLastQuery);
  }
  EXPECT_GE(most_in_a_frame(*knot, Method::nade), kMostFrameSteps)
      << "the tangle does not use a frame up any more";
}

}  // namespace
}  // namespace nade
