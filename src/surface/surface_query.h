#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "nade/surface.h"

namespace nade {

/// Whether a surface can be asked this: anything else has no answer.
[[nodiscard]] inline bool is_query(const Ray& ray) {
  return ray.origin.allFinite() && ray.direction.allFinite() && ray.max_distance >= 0.0 &&
         ray.direction.squaredNorm() > 0.0;
}
[[nodiscard]] inline bool is_query(const Vec3& query, double max_distance) {
  return query.allFinite() && max_distance >= 0.0;
}

/// Where a ray enters and leaves a ball about the origin; either may be behind its origin.
struct Chord {
  double enters;
  double leaves;
};
[[nodiscard]] inline std::optional<Chord> chord_in_ball(const Vec3& origin, const Vec3& direction,
                                                        double radius) {
  // From the point of the ray nearest the centre, where the roots are +- half a chord away.
  const double nearest = -origin.dot(direction);
  const double miss = (origin + nearest * direction).norm();
  if (!(miss <= radius)) return std::nullopt;
  const double half = std::sqrt((radius - miss) * (radius + miss));
  return Chord{nearest - half, nearest + half};
}

/// A `Surface::shape` that none had before: what is built where another was is not taken for it.
[[nodiscard]] std::uint64_t new_shape() noexcept;

}  // namespace nade
