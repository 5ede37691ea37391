#pragma once

#include <optional>

#include "nade/surface.h"

namespace nade {

/// An object's surface in the object's frame, and in the world's lengths.
class ScaledSurface {
 public:
  explicit ScaledSurface(const Object& object)
      : identity_(object.identity()), scale_(object.placement().scale) {}

  [[nodiscard]] const Surface& surface() const { return *identity_.surface; }
  [[nodiscard]] const ObjectIdentity& identity() const { return identity_; }
  [[nodiscard]] double scale() const { return scale_; }

  [[nodiscard]] std::optional<RayHit> first_hit(const Ray& ray) const noexcept {
    std::optional<RayHit> hit =
        surface().first_hit({ray.origin / scale_, ray.direction, ray.max_distance / scale_});
    if (!hit) return std::nullopt;
    hit->distance *= scale_;
    hit->point *= scale_;
    return hit;
  }

  [[nodiscard]] std::optional<SurfacePoint> closest_point(const Vec3& query, double max_distance_m,
                                                          SurfaceHint& hint) const noexcept {
    std::optional<SurfacePoint> found =
        surface().closest_point(query / scale_, max_distance_m / scale_, hint);
    if (!found) return std::nullopt;
    found->point *= scale_;
    found->signed_distance *= scale_;
    return found;
  }

 private:
  ObjectIdentity identity_;
  double scale_;
};

}  // namespace nade
