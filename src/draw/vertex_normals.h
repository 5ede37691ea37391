#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace nade::draw {

/// 0 to pi; 0 where one of them has no length.
[[nodiscard]] inline float angle_between(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// An order of places, to find the vertices that a seam keeps apart at the same one.
struct ByPlace {
  bool operator()(const Eigen::Vector3f& a, const Eigen::Vector3f& b) const {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  }
};

}  // namespace nade::draw
