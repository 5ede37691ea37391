#include "nade/dent.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "generic_hand.h"
#include "nade/corrector.h"
#include "nade/mesh.h"
#include "support/allocation_counter.h"
#include "support/meshes.h"

namespace nade {
namespace {

using Vec3f = Eigen::Vector3f;

/// A soft ball of triangles of about 5 mm, its top at y = 0, and a hand that presses it from above.
class Dent : public testing::Test {
 protected:
  void SetUp() override {
    mesh_ = test::generic_hand(Handedness::right);
    if (!mesh_) GTEST_SKIP() << "no generic hand";
    soup_ = test::shifted(test::icosphere(0.15F, 5), {0.0F, -0.15F, 0.0F});
    auto built = MeshSurface::build(soup_, "ball");
    ASSERT_TRUE(built.ok());
    ball_ = std::move(built).value();
  }

  /// The drawn hand's skin after it has come down so deep.
  [[nodiscard]] std::vector<Vec3f> pressed_skin(double depth_m, double softness_m) const {
    CorrectorOptions options;
    options.method = Method::nade;
    options.settle.softness_m = softness_m;
    HandCorrector corrector(options);
    HandPose drawn;
    for (int i = 0; i <= 100; ++i) {
      HandPose hand = mesh_->bind;
      const Vec3 palm = hand[Joint::palm].position;
      const double low_m = 0.05 - std::min(1.0, i / 80.0) * (0.05 + depth_m);
      const double skin_m = generic_skin_depths()[Part::palm];
      for (Pose& joint : hand.joints) joint.position += Vec3(0.0, low_m + skin_m, 0.0) - palm;
      drawn = corrector.update(hand, Object(*ball_), i * test::kFrame_ns).pose;
    }
    std::vector<Vec3f> skin(mesh_->vertices.size());
    pose_skin(*mesh_, drawn, 1.0, skin, {});
    return skin;
  }

  [[nodiscard]] std::vector<DentSpot> spots_of(const std::vector<Vec3f>& skin) const {
    std::vector<DentSpot> spots(skin.size());
    spots.resize(find_dent_spots(Object(*ball_), skin, spots));
    return spots;
  }

  std::optional<HandMesh> mesh_;
  TriangleSoup soup_;
  std::unique_ptr<MeshSurface> ball_;
};

TEST_F(Dent, NoSkinIsInTheObjectAfterwards) {
  for (const double softness_m : {0.004, 0.01}) {
    const std::vector<Vec3f> skin = pressed_skin(0.03, softness_m);
    const std::vector<DentSpot> spots = spots_of(skin);
    ASSERT_FALSE(spots.empty());
    const auto deepest = std::max_element(
        spots.begin(), spots.end(),
        [](const DentSpot& a, const DentSpot& b) { return a.depth_m < b.depth_m; });
    EXPECT_GT(deepest->depth_m, 0.4 * softness_m);
    DentOptions options;
    options.plateau_m = 0.007;
    std::vector<Vec3f> dented(soup_.vertices.size());
    dent(spots, options, soup_.vertices, dented);
    ball_->refit(dented);
    double lowest_m = 0.0;
    for (const Vec3f& vertex : skin) {
      SurfaceHint hint;
      const auto near = ball_->closest_point(vertex.cast<double>(), 0.05, hint);
      if (near) lowest_m = std::min(lowest_m, near->signed_distance);
    }
    EXPECT_GT(lowest_m, -0.0003) << "softness " << softness_m;
    ball_->refit(soup_.vertices);
  }
}

TEST_F(Dent, WhatIsFarStaysBitForBit) {
  const std::vector<DentSpot> spots = spots_of(pressed_skin(0.03, 0.008));
  const DentOptions options;
  std::vector<Vec3f> dented(soup_.vertices.size());
  dent(spots, options, soup_.vertices, dented);
  std::size_t moved = 0;
  for (std::size_t i = 0; i < dented.size(); ++i) {
    const Vec3 vertex = soup_.vertices[i].cast<double>();
    const bool far = std::all_of(spots.begin(), spots.end(), [&](const DentSpot& spot) {
      return (vertex - spot.point).norm() > options.falloff_m;
    });
    if (far) {
      EXPECT_EQ(dented[i], soup_.vertices[i]);
    }
    moved += dented[i] != soup_.vertices[i] ? 1 : 0;
  }
  EXPECT_GT(moved, 100U);
  EXPECT_LT(moved, dented.size() / 2);
}

TEST_F(Dent, AHardObjectStaysAsItIs) {
  const std::vector<DentSpot> spots = spots_of(pressed_skin(0.03, 0.0));
  std::vector<Vec3f> dented(soup_.vertices.size());
  dent(spots, {}, soup_.vertices, dented);
  for (std::size_t i = 0; i < dented.size(); ++i) {
    EXPECT_LT((dented[i] - soup_.vertices[i]).norm(), 0.013F);  // as deep as flesh gives way
  }
  dent({}, {}, soup_.vertices, dented);
  EXPECT_TRUE(dented == soup_.vertices);
}

TEST_F(Dent, TheFarSideOfSomethingThinIsNotPressedIn) {
  const TriangleSoup board = test::subdivided(test::box_mesh({0.1F, 0.006F, 0.1F}), 5);
  const std::vector<DentSpot> spots{{{0.0, 0.006, 0.0}, Vec3::UnitY(), 0.004}};
  std::vector<Vec3f> dented(board.vertices.size());
  dent(spots, {}, board.vertices, dented);
  for (std::size_t i = 0; i < dented.size(); ++i) {
    if (board.vertices[i].y() < 0.0F) {
      EXPECT_EQ(dented[i], board.vertices[i]);
    }
  }
}

TEST_F(Dent, AllocatesNothing) {
  const std::vector<Vec3f> skin = pressed_skin(0.03, 0.008);
  std::vector<DentSpot> spots(skin.size());
  std::vector<Vec3f> dented(soup_.vertices.size());
  EXPECT_EQ(test::allocations_of([&] {
              const std::size_t count = find_dent_spots(Object(*ball_), skin, spots);
              dent(std::span(spots).first(count), {}, soup_.vertices, dented);
            }),
            0U);
}

}  // namespace
}  // namespace nade
