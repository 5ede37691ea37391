#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "octahedral.h"
#include "triangle_tree_build.h"
#include "triangle_tree_layout.h"

namespace nade::detail {

/// A triangle as the tree keeps it.
struct SlotTriangle {
  std::array<Eigen::Vector3d, 3> corners;
  std::array<Eigen::Vector3d, 3> normals;  ///< shading; as long as `from_octahedral` makes them
};

/// A bounding volume tree over triangles, eight children a node. It finds which triangle; the
/// exact answer on that triangle is the caller's.
class TriangleTree {
 public:
  /// Builds the tree and gives the order in which triangles should be kept, so that neighbours
  /// in space are neighbours in memory: place i is for triangle order[i]. `set_triangles` must
  /// follow. At least one triangle.
  [[nodiscard]] std::vector<std::uint32_t> build(std::span<const Eigen::Vector3f> vertices,
                                                 std::span<const Corners> triangles);

  /// Positions of the triangles, in the order `build` gave; bounds follow. Does not allocate.
  void set_triangles(std::span<const Eigen::Vector3f> vertices,
                     std::span<const Corners> triangles) noexcept;

  /// The triangles as `set_triangles` put them, eight at a time; block i holds those from
  /// `block_begin()[i]` up to the next one.
  [[nodiscard]] std::span<const TriangleBlock> blocks() const noexcept { return blocks_; }
  [[nodiscard]] std::span<const std::uint32_t> block_begin() const noexcept { return block_begin_; }

  /// Shading normals, and which of them each corner has. Does not allocate.
  void set_shading(std::span<const Octahedral> normals,
                   std::span<const Corners> normal_of) noexcept;

  /// Makes `winding` ready: call once, then again after each `set_triangles`. Allocates the
  /// first time.
  void set_dipoles();

  /// The first triangle along the ray.
  [[nodiscard]] TreeHit first_hit(const TreeRay& ray) const noexcept {
    return kernels_->first_hit(nodes_.data(), blocks_.data(), ray);
  }
  /// The triangle nearest the point.
  [[nodiscard]] TreeNearest closest(const TreePoint& point) const noexcept {
    return kernels_->closest(nodes_.data(), blocks_.data(), point);
  }
  /// Whether this could be a slot.
  [[nodiscard]] bool has(std::uint32_t slot) const noexcept {
    return slot / kTreeWidth < blocks_.size();
  }
  [[nodiscard]] SlotTriangle at(std::uint32_t slot) const noexcept {
    const TriangleBlock& block = blocks_[slot / kTreeWidth];
    const std::uint32_t lane = slot % kTreeWidth;
    const auto corner = [lane](const float(&p)[3][kTreeWidth]) {
      return Eigen::Vector3d(p[0][lane], p[1][lane], p[2][lane]);
    };
    const auto normal = [&](int k) {
      return from_octahedral({block.normal[k][0][lane], block.normal[k][1][lane]});
    };
    return {{corner(block.a), corner(block.b), corner(block.c)}, {normal(0), normal(1), normal(2)}};
  }
  /// Which triangle that is, in the order that `build` gave.
  [[nodiscard]] std::uint32_t triangle_at(std::uint32_t slot) const noexcept {
    const std::uint32_t block = slot / kTreeWidth;
    return std::min(block_begin_[block] + slot % kTreeWidth, block_begin_[block + 1] - 1);
  }

  /// Generalised winding number of the point (Jacobson et al. 2013), to about 0.02.
  [[nodiscard]] TreeWinding winding(const float (&point)[3]) const noexcept {
    return kernels_->winding(nodes_.data(), blocks_.data(), dipoles_.data(), point);
  }
  [[nodiscard]] const Eigen::AlignedBox3f& bounds() const { return bounds_; }

  /// For tests and benches.
  void use(const TreeKernels& kernels) { kernels_ = &kernels; }

 private:
  const TreeKernels* kernels_ = &tree_kernels();
  std::vector<TreeNode> nodes_;
  std::vector<TriangleBlock> blocks_;
  std::vector<std::uint32_t> block_begin_;  ///< block i holds triangles from [i] up to [i + 1]
  std::vector<DipoleNode> dipoles_;
  Eigen::AlignedBox3f bounds_;
};

}  // namespace nade::detail
