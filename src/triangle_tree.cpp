#include "triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

// Based on: Wald. On fast Construction of SAH-based Bounding Volume Hierarchies. 2007.

namespace nade::detail {
namespace {

using Eigen::Vector3f;

constexpr std::uint32_t kBins = 16;
/// Leaves are not split below this: a half-empty block costs as much as a full one.
constexpr std::uint32_t kLeafTarget = 8;
/// From this depth on ranges are halved, which bounds the depth whatever the triangles are like.
constexpr std::uint32_t kHalvingDepth = 32;

struct Box {
  Vector3f low = Vector3f::Constant(std::numeric_limits<float>::infinity());
  Vector3f high = Vector3f::Constant(-std::numeric_limits<float>::infinity());

  void extend(const Vector3f& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  void extend(const Box& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  [[nodiscard]] float half_area() const {
    const Vector3f d = high - low;
    return d.x() * d.y() + d.y() * d.z() + d.z() * d.x();
  }
};

/// A triangle on its way into the tree.
struct Item {
  Box box;
  std::uint32_t triangle = 0;
  [[nodiscard]] Vector3f twice_centre() const { return box.low + box.high; }
};

struct Range {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  Box box;
  [[nodiscard]] std::uint32_t size() const { return end - begin; }
};

struct Bin {
  Box box;
  std::uint32_t count = 0;
};

/// Where a plane across the longest axes of the centres costs least.
struct Split {
  int axis = -1;
  std::uint32_t bin = 0;
};

struct Binning {
  Vector3f origin;
  Vector3f per_bin;

  explicit Binning(const Box& centres) : origin(centres.low) {
    const Vector3f extent = centres.high - centres.low;
    for (int axis = 0; axis < 3; ++axis) {
      per_bin[axis] = extent[axis] > 0.0F ? static_cast<float>(kBins) / extent[axis] : 0.0F;
      if (!std::isfinite(per_bin[axis])) per_bin[axis] = 0.0F;
    }
  }
  [[nodiscard]] std::uint32_t bin(float twice_centre, int axis) const {
    const float place = (twice_centre - origin[axis]) * per_bin[axis];
    return std::min(static_cast<std::uint32_t>(std::max(place, 0.0F)), kBins - 1);
  }
};

class Builder {
 public:
  Builder(std::span<const Vector3f> vertices, std::span<const Corners> triangles)
      : items_(triangles.size()) {
    for (std::uint32_t i = 0; i < items_.size(); ++i) {
      items_[i].triangle = i;
      for (const std::uint32_t vertex : triangles[i]) items_[i].box.extend(vertices[vertex]);
    }
  }

  void build(std::vector<TreeNode>& nodes, std::vector<std::uint32_t>& block_begin) {
    nodes_ = &nodes;
    block_begin_ = &block_begin;
    nodes.reserve(items_.size() / 8 + 8);
    block_begin.reserve(items_.size() / 3 + 8);
    add_node(whole(0, static_cast<std::uint32_t>(items_.size())), 0);
    block_begin.push_back(static_cast<std::uint32_t>(items_.size()));
  }

  [[nodiscard]] std::vector<std::uint32_t> order() const {
    std::vector<std::uint32_t> order(items_.size());
    std::transform(items_.begin(), items_.end(), order.begin(),
                   [](const Item& item) { return item.triangle; });
    return order;
  }

 private:
  [[nodiscard]] Range whole(std::uint32_t begin, std::uint32_t end) const {
    Range range{begin, end, {}};
    for (std::uint32_t i = begin; i < end; ++i) range.box.extend(items_[i].box);
    return range;
  }

  std::uint32_t add_node(const Range& range, std::uint32_t depth) {
    const auto index = static_cast<std::uint32_t>(nodes_->size());
    nodes_->emplace_back();
    std::array<Range, kTreeWidth> children;
    const std::uint32_t count = divide(range, depth, children);
    std::array<std::uint32_t, kTreeWidth> child;
    child.fill(kNoChild);
    for (std::uint32_t i = 0; i < count; ++i) {
      if (children[i].size() <= kTreeWidth) {
        child[i] = kLeafBit | static_cast<std::uint32_t>(block_begin_->size());
        block_begin_->push_back(children[i].begin);
      } else {
        child[i] = add_node(children[i], depth + 1);
      }
    }
    std::copy(child.begin(), child.end(), (*nodes_)[index].child);
    return index;
  }

  /// Cuts the range into up to eight, the largest box first.
  std::uint32_t divide(const Range& range, std::uint32_t depth,
                       std::array<Range, kTreeWidth>& children) {
    children[0] = range;
    std::uint32_t count = 1;
    while (count < kTreeWidth) {
      std::uint32_t chosen = kTreeWidth;
      float largest = -1.0F;
      for (std::uint32_t i = 0; i < count; ++i) {
        const Range& child = children[i];
        if (child.size() > kLeafTarget && child.box.half_area() > largest) {
          largest = child.box.half_area();
          chosen = i;
        }
      }
      if (chosen == kTreeWidth) break;
      const Range parent = children[chosen];
      const std::uint32_t middle = cut(parent, depth);
      // In the order of their triangles, which is the order of blocks.
      for (std::uint32_t i = count++; i > chosen + 1; --i) children[i] = children[i - 1];
      children[chosen] = whole(parent.begin, middle);
      children[chosen + 1] = whole(middle, parent.end);
    }
    return count;
  }

  /// Parts the items of the range in two and gives where the second part begins.
  std::uint32_t cut(const Range& range, std::uint32_t depth) {
    Box centres;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      centres.extend(items_[i].twice_centre());
    }
    const auto begin = items_.begin() + range.begin;
    const auto end = items_.begin() + range.end;
    if (depth < kHalvingDepth) {
      const Binning binning(centres);
      const Split split = cheapest(range, binning);
      if (split.axis >= 0) {
        const auto middle = std::partition(begin, end, [&](const Item& item) {
          return binning.bin(item.twice_centre()[split.axis], split.axis) <= split.bin;
        });
        return static_cast<std::uint32_t>(middle - items_.begin());
      }
    }
    Eigen::Index axis = 0;
    (centres.high - centres.low).maxCoeff(&axis);
    const std::uint32_t middle = range.begin + range.size() / 2;
    std::nth_element(begin, items_.begin() + middle, end, [axis](const Item& a, const Item& b) {
      const float a_centre = a.twice_centre()[axis];
      const float b_centre = b.twice_centre()[axis];
      return a_centre != b_centre ? a_centre < b_centre : a.triangle < b.triangle;
    });
    return middle;
  }

  [[nodiscard]] Split cheapest(const Range& range, const Binning& binning) const {
    std::array<std::array<Bin, kBins>, 3> bins;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const Vector3f centre = items_[i].twice_centre();
      for (int axis = 0; axis < 3; ++axis) {
        Bin& bin = bins[static_cast<std::size_t>(axis)][binning.bin(centre[axis], axis)];
        bin.box.extend(items_[i].box);
        ++bin.count;
      }
    }
    Split best;
    float least = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const auto& row = bins[static_cast<std::size_t>(axis)];
      std::array<float, kBins> cost_behind{};
      Box behind;
      std::uint32_t count = 0;
      for (std::uint32_t bin = kBins - 1; bin > 0; --bin) {
        behind.extend(row[bin].box);
        count += row[bin].count;
        cost_behind[bin - 1] = count == 0 ? std::numeric_limits<float>::infinity()
                                          : behind.half_area() * static_cast<float>(count);
      }
      Box before;
      count = 0;
      for (std::uint32_t bin = 0; bin + 1 < kBins; ++bin) {
        before.extend(row[bin].box);
        count += row[bin].count;
        if (count == 0) continue;
        const float cost = before.half_area() * static_cast<float>(count) + cost_behind[bin];
        if (cost < least) {
          least = cost;
          best = {axis, bin};
        }
      }
    }
    return best;
  }

  std::vector<Item> items_;
  std::vector<TreeNode>* nodes_ = nullptr;
  std::vector<std::uint32_t>* block_begin_ = nullptr;
};

Box box_of(const TreeNode& node) {
  Box box;
  for (std::uint32_t i = 0; i < kTreeWidth; ++i) {
    if (node.child[i] == kNoChild) continue;
    box.extend(Vector3f(node.side[0][i], node.side[1][i], node.side[2][i]));
    box.extend(Vector3f(node.side[3][i], node.side[4][i], node.side[5][i]));
  }
  return box;
}

Box box_of(const TriangleBlock& block) {
  Box box;
  for (std::uint32_t i = 0; i < kTreeWidth; ++i) {
    box.extend(Vector3f(block.a[0][i], block.a[1][i], block.a[2][i]));
    box.extend(Vector3f(block.b[0][i], block.b[1][i], block.b[2][i]));
    box.extend(Vector3f(block.c[0][i], block.c[1][i], block.c[2][i]));
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
  nodes_.clear();
  block_begin_.clear();
  dipoles_.clear();
  Builder builder(vertices, triangles);
  builder.build(nodes_, block_begin_);
  blocks_.resize(block_begin_.size() - 1);
  return builder.order();
}

void TriangleTree::set_triangles(std::span<const Vector3f> vertices,
                                 std::span<const Corners> triangles) noexcept {
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    fill_block(blocks_[i], block_begin_[i], block_begin_[i + 1], vertices, triangles);
  }
  Box whole;
  for (const TriangleBlock& block : blocks_) whole.extend(box_of(block));
  bounds_ = Eigen::AlignedBox3f(whole.low, whole.high);
  // Boxes are wider than what they hold by more than a ray's arithmetic is wrong about them, as
  // long as it starts within two sizes of the mesh.
  constexpr float kMargin = 1e-6F;
  const float reach = bounds_.center().norm() + 2.0F * bounds_.diagonal().norm();
  const Vector3f margin = Vector3f::Constant(kMargin * reach);
  for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node) {
    for (std::uint32_t i = 0; i < kTreeWidth; ++i) {
      const std::uint32_t child = node->child[i];
      Box box;
      if (child != kNoChild) {
        const bool leaf = (child & kLeafBit) != 0;
        box = leaf ? box_of(blocks_[child & ~kLeafBit]) : box_of(nodes_[child]);
        if (leaf) box = {box.low - margin, box.high + margin};
      }
      for (int axis = 0; axis < 3; ++axis) {
        node->side[axis][i] = box.low[axis];
        node->side[axis + 3][i] = box.high[axis];
      }
    }
  }
}

void TriangleTree::set_shading(std::span<const Vector3f> normals,
                               std::span<const Corners> normal_of) noexcept {
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    TriangleBlock& block = blocks_[i];
    for (std::uint32_t lane = 0; lane < kTreeWidth; ++lane) {
      const std::uint32_t triangle = std::min(block_begin_[i] + lane, block_begin_[i + 1] - 1);
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const Octahedral normal = to_octahedral(normals[normal_of[triangle][corner]]);
        block.normal[corner][0][lane] = normal.u;
        block.normal[corner][1][lane] = normal.v;
      }
    }
  }
}

void TriangleTree::set_dipoles() {
  // How many radii away a part must be to count as a dipole.
  constexpr double kFar = 2.5;
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
      out.near_squared[i] = static_cast<float>(kFar * kFar * radius_squared);
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
