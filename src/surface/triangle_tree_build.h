#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "triangle_tree_layout.h"

namespace nade::detail {

using Corners = std::array<std::uint32_t, 3>;

struct TreeBox {
  Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::infinity());
  Eigen::Vector3f high = Eigen::Vector3f::Constant(-std::numeric_limits<float>::infinity());

  void extend(const Eigen::Vector3f& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  void extend(const TreeBox& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  [[nodiscard]] float half_area() const {
    const Eigen::Vector3f d = high - low;
    return d.x() * d.y() + d.y() * d.z() + d.z() * d.x();
  }
};

/// A tree before it has any triangles' positions in it.
struct BuiltTree {
  std::vector<TreeNode> nodes;             ///< only their children
  std::vector<std::uint32_t> block_begin;  ///< block i holds triangles from [i] up to [i + 1]
  std::vector<std::uint32_t> order;        ///< place i is for triangle order[i]
};

/// Parts the triangles by the surface area heuristic. At least one triangle.
[[nodiscard]] BuiltTree build_tree(std::span<const Eigen::Vector3f> vertices,
                                   std::span<const Corners> triangles);

}  // namespace nade::detail
