#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "triangle_tree_layout.h"

namespace nade::detail {

using Corners = std::array<std::uint32_t, 3>;

/// A triangle as the tree keeps it.
struct SlotTriangle {
  std::uint32_t triangle;  ///< in the order that `TriangleTree::build` gave
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

  /// Shading normals, and which of them each corner has; none zero. Does not allocate.
  void set_shading(std::span<const Eigen::Vector3f> normals,
                   std::span<const Corners> normal_of) noexcept;

  /// Makes `winding` ready: call once, then again after each `set_triangles`. Allocates the
  /// first time.
  void set_dipoles();

  /// The first triangle along the ray.
  [[nodiscard]] TreeHit first_hit(const TreeRay& ray) const noexcept {
    return kernels_->first_hit(nodes_.data(), blocks_.data(), ray);
  }
  /// The slot of the triangle nearest the point.
  [[nodiscard]] std::uint32_t closest(const TreePoint& point) const noexcept {
    return kernels_->closest(nodes_.data(), blocks_.data(), point);
  }
  /// Whether this could be a slot.
  [[nodiscard]] bool has(std::uint32_t slot) const noexcept {
    return slot / kTreeWidth < blocks_.size();
  }
  [[nodiscard]] SlotTriangle at(std::uint32_t slot) const noexcept;

  /// Generalised winding number of the point (Jacobson et al. 2013), to about 0.02.
  [[nodiscard]] float winding(const float (&point)[3]) const noexcept {
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
