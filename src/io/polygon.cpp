#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "mesh_words.h"

// Based on: Meisters. Polygons Have Ears. 1975.

namespace nade::io {
namespace {

using Point = Eigen::Vector2d;
using Triangle = std::array<Point, 3>;

/// Twice the area of a triangle, above 0 where it turns left.
double area(const Point& a, const Point& b, const Point& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// A polygon's corners in the plane that it lies in at best, its area above 0.
std::vector<Point> flattened(const TriangleSoup& soup, std::span<const std::uint32_t> corners) {
  const auto at = [&](std::size_t i) -> Vec3 {
    return soup.vertices[corners[i % corners.size()]].cast<double>();
  };
  Vec3 normal = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    normal += (at(i) - at(0)).cross(at(i + 1) - at(0));
  }
  Eigen::Index drop = 0;
  normal.cwiseAbs().maxCoeff(&drop);
  const Eigen::Index x = (drop + 1) % 3;
  const Eigen::Index y = (drop + 2) % 3;
  const double sign = normal[drop] < 0.0 ? -1.0 : 1.0;
  std::vector<Point> points;
  points.reserve(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    points.emplace_back(sign * at(i)[x], at(i)[y]);
  }
  return points;
}

/// The corners that may lie in an ear, by place.
class CornerGrid {
 public:
  CornerGrid(const std::vector<Point>& points, const std::vector<std::size_t>& corners) {
    Eigen::AlignedBox2d bounds;
    for (const Point& point : points) bounds.extend(point);
    side_ = static_cast<std::size_t>(std::sqrt(static_cast<double>(corners.size()))) + 1;
    low_ = bounds.min();
    per_m_ = (static_cast<double>(side_) / bounds.sizes().array().max(kThinnest)).matrix();
    first_.assign(side_ * side_ + 1, 0);
    for (const std::size_t corner : corners) ++first_[cell_of(points[corner]) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    corners_.resize(corners.size());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (const std::size_t corner : corners) corners_[next[cell_of(points[corner])]++] = corner;
  }

  /// Whether `is_hit` says so of a corner in the cells of a triangle; `looks` grows by what was
  /// looked at.
  template <class IsHit>
  [[nodiscard]] bool any(const Triangle& triangle, std::size_t& looks, IsHit is_hit) const {
    Eigen::AlignedBox2d box(triangle[0]);
    box.extend(triangle[1]).extend(triangle[2]);
    for (std::size_t row = place(box.min(), 1); row <= place(box.max(), 1); ++row) {
      const Eigen::AlignedBox2d part = part_in(row, triangle);
      if (part.isEmpty()) continue;
      const std::size_t first = row * side_ + place(part.min(), 0);
      const std::size_t last = row * side_ + place(part.max(), 0);
      looks += last - first + first_[last + 1] - first_[first];
      const auto begin = corners_.begin();
      if (std::any_of(begin + static_cast<std::ptrdiff_t>(first_[first]),
                      begin + static_cast<std::ptrdiff_t>(first_[last + 1]), is_hit)) {
        return true;
      }
    }
    return false;
  }

 private:
  static constexpr double kThinnest = 1e-300;
  static constexpr double kMargin = 1e-6;  // of a cell, against rounding

  [[nodiscard]] std::size_t place(const Point& point, Eigen::Index axis) const {
    const double at = (point[axis] - low_[axis]) * per_m_[axis];
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(side_ - 1)));
  }
  /// Bounds what of a triangle lies in a row of cells, or a little beside it.
  [[nodiscard]] Eigen::AlignedBox2d part_in(std::size_t row, const Triangle& triangle) const {
    const double low = low_.y() + (static_cast<double>(row) - kMargin) / per_m_.y();
    const double high = low_.y() + (static_cast<double>(row) + 1.0 + kMargin) / per_m_.y();
    const Point margin(kMargin / per_m_.x(), 0.0);
    Eigen::AlignedBox2d part;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point& p = triangle[i];
      const Point along = triangle[(i + 1) % 3] - p;
      if (p.y() >= low && p.y() <= high) part.extend(p - margin).extend(p + margin);
      for (const double y : {low, high}) {
        const double share = (y - p.y()) / along.y();
        if (!(share >= 0.0 && share <= 1.0)) continue;
        const Point crossing = p + share * along;
        part.extend(crossing - margin).extend(crossing + margin);
      }
    }
    return part;
  }
  [[nodiscard]] std::size_t cell_of(const Point& point) const {
    return place(point, 1) * side_ + place(point, 0);
  }

  std::size_t side_ = 1;  ///< in cells
  Point low_ = Point::Zero();
  Point per_m_ = Point::Zero();     ///< cells
  std::vector<std::size_t> first_;  ///< in `corners_`, of each cell
  std::vector<std::size_t> corners_;
};

/// Cuts ears off a ring of corners.
class EarCutter {
 public:
  explicit EarCutter(std::vector<Point> points)
      : points_(std::move(points)), next_(points_.size()), before_(points_.size()) {
    const std::size_t count = points_.size();
    for (std::size_t i = 0; i < count; ++i) {
      next_[i] = (i + 1) % count;
      before_[i] = (i + count - 1) % count;
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (!(turn(i) > 0.0)) inward_.push_back(i);
    }
  }

  [[nodiscard]] bool is_convex() const { return inward_.empty(); }

  /// Calls `add(i, j, k)` for every triangle; false where it would take too long.
  template <class Add>
  [[nodiscard]] bool cut(Add add) {
    const CornerGrid grid(points_, inward_);
    const std::size_t most_looks = kMostLooks * points_.size();
    std::size_t left = points_.size();
    std::size_t at = 0;
    const auto clip = [&](std::size_t i) {
      add(before_[i], i, next_[i]);
      next_[before_[i]] = next_[i];
      before_[next_[i]] = before_[i];
      waiting_.push_back(before_[i]);
      waiting_.push_back(next_[i]);
      at = next_[i];
      --left;
    };
    int rounds = 0;
    while (left > 3) {
      const std::size_t left_before = left;
      // Cutting an ear mostly changes what its neighbours are; a round over all finds the rest.
      if (rounds++ < kMostRounds) wait_for_all(at);
      for (std::size_t head = 0; head < waiting_.size() && left > 3; ++head) {
        if (looks_ > most_looks) return false;
        const std::size_t i = waiting_[head];
        if (!is_gone(i) && is_ear(i, grid)) clip(i);
      }
      waiting_.clear();
      // Only a polygon that crosses itself has no ear at all.
      if (left == left_before) clip(at);
    }
    add(before_[at], at, next_[at]);
    return true;
  }

 private:
  // Keeps a polygon of a million bytes to seconds.
  static constexpr std::size_t kMostLooks = 5'000;  // per corner
  static constexpr int kMostRounds = 16;

  [[nodiscard]] double turn(std::size_t i) const {
    return area(points_[before_[i]], points_[i], points_[next_[i]]);
  }
  [[nodiscard]] bool is_gone(std::size_t i) const { return next_[before_[i]] != i; }
  void wait_for_all(std::size_t first) {
    waiting_.assign(1, first);
    for (std::size_t i = next_[first]; i != first; i = next_[i]) waiting_.push_back(i);
  }

  /// Whether the corner points outward and no other lies in its triangle.
  [[nodiscard]] bool is_ear(std::size_t i, const CornerGrid& grid) {
    const Point& a = points_[before_[i]];
    const Point& b = points_[i];
    const Point& c = points_[next_[i]];
    ++looks_;
    if (!(area(a, b, c) > 0.0)) return false;
    return !grid.any({a, b, c}, looks_, [&](std::size_t k) {
      const Point& p = points_[k];
      if (is_gone(k) || p == a || p == b || p == c) return false;
      return area(a, b, p) >= 0.0 && area(b, c, p) >= 0.0 && area(c, a, p) >= 0.0;
    });
  }

  std::vector<Point> points_;
  std::vector<std::size_t> next_;
  std::vector<std::size_t> before_;
  std::vector<std::size_t> inward_;   ///< and straight ones, before any cut
  std::vector<std::size_t> waiting_;  ///< corners to look at
  std::size_t looks_ = 0;
};

}  // namespace

bool add_polygon(TriangleSoup& soup, std::span<const std::uint32_t> corners) {
  if (corners.size() < 3) return true;
  const auto add = [&](std::size_t i, std::size_t j, std::size_t k) {
    soup.triangles.push_back({corners[i], corners[j], corners[k]});
  };
  if (corners.size() > 3) {
    std::vector<Point> points = flattened(soup, corners);
    const bool finite = std::all_of(points.begin(), points.end(),
                                    [](const Point& point) { return point.allFinite(); });
    EarCutter cutter(std::move(points));
    if (finite && !cutter.is_convex()) return cutter.cut(add);
  }
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) add(0, i, i + 1);
  return true;
}

}  // namespace nade::io
