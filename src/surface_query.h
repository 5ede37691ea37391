#pragma once

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

}  // namespace nade
