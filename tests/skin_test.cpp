#include "nade/skin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "generic_hand.h"

namespace nade {
namespace {

std::size_t index_of(SkinRegion region) { return static_cast<std::size_t>(region); }

std::array<double, kSkinRegionCount> areas_cm2(const SkinMap& skin) {
  std::array<double, kSkinRegionCount> areas{};
  for (std::size_t i = 0; i < skin.region.size(); ++i) {
    areas[index_of(skin.region[i])] += 1e4 * skin.area_m2[i];
  }
  return areas;
}

TEST(Skin, AreasAddUpToTheMesh) {
  NADE_TEST_GENERIC_HAND(mesh, Handedness::right);
  const SkinMap skin = measure_skin(mesh);
  double triangles_m2 = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3f& corner = mesh.vertices[a];
    triangles_m2 += 0.5 * static_cast<double>(
                              (mesh.vertices[b] - corner).cross(mesh.vertices[c] - corner).norm());
  }
  double vertices_m2 = 0.0;
  for (const double area : skin.area_m2) vertices_m2 += area;
  EXPECT_NEAR(vertices_m2, triangles_m2, 1e-6);
}

TEST(Skin, EachRegionIsThereAndBothHandsAreAlike) {
  NADE_TEST_GENERIC_HAND(right, Handedness::right);
  NADE_TEST_GENERIC_HAND(left, Handedness::left);
  const auto right_cm2 = areas_cm2(measure_skin(right));
  const auto left_cm2 = areas_cm2(measure_skin(left));
  for (std::size_t i = 0; i < kSkinRegionCount; ++i) {
    EXPECT_GT(right_cm2[i], 2.0) << name_of(static_cast<SkinRegion>(i));
    EXPECT_NEAR(left_cm2[i], right_cm2[i], 0.2 * right_cm2[i])
        << name_of(static_cast<SkinRegion>(i));
  }
}

TEST(Skin, RegionsLieWhereTheirNamesSay) {
  NADE_TEST_GENERIC_HAND(mesh, Handedness::right);
  const SkinMap skin = measure_skin(mesh);
  const SkinDepths depths = measure_skin_depths(mesh);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    for (const Part tip : {Part::thumb, Part::index, Part::middle, Part::ring, Part::little}) {
      if (!is_in_patch(mesh, depths, tip, i)) continue;
      EXPECT_EQ(skin.region[i], SkinRegion::tip) << name_of(tip);
    }
    const double past_wrist_m =
        mesh.bind[Joint::wrist].inverse().apply(mesh.vertices[i].cast<double>()).z();
    if (past_wrist_m > 0.02) {
      EXPECT_FALSE(skin.is_palmar(i)) << "the forearm's stump";
    }
  }
}

TEST(Skin, FleshIsDeepestOnThePalmarSide) {
  NADE_TEST_GENERIC_HAND(mesh, Handedness::right);
  const SkinMap skin = measure_skin(mesh);
  constexpr std::array kMost_m{0.003, 0.005, 0.012, 0.005, 0.012, 0.005};
  const Vec3 back = mesh.bind.back();
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (skin.is_palmar(i)) {
      EXPECT_NEAR(skin.flesh_depth_m[i], kMost_m[index_of(skin.region[i])], 1e-9);
    }
    EXPECT_GE(skin.flesh_depth_m[i], 0.0005 - 1e-12);
    const bool of_palm =
        mesh.bones[i][0] == nade::index_of(Joint::middle_metacarpal) && mesh.weights[i][0] > 0.9F;
    if (of_palm && mesh.normals[i].cast<double>().dot(back) > 0.5) {
      EXPECT_NEAR(skin.flesh_depth_m[i], 0.0005, 1e-9) << "the back of the hand";
    }
  }
}

}  // namespace
}  // namespace nade
