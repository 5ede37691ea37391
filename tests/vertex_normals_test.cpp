#include "draw/vertex_normals.h"

#include <gtest/gtest.h>

namespace nade::draw {
namespace {

TEST(VertexNormals, AnglesAreThoseOfAtan2) {
  const Eigen::Vector3f from = 2.0F * Eigen::Vector3f::UnitX();
  for (int i = 0; i <= 1000; ++i) {
    const float angle = std::numbers::pi_v<float> * static_cast<float>(i) / 1000.0F;
    const Eigen::Vector3f to(std::cos(angle), 0.0F, std::sin(angle));
    EXPECT_NEAR(angle_between(from, to), angle, 2e-5F);
  }
  EXPECT_EQ(angle_between(from, Eigen::Vector3f::Zero()), 0.0F);
}

}  // namespace
}  // namespace nade::draw
