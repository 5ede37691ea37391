#include "triangle_tree_build.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

// Based on: Wald. On fast Construction of SAH-based Bounding Volume Hierarchies. 2007.

namespace nade::detail {
namespace {

using Eigen::Vector3f;

constexpr std::uint32_t kBins = 16;
/// Leaves are not split below this: a half-empty block costs as much as a full one.
constexpr std::uint32_t kLeafTarget = 8;
/// From this depth on ranges are halved, which bounds the depth whatever the triangles are like.
constexpr std::uint32_t kHalvingDepth = 32;

/// A triangle on its way into the tree.
struct Item {
  TreeBox box;
  std::uint32_t triangle = 0;
  [[nodiscard]] Vector3f twice_centre() const { return box.low + box.high; }
};

/// How many leaves so many triangles fill at least.
float leaves_for(std::uint32_t count) {
  const std::uint32_t leaves = (count + kTreeWidth - 1) / kTreeWidth;
  return static_cast<float>(leaves);
}

struct Range {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  TreeBox box;
  [[nodiscard]] std::uint32_t size() const { return end - begin; }
};

struct Bin {
  TreeBox box;
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

  explicit Binning(const TreeBox& centres) : origin(centres.low) {
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

  [[nodiscard]] BuiltTree build() {
    const auto count = static_cast<std::uint32_t>(items_.size());
    tree_.nodes.reserve(items_.size() / 8 + 8);
    tree_.block_begin.reserve(items_.size() / 3 + 8);
    add_node(whole(0, count), 0);
    tree_.block_begin.push_back(count);
    tree_.order.resize(items_.size());
    std::transform(items_.begin(), items_.end(), tree_.order.begin(),
                   [](const Item& item) { return item.triangle; });
    return std::move(tree_);
  }

 private:
  [[nodiscard]] Range whole(std::uint32_t begin, std::uint32_t end) const {
    Range range{begin, end, {}};
    for (std::uint32_t i = begin; i < end; ++i) range.box.extend(items_[i].box);
    return range;
  }

  std::uint32_t add_node(const Range& range, std::uint32_t depth) {
    const auto index = static_cast<std::uint32_t>(tree_.nodes.size());
    tree_.nodes.emplace_back();
    std::array<Range, kTreeWidth> children;
    const std::uint32_t count = divide(range, depth, children);
    std::array<std::uint32_t, kTreeWidth> child;
    child.fill(kNoChild);
    for (std::uint32_t i = 0; i < count; ++i) {
      if (children[i].size() <= kTreeWidth) {
        child[i] = kLeafBit | static_cast<std::uint32_t>(tree_.block_begin.size());
        tree_.block_begin.push_back(children[i].begin);
      } else {
        child[i] = add_node(children[i], depth + 1);
      }
    }
    std::copy(child.begin(), child.end(), tree_.nodes[index].child);
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
    TreeBox centres;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      centres.extend(items_[i].twice_centre());
    }
    Item* const begin = items_.data() + range.begin;
    Item* const end = items_.data() + range.end;
    if (depth < kHalvingDepth) {
      const Binning binning(centres);
      const Split split = cheapest(range, binning);
      if (split.axis >= 0) {
        Item* const middle = std::partition(begin, end, [&](const Item& item) {
          return binning.bin(item.twice_centre()[split.axis], split.axis) <= split.bin;
        });
        return static_cast<std::uint32_t>(middle - items_.data());
      }
    }
    Eigen::Index axis = 0;
    (centres.high - centres.low).maxCoeff(&axis);
    const std::uint32_t middle = range.begin + range.size() / 2;
    std::nth_element(begin, items_.data() + middle, end, [axis](const Item& a, const Item& b) {
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
      TreeBox behind;
      std::uint32_t count = 0;
      for (std::uint32_t bin = kBins - 1; bin > 0; --bin) {
        behind.extend(row[bin].box);
        count += row[bin].count;
        cost_behind[bin - 1] = count == 0 ? std::numeric_limits<float>::infinity()
                                          : behind.half_area() * leaves_for(count);
      }
      TreeBox before;
      count = 0;
      for (std::uint32_t bin = 0; bin + 1 < kBins; ++bin) {
        before.extend(row[bin].box);
        count += row[bin].count;
        if (count == 0) continue;
        const float cost = before.half_area() * leaves_for(count) + cost_behind[bin];
        if (cost < least) {
          least = cost;
          best = {axis, bin};
        }
      }
    }
    return best;
  }

  std::vector<Item> items_;
  BuiltTree tree_;
};

}  // namespace

BuiltTree build_tree(std::span<const Vector3f> vertices, std::span<const Corners> triangles) {
  return Builder(vertices, triangles).build();
}

}  // namespace nade::detail
