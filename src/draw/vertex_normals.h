#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace nade::draw {

/// 0 to pi, to 1e-5 (Abramowitz and Stegun 4.4.49); 0 where one of them has no length.
[[nodiscard]] inline float angle_between(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  constexpr float kHalfTurn = std::numbers::pi_v<float>;
  const float across = a.cross(b).norm();
  const float along = a.dot(b);
  const float longer = std::max(across, std::abs(along));
  if (longer == 0.0F) return 0.0F;
  const float t = std::min(across, std::abs(along)) / longer;
  const float s = t * t;
  float angle =
      t * (0.999866F + s * (-0.3302995F + s * (0.180141F + s * (-0.085133F + s * 0.0208351F))));
  if (across > std::abs(along)) angle = 0.5F * kHalfTurn - angle;
  return along < 0.0F ? kHalfTurn - angle : angle;
}

/// An order of places, to find the vertices that a seam keeps apart at the same one.
struct ByPlace {
  bool operator()(const Eigen::Vector3f& a, const Eigen::Vector3f& b) const {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  }
};

}  // namespace nade::draw
