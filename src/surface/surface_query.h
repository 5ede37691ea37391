#pragma once

#include <cstdint>

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

/// A `Surface::shape` that none had before: what is built where another was is not taken for it.
[[nodiscard]] std::uint64_t new_shape() noexcept;

}  // namespace nade
