#include <cmath>
#include <limits>

#include "make_dog_body.h"

namespace dog {
namespace {

/// Where a ray from outside first meets the surface.
Vec3 meet(const Body& body, Vec3 point, const Vec3& direction) {
  constexpr int kSteps = 400;
  for (int i = 0; i < kSteps; ++i) {
    const double away = body.distance(point);
    if (away < 1e-7) break;
    point += 0.6 * away * direction;
  }
  return body.project(point, 3);
}

Place place_at(const Body& body, const std::string& name, const Vec3& point, const Vec3& along) {
  const Vec3 normal = body.sample(point).gradient.normalized();
  return {name, point, normal, (along - along.dot(normal) * normal).normalized()};
}

/// The middle of the straightest stretch of the back between withers and rump.
Vec3 straightest_back(const Body& body) {
  constexpr double kFrom = -0.10;
  constexpr double kTo = 0.18;
  constexpr double kStep = 0.01;
  constexpr int kCount = 29;
  constexpr int kStretch = 17;  // 16 cm
  static_assert(kFrom + (kCount - 1) * kStep < kTo + 1e-9);
  std::vector<Vec3> line;
  line.reserve(kCount);
  for (int i = 0; i < kCount; ++i)
    line.push_back(meet(body, {kFrom + i * kStep, 0.6, 0.0}, -Vec3::UnitY()));
  double best_bow = std::numeric_limits<double>::max();
  std::size_t best = 0;
  for (std::size_t first = 0; first + kStretch <= line.size(); ++first) {
    const Vec3& a = line[first];
    const Vec3 chord = (line[first + kStretch - 1] - a).normalized();
    double bow = 0.0;
    for (std::size_t i = first; i < first + kStretch; ++i)
      bow = std::max(bow, (line[i] - a).cross(chord).norm());
    if (bow < best_bow) {
      best_bow = bow;
      best = first;
    }
  }
  return line[best + kStretch / 2];
}

}  // namespace

std::vector<Place> find_places(const Body& body) {
  const Vec3 back_along = Vec3::UnitX();
  const Vec3 down = -Vec3::UnitY();
  return {
      place_at(body, "place-back", straightest_back(body), back_along),
      place_at(body, "place-flank", meet(body, {0.0, 0.345, 0.3}, -Vec3::UnitZ()), back_along),
      place_at(body, "place-head", meet(body, {-0.262, 0.8, 0.0}, down), back_along),
      place_at(body, "place-ear", meet(body, {-0.262, 0.552, 0.3}, -Vec3::UnitZ()), down),
      place_at(body, "place-leg", meet(body, {-0.131, 0.18, 0.3}, -Vec3::UnitZ()), down),
  };
}

}  // namespace dog
