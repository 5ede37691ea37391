#pragma once

// The slow and certain answers that a mesh's tree is held against.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "nade/mesh.h"

namespace nade::test {

/// Every triangle is tried: first a ball about it, in float and with a margin, which makes a loop
/// that compilers vectorise; where that cannot say no, the triangle itself in double.
class BruteForce {
 public:
  explicit BruteForce(const TriangleSoup& soup) {
    for (const auto& [i, j, k] : soup.triangles) {
      const Vec3 a = soup.vertices[i].cast<double>();
      const Vec3 ab = soup.vertices[j].cast<double>() - a;
      const Vec3 ac = soup.vertices[k].cast<double>() - a;
      if (ab.cross(ac).norm() > 0.0) triangles_.push_back({a, ab, ac, ab.cross(ac)});
    }
    for (const Triangle& t : triangles_) {
      const Vec3 to_centre = (t.ab + t.ac) / 3.0;
      const double radius =
          std::max({to_centre.norm(), (t.ab - to_centre).norm(), (t.ac - to_centre).norm()});
      balls_.add((t.a + to_centre).cast<float>(), static_cast<float>(radius + kMargin));
    }
    balls_.pad();
    squared_.resize(balls_.x.size());
  }

  struct Hit {
    double distance = std::numeric_limits<double>::infinity();
    /// Some edge is so close to the ray that rounding decides.
    bool doubtful = false;
  };
  [[nodiscard]] Hit first_hit(const Ray& ray) {
    Hit hit;
    double doubtful_at = std::numeric_limits<double>::infinity();
    measure_from_line(ray);
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      if (squared_[i] > balls_.radius[i] * balls_.radius[i]) continue;
      const Triangle& t = triangles_[i];
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

  [[nodiscard]] double distance(const Vec3& query) {
    const float centre = measure_from_point(query);  // a triangle's centre is a point of it
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      const float reach = centre + balls_.radius[i];
      if (squared_[i] <= reach * reach) least = std::min(least, squared(triangles_[i], query));
    }
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
  /// What balls are larger by than need be: many times what float rounding is there.
  static constexpr double kMargin = 1e-5;
  static constexpr std::size_t kLanes = 16;

  struct Triangle {
    Vec3 a, ab, ac, normal;
  };

  /// Balls about the triangles' centres, coordinate by coordinate.
  struct Balls {
    std::vector<float> x, y, z, radius;

    void add(const Eigen::Vector3f& centre, float radius_in) {
      x.push_back(centre.x());
      y.push_back(centre.y());
      z.push_back(centre.z());
      radius.push_back(radius_in);
    }
    /// To whole lanes, with balls that nothing comes near.
    void pad() {
      while (x.size() % kLanes != 0) add(Eigen::Vector3f::Constant(1e9F), 0.0F);
    }
  };

  /// `squared_`: distance of each ball's centre from the line of the ray.
  void measure_from_line(const Ray& ray) {
    const Eigen::Vector3f o = ray.origin.cast<float>();
    const Eigen::Vector3f d = ray.direction.cast<float>();
    for (std::size_t i = 0; i < squared_.size(); ++i) {
      const float x = balls_.x[i] - o.x();
      const float y = balls_.y[i] - o.y();
      const float z = balls_.z[i] - o.z();
      const float cross_x = y * d.z() - z * d.y();
      const float cross_y = z * d.x() - x * d.z();
      const float cross_z = x * d.y() - y * d.x();
      squared_[i] = cross_x * cross_x + cross_y * cross_y + cross_z * cross_z;
    }
  }

  /// `squared_`: distance of each ball's centre from the point. The least distance.
  float measure_from_point(const Vec3& query) {
    const Eigen::Vector3f q = query.cast<float>();
    for (std::size_t i = 0; i < squared_.size(); ++i) {
      const float x = balls_.x[i] - q.x();
      const float y = balls_.y[i] - q.y();
      const float z = balls_.z[i] - q.z();
      squared_[i] = x * x + y * y + z * z;
    }
    std::array<float, kLanes> least;
    least.fill(std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < squared_.size(); i += kLanes) {
      for (std::size_t k = 0; k < kLanes; ++k) {
        least[k] = squared_[i + k] < least[k] ? squared_[i + k] : least[k];
      }
    }
    return std::sqrt(*std::min_element(least.begin(), least.end()));
  }

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
  Balls balls_;
  std::vector<float> squared_;  ///< scratch, so that a query allocates nothing
};

}  // namespace nade::test
