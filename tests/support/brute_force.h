#pragma once

// The slow and certain answers that a mesh's tree is held against.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "nade/mesh.h"

namespace nade::test {

/// Every triangle is tried, in double.
class BruteForce {
 public:
  explicit BruteForce(const TriangleSoup& soup) {
    for (const auto& [i, j, k] : soup.triangles) {
      const Vec3 a = soup.vertices[i].cast<double>();
      const Vec3 ab = soup.vertices[j].cast<double>() - a;
      const Vec3 ac = soup.vertices[k].cast<double>() - a;
      if (ab.cross(ac).norm() > 0.0) triangles_.push_back({a, ab, ac, ab.cross(ac)});
    }
  }

  struct Hit {
    double distance = std::numeric_limits<double>::infinity();
    /// Some edge is so close to the ray that rounding decides.
    bool doubtful = false;
  };
  [[nodiscard]] Hit first_hit(const Ray& ray) const {
    Hit hit;
    double doubtful_at = std::numeric_limits<double>::infinity();
    for (const Triangle& t : triangles_) {
      const double slope = t.normal.dot(ray.direction);
      const double distance = t.normal.dot(t.a - ray.origin) / slope;
      if (!(distance >= -kRounding && distance < hit.distance)) continue;
      const Vec3 from_a = ray.origin + distance * ray.direction - t.a;
      const double area = t.normal.squaredNorm();
      const double b = t.normal.dot(from_a.cross(t.ac)) / area;
      const double c = t.normal.dot(t.ab.cross(from_a)) / area;
      const double inside = std::min({b, c, 1.0 - b - c});
      // How far inside in metres across the ray, where the triangle is seen at a slant.
      const double height = std::sqrt(area) / std::max(t.ab.norm(), t.ac.norm());
      const double slant = std::abs(slope) / std::sqrt(area);
      if (std::abs(inside) * height * slant < kRounding || std::abs(distance) < kRounding) {
        doubtful_at = std::min(doubtful_at, distance);
      }
      if (inside >= 0.0 && distance >= 0.0) hit.distance = distance;
    }
    hit.doubtful = std::isfinite(doubtful_at) && doubtful_at <= hit.distance;
    return hit;
  }

  [[nodiscard]] double distance(const Vec3& query) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Triangle& t : triangles_) least = std::min(least, squared(t, query));
    return std::sqrt(least);
  }

  /// Generalised winding number; the solid angles summed one by one.
  [[nodiscard]] double winding(const Vec3& query) const {
    double sum = 0.0;
    for (const Triangle& t : triangles_) {
      const Vec3 a = t.a - query;
      const Vec3 b = a + t.ab;
      const Vec3 c = a + t.ac;
      const double la = a.norm();
      const double lb = b.norm();
      const double lc = c.norm();
      sum += std::atan2(a.dot(b.cross(c)),
                        la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return sum / (2.0 * std::numbers::pi);
  }

 private:
  /// What float rounding may move something by, metres, on meshes of half a metre.
  static constexpr double kRounding = 2e-6;

  struct Triangle {
    Vec3 a, ab, ac, normal;
  };

  /// By projection: onto the plane where that falls inside, else onto the nearest edge.
  static double squared(const Triangle& t, const Vec3& query) {
    const Vec3 q = query - t.a;
    const double area = t.normal.squaredNorm();
    const double b = t.normal.dot(q.cross(t.ac)) / area;
    const double c = t.normal.dot(t.ab.cross(q)) / area;
    if (b >= 0.0 && c >= 0.0 && b + c <= 1.0) {
      const double height = t.normal.dot(q);
      return height * height / area;
    }
    const auto to_edge = [](const Vec3& from, const Vec3& along) {
      const double share = std::clamp(from.dot(along) / along.squaredNorm(), 0.0, 1.0);
      return (from - share * along).squaredNorm();
    };
    return std::min({to_edge(q, t.ab), to_edge(q, t.ac), to_edge(q - t.ab, t.ac - t.ab)});
  }

  std::vector<Triangle> triangles_;
};

}  // namespace nade::test
