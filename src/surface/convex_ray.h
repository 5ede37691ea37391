#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "nade/surface.h"
#include "surface_query.h"

namespace nade {

/// How far out of a solid a point is, and which way that grows.
struct SignedDistance {
  double distance = 0.0;  ///< below 0 inside
  Vec3 normal = Vec3::UnitY();
};

/// The first hit of a ray on a convex solid within `radius` of the origin, whose `at(point)` is the
/// signed distance. Along a ray that is a convex function, so Newton's steps from outside come
/// ever nearer to where it is 0 and never pass it.
template <class At>
[[nodiscard]] std::optional<RayHit> convex_hit(const Ray& ray, double radius, At at) {
  constexpr int kMostSteps = 64;
  const std::optional<Chord> chord = chord_in_ball(ray.origin, ray.direction, radius);
  if (!chord) return std::nullopt;
  const SignedDistance start = at(ray.origin);
  const double slope = start.normal.dot(ray.direction);
  const bool inside = start.distance < 0.0 || (start.distance == 0.0 && slope > 0.0);
  if (chord->leaves < 0.0 || (!inside && slope >= 0.0)) return std::nullopt;
  const double enough = 1e-13 * (radius + 0.5 * std::abs(chord->enters + chord->leaves));
  // From a point of the ray that is outside the solid, on the side of the hit.
  double t = inside ? chord->leaves : std::max(0.0, chord->enters);
  RayHit hit;
  for (int step = 0; step < kMostSteps; ++step) {
    const Vec3 point = ray.origin + t * ray.direction;
    const SignedDistance here = at(point);
    const double along = here.normal.dot(ray.direction);
    hit = {t, point - here.distance * here.normal, here.normal, inside};
    if (here.distance <= enough) break;
    // Past the nearest point of the ray: it goes by.
    if (inside ? along <= 0.0 : along >= 0.0) return std::nullopt;
    t -= here.distance / along;
    if (!inside && t > ray.max_distance) return std::nullopt;
  }
  hit.distance = std::max(0.0, hit.distance);
  if (!(hit.distance <= ray.max_distance)) return std::nullopt;
  hit.from_inside = hit.normal.dot(ray.direction) > 0.0;
  return hit;
}

}  // namespace nade
