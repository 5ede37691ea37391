#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "nade/assert.h"
#include "nade/solids.h"

// Based on: Barber, Dobkin, Huhdanpaa. The Quickhull Algorithm for Convex Hulls. 1996.

namespace nade {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

Error refuse(std::string sentence) { return {ErrorCode::bad_value, std::move(sentence)}; }

/// Grows a hull point by point: the faces that a point sees make way for a cone to their rim.
class HullBuilder {
 public:
  explicit HullBuilder(std::span<const Eigen::Vector3f> points) : points_(points) {
    Eigen::AlignedBox3d bounds;
    for (const Eigen::Vector3f& point : points) bounds.extend(point.cast<double>());
    flat_ = kFlat * bounds.diagonal().norm();
  }

  [[nodiscard]] Result<TriangleSoup> build() {
    if (!start()) return refuse("convex hull: expected points in a solid, found all in a plane");
    for (std::uint32_t i = 0; i < points_.size(); ++i) add(i);
    return soup();
  }

 private:
  // Of the diagonal: points of a face that are rounded to floats are seen from none of its parts.
  static constexpr double kFlat = 1e-7;

  struct Face {
    Triangle corners;
    Vec3 normal;
    double offset;
  };

  [[nodiscard]] Vec3 at(std::uint32_t i) const { return points_[i].cast<double>(); }

  void add_face(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const Vec3 normal = (at(b) - at(a)).cross(at(c) - at(a)).normalized();
    faces_.push_back({{a, b, c}, normal, normal.dot(at(a))});
  }

  template <class Measure>
  [[nodiscard]] std::uint32_t farthest(Measure measure) const {
    std::uint32_t best = 0;
    double most = -1.0;
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      const double far = measure(at(i));
      if (far > most) {
        most = far;
        best = i;
      }
    }
    return best;
  }

  /// A first tetrahedron, as large as is found quickly; false where all is flat.
  [[nodiscard]] bool start() {
    const std::uint32_t a = farthest([&](const Vec3& p) { return (p - at(0)).squaredNorm(); });
    const std::uint32_t b = farthest([&](const Vec3& p) { return (p - at(a)).squaredNorm(); });
    const Vec3 along = (at(b) - at(a)).normalized();
    const std::uint32_t c =
        farthest([&](const Vec3& p) { return (p - at(a)).cross(along).squaredNorm(); });
    const Vec3 normal = along.cross(at(c) - at(a)).normalized();
    const std::uint32_t d =
        farthest([&](const Vec3& p) { return std::abs(normal.dot(p - at(a))); });
    const double height = normal.dot(at(d) - at(a));
    if (!(std::abs(height) > flat_)) return false;
    const auto [first, second] = height < 0.0 ? std::pair(b, c) : std::pair(c, b);
    add_face(a, first, second);
    add_face(a, d, first);
    add_face(first, d, second);
    add_face(second, d, a);
    return true;
  }

  void add(std::uint32_t i) {
    const Vec3 point = at(i);
    // Each side of the faces that are seen, but for those between two of them.
    std::set<std::pair<std::uint32_t, std::uint32_t>> rim;
    const auto seen = [&](const Face& face) {
      if (!(face.normal.dot(point) - face.offset > flat_)) return false;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t from = face.corners[k];
        const std::uint32_t to = face.corners[(k + 1) % 3];
        if (rim.erase({to, from}) == 0) rim.insert({from, to});
      }
      return true;
    };
    std::erase_if(faces_, seen);
    for (const auto& [from, to] : rim) add_face(from, to, i);
  }

  [[nodiscard]] TriangleSoup soup() const {
    TriangleSoup soup;
    std::map<std::uint32_t, std::uint32_t> places;
    for (const Face& face : faces_) {
      Triangle& triangle = soup.triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const auto next = static_cast<std::uint32_t>(soup.vertices.size());
        const auto [place, is_new] = places.try_emplace(face.corners[k], next);
        if (is_new) soup.vertices.push_back(points_[face.corners[k]]);
        triangle[k] = place->second;
      }
    }
    return soup;
  }

  std::span<const Eigen::Vector3f> points_;
  double flat_ = 0.0;
  std::vector<Face> faces_;
};

}  // namespace

Result<TriangleSoup> convex_hull(std::span<const Eigen::Vector3f> points) {
  if (points.size() < 4) {
    return refuse("convex hull: expected 4 points or more, found " + std::to_string(points.size()));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite()) continue;
    return refuse("convex hull: point " + std::to_string(i) + ": expected finite coordinates");
  }
  return HullBuilder(points).build();
}

Result<TriangleSoup> height_field(std::span<const float> heights, std::size_t columns,
                                  double step_m) {
  const std::size_t rows = columns > 0 ? heights.size() / columns : 0;
  if (columns < 2 || rows < 2 || rows * columns != heights.size()) {
    return refuse("height field: expected at least 2 rows of 2 heights, all as long, found " +
                  std::to_string(heights.size()) + " heights in rows of " +
                  std::to_string(columns));
  }
  if (!(std::isfinite(step_m) && step_m > 0.0)) {
    return refuse("height field: expected a step above 0, found " + std::to_string(step_m));
  }
  TriangleSoup soup;
  soup.vertices.reserve(heights.size());
  soup.triangles.reserve(2 * (rows - 1) * (columns - 1));
  const auto place = [step_m](std::size_t i, std::size_t count) {
    return static_cast<float>(step_m *
                              (static_cast<double>(i) - 0.5 * static_cast<double>(count - 1)));
  };
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const auto here = static_cast<std::uint32_t>(soup.vertices.size());
      soup.vertices.emplace_back(place(column, columns), heights[here], place(row, rows));
      if (row + 1 == rows || column + 1 == columns) continue;
      const auto below = here + static_cast<std::uint32_t>(columns);
      soup.triangles.push_back({here, below, here + 1});
      soup.triangles.push_back({here + 1, below, below + 1});
    }
  }
  return soup;
}

TriangleSoup scaled(TriangleSoup soup, const Vec3& scale) {
  NADE_ASSERT(scale.allFinite() && scale.cwiseAbs().minCoeff() > 0.0);
  for (Eigen::Vector3f& vertex : soup.vertices) {
    vertex = vertex.cwiseProduct(scale.cast<float>());
  }
  if (scale.prod() < 0.0) {
    for (Triangle& triangle : soup.triangles) std::swap(triangle[1], triangle[2]);
  }
  return soup;
}

}  // namespace nade
