#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh_words.h"

// Based on: Meisters. Polygons Have Ears. 1975.

namespace nade::io {
namespace {

using Point = Eigen::Vector2d;

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
      if (turn(i) <= 0.0) inward_.push_back(i);
    }
    budget_ = std::min(4 * count * count, kMostPerCorner * count);
  }

  [[nodiscard]] bool is_convex() const { return inward_.empty(); }

  /// Calls `add(i, j, k)` for every triangle; false where it would take too long.
  template <class Add>
  [[nodiscard]] bool cut(Add add) {
    std::size_t left = points_.size();
    std::size_t at = 0;
    std::size_t tried = 0;
    while (left > 3) {
      if (budget_ == 0) return false;
      // Only a polygon that crosses itself has no ear at all.
      if (tried < left && !is_ear(at)) {
        at = next_[at];
        ++tried;
        continue;
      }
      add(before_[at], at, next_[at]);
      next_[before_[at]] = next_[at];
      before_[next_[at]] = before_[at];
      at = next_[next_[at]];
      --left;
      tried = 0;
      if (left % kTidyEvery == 0) tidy();
    }
    add(before_[at], at, next_[at]);
    return true;
  }

 private:
  // Keeps a polygon of a million bytes to seconds.
  static constexpr std::size_t kMostPerCorner = 2'000;
  static constexpr std::size_t kTidyEvery = 64;

  [[nodiscard]] double turn(std::size_t i) const {
    return area(points_[before_[i]], points_[i], points_[next_[i]]);
  }
  [[nodiscard]] bool is_gone(std::size_t i) const { return next_[before_[i]] != i; }
  void tidy() {
    std::erase_if(inward_, [this](std::size_t i) { return is_gone(i) || turn(i) > 0.0; });
  }

  /// Whether the corner points outward and no other lies in its triangle.
  [[nodiscard]] bool is_ear(std::size_t i) {
    const Point& a = points_[before_[i]];
    const Point& b = points_[i];
    const Point& c = points_[next_[i]];
    budget_ -= std::min<std::size_t>(budget_, 1 + inward_.size());
    if (!(area(a, b, c) > 0.0)) return false;
    return std::none_of(inward_.begin(), inward_.end(), [&](std::size_t k) {
      const Point& p = points_[k];
      if (is_gone(k) || p == a || p == b || p == c) return false;
      return area(a, b, p) >= 0.0 && area(b, c, p) >= 0.0 && area(c, a, p) >= 0.0;
    });
  }

  std::vector<Point> points_;
  std::vector<std::size_t> next_;
  std::vector<std::size_t> before_;
  std::vector<std::size_t> inward_;  ///< and straight ones; some of them gone
  std::size_t budget_ = 0;           ///< corners that may still be looked at
};

}  // namespace

bool add_polygon(TriangleSoup& soup, std::span<const std::uint32_t> corners) {
  if (corners.size() < 3) return true;
  const auto add = [&](std::size_t i, std::size_t j, std::size_t k) {
    soup.triangles.push_back({corners[i], corners[j], corners[k]});
  };
  if (corners.size() > 3) {
    EarCutter cutter(flattened(soup, corners));
    if (!cutter.is_convex()) return cutter.cut(add);
  }
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) add(0, i, i + 1);
  return true;
}

}  // namespace nade::io
