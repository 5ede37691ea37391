#include "triangle_tree.h"

#include <algorithm>
#include <utility>

#include "simd8.h"

namespace nade::detail {
namespace {

using Eigen::Vector3f;

float highest8(Float8 a) { return -lowest8(all8(0.0F) - a); }

/// An unused child's box is inside out, and changes nothing.
TreeBox box_of(const TreeNode& node) {
  TreeBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = lowest8(load8(node.side[axis]));
    box.high[axis] = highest8(load8(node.side[axis + 3]));
  }
  return box;
}

TreeBox box_of(const TriangleBlock& block) {
  TreeBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const Float8 a = load8(block.a[axis]);
    const Float8 b = load8(block.b[axis]);
    const Float8 c = load8(block.c[axis]);
    box.low[axis] = lowest8(min8(a, min8(b, c)));
    box.high[axis] = highest8(max8(a, max8(b, c)));
  }
  return box;
}

void fill_block(TriangleBlock& block, std::uint32_t begin, std::uint32_t end,
                std::span<const Vector3f> vertices, std::span<const Corners> triangles) {
  for (std::uint32_t i = 0; i < kTreeWidth; ++i) {
    const bool used = begin + i < end;
    const std::uint32_t triangle = used ? begin + i : end - 1;
    const Corners& corners = triangles[triangle];
    for (int axis = 0; axis < 3; ++axis) {
      block.a[axis][i] = vertices[corners[0]][axis];
      block.b[axis][i] = vertices[corners[used ? 1 : 0]][axis];
      block.c[axis][i] = vertices[corners[used ? 2 : 0]][axis];
    }
  }
}

/// What a part of the mesh looks like from afar.
struct Dipole {
  Eigen::Vector3d vector_area = Eigen::Vector3d::Zero();
  Eigen::Vector3d weighted_centre = Eigen::Vector3d::Zero();
  double area = 0.0;
};

Dipole dipole_of(const TriangleBlock& block) {
  Dipole sum;
  for (std::uint32_t i = 0; i < kTreeWidth; ++i) {
    const auto corner = [i](const float(&p)[3][kTreeWidth]) {
      return Eigen::Vector3d(p[0][i], p[1][i], p[2][i]);
    };
    const Eigen::Vector3d a = corner(block.a);
    const Eigen::Vector3d b = corner(block.b);
    const Eigen::Vector3d c = corner(block.c);
    const Eigen::Vector3d vector_area = 0.5 * (b - a).cross(c - a);
    const double area = vector_area.norm();
    sum.vector_area += vector_area;
    sum.weighted_centre += area / 3.0 * (a + b + c);
    sum.area += area;
  }
  return sum;
}

Dipole dipole_of(const DipoleNode& node) {
  Dipole sum;
  for (std::uint32_t i = 0; i < kTreeWidth; ++i) {
    const auto at = [i](const float(&p)[3][kTreeWidth]) {
      return Eigen::Vector3d(p[0][i], p[1][i], p[2][i]);
    };
    sum.vector_area += at(node.vector_area);
    sum.weighted_centre += static_cast<double>(node.area[i]) * at(node.centre);
    sum.area += static_cast<double>(node.area[i]);
  }
  return sum;
}

}  // namespace

std::vector<std::uint32_t> TriangleTree::build(std::span<const Vector3f> vertices,
                                               std::span<const Corners> triangles) {
  BuiltTree tree = build_tree(vertices, triangles);
  nodes_ = std::move(tree.nodes);
  block_begin_ = std::move(tree.block_begin);
  dipoles_.clear();
  blocks_.resize(block_begin_.size() - 1);
  return std::move(tree.order);
}

void TriangleTree::set_triangles(std::span<const Vector3f> vertices,
                                 std::span<const Corners> triangles) noexcept {
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    fill_block(blocks_[i], block_begin_[i], block_begin_[i + 1], vertices, triangles);
  }
  for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node) {
    for (std::uint32_t i = 0; i < kTreeWidth; ++i) {
      const std::uint32_t child = node->child[i];
      TreeBox box;
      if (child != kNoChild) {
        box = (child & kLeafBit) != 0 ? box_of(blocks_[child & ~kLeafBit]) : box_of(nodes_[child]);
      }
      for (int axis = 0; axis < 3; ++axis) {
        node->side[axis][i] = box.low[axis];
        node->side[axis + 3][i] = box.high[axis];
      }
    }
  }
  const TreeBox whole = box_of(nodes_.front());
  bounds_ = Eigen::AlignedBox3f(whole.low, whole.high);
  // Boxes are wider than what they hold by more than a ray's arithmetic is wrong about them, as
  // long as it starts within two sizes of the mesh.
  constexpr float kMargin = 1e-6F;
  const Float8 margin =
      all8(kMargin * (bounds_.center().norm() + 2.0F * bounds_.diagonal().norm()));
  for (TreeNode& node : nodes_) {
    for (int axis = 0; axis < 3; ++axis) {
      store8(node.side[axis], load8(node.side[axis]) - margin);
      store8(node.side[axis + 3], load8(node.side[axis + 3]) + margin);
    }
  }
}

void TriangleTree::set_shading(std::span<const Octahedral> normals,
                               std::span<const Corners> normal_of) noexcept {
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    TriangleBlock& block = blocks_[i];
    for (std::uint32_t lane = 0; lane < kTreeWidth; ++lane) {
      const std::uint32_t triangle = std::min(block_begin_[i] + lane, block_begin_[i + 1] - 1);
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const Octahedral normal = normals[normal_of[triangle][corner]];
        block.normal[corner][0][lane] = normal.u;
        block.normal[corner][1][lane] = normal.v;
      }
    }
  }
}

void TriangleTree::set_dipoles() {
  constexpr float kNowhere = 1e9F;
  dipoles_.resize(nodes_.size());
  for (std::size_t n = nodes_.size(); n-- > 0;) {
    const TreeNode& node = nodes_[n];
    DipoleNode& out = dipoles_[n];
    for (std::uint32_t i = 0; i < kTreeWidth; ++i) {
      const std::uint32_t child = node.child[i];
      Dipole dipole;
      if (child != kNoChild) {
        dipole = (child & kLeafBit) != 0 ? dipole_of(blocks_[child & ~kLeafBit])
                                         : dipole_of(dipoles_[child]);
      }
      out.area[i] = static_cast<float>(dipole.area);
      if (dipole.area <= 0.0) {
        // Nothing there: far from any query, and no part of the sum.
        out.near_squared[i] = -1.0F;
        for (int axis = 0; axis < 3; ++axis) {
          out.centre[axis][i] = kNowhere;
          out.vector_area[axis][i] = 0.0F;
        }
        continue;
      }
      const Eigen::Vector3d centre = dipole.weighted_centre / dipole.area;
      double radius_squared = 0.0;
      for (int axis = 0; axis < 3; ++axis) {
        const double reach = std::max(centre[axis] - static_cast<double>(node.side[axis][i]),
                                      static_cast<double>(node.side[axis + 3][i]) - centre[axis]);
        radius_squared += reach * reach;
        out.centre[axis][i] = static_cast<float>(centre[axis]);
        out.vector_area[axis][i] = static_cast<float>(dipole.vector_area[axis]);
      }
      out.near_squared[i] = kDipoleFar * kDipoleFar * static_cast<float>(radius_squared);
    }
  }
}

const TreeKernels& tree_kernels() noexcept {
#if defined(NADE_TREE_AVX2)
  static const bool kFast = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (kFast) return tree_kernels_avx2();
#endif
  return tree_kernels_baseline();
}

}  // namespace nade::detail
