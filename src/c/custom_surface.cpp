#include "custom_surface.h"

// Based on: Hart. Sphere Tracing. 1996.

#include <array>
#include <cmath>

#include "convert.h"
#include "surface/surface_query.h"

namespace nade::c_abi {
namespace {

constexpr int kMostSteps = 128;
constexpr double kOnSurface_m = 1e-7;

std::array<double, 3> numbers_of(const Vec3& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

/// No value where it has no length, or is no number.
std::optional<Vec3> unit_from(const double* values) {
  const Vec3 unit = vector_from(values).stableNormalized();
  if (!(std::abs(unit.squaredNorm() - 1.0) < 1e-6)) return std::nullopt;
  return unit;
}

}  // namespace

CustomSurface::CustomSurface(const nade_surface_callbacks& callbacks)
    : callbacks_(callbacks), number_(new_shape()) {}

CustomSurface::~CustomSurface() {
  if (owns_ && callbacks_.release != nullptr) callbacks_.release(callbacks_.user);
}

std::optional<RayHit> CustomSurface::first_hit(const Ray& ray) const noexcept {
  if (!is_query(ray)) return std::nullopt;
  if (callbacks_.first_hit == nullptr) return hit_by_steps(ray);
  nade_ray_hit found{};
  if (callbacks_.first_hit(callbacks_.user, numbers_of(ray.origin).data(),
                           numbers_of(ray.direction).data(), ray.max_distance, &found) == 0) {
    return std::nullopt;
  }
  const Vec3 point = vector_from(found.point);
  const std::optional<Vec3> normal = unit_from(found.normal);
  const bool is_within = found.distance >= 0.0 && found.distance <= ray.max_distance;
  if (!normal || !point.allFinite() || !is_within) return std::nullopt;
  return RayHit{found.distance, point, *normal, normal->dot(ray.direction) > 0.0};
}

/// No surface is nearer than the distance of the nearest: a step that long passes none.
std::optional<RayHit> CustomSurface::hit_by_steps(const Ray& ray) const noexcept {
  SurfaceHint hint;
  double along = 0.0;
  for (int step = 0; step < kMostSteps && along <= ray.max_distance; ++step) {
    const auto found =
        closest_point(ray.origin + along * ray.direction, ray.max_distance - along, hint);
    if (!found) return std::nullopt;
    const double distance = std::abs(found->signed_distance);
    if (distance <= kOnSurface_m) {
      return RayHit{along, found->point, found->normal, found->normal.dot(ray.direction) > 0.0};
    }
    along += distance;
  }
  return std::nullopt;
}

std::optional<SurfacePoint> CustomSurface::closest_point(const Vec3& query, double max_distance,
                                                         SurfaceHint& hint) const noexcept {
  if (!is_query(query, max_distance)) return std::nullopt;
  nade_surface_point found{};
  if (callbacks_.closest_point(callbacks_.user, numbers_of(query).data(), max_distance,
                               &hint.element, &found) == 0) {
    return std::nullopt;
  }
  const Vec3 point = vector_from(found.point);
  const std::optional<Vec3> normal = unit_from(found.normal);
  const bool is_within = std::abs(found.signed_distance) <= max_distance;
  if (!normal || !point.allFinite() || !std::isfinite(found.signed_distance) || !is_within) {
    return std::nullopt;
  }
  return SurfacePoint{point, *normal, found.signed_distance};
}

std::uint64_t CustomSurface::shape() const noexcept {
  if (callbacks_.shape == nullptr) return number_;
  constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15;  // spreads small numbers over all bits
  return (callbacks_.shape(callbacks_.user) + 1) * kOdd ^ number_;
}

std::optional<SurfaceBounds> CustomSurface::bounds() const noexcept {
  if (callbacks_.bounds == nullptr) return std::nullopt;
  std::array<double, 3> low{};
  std::array<double, 3> high{};
  if (callbacks_.bounds(callbacks_.user, low.data(), high.data()) == 0) return std::nullopt;
  const SurfaceBounds bounds{vector_from(low.data()), vector_from(high.data())};
  if (!bounds.low.allFinite() || !bounds.high.allFinite()) return std::nullopt;
  if ((bounds.high - bounds.low).minCoeff() < 0.0) return std::nullopt;
  return bounds;
}

}  // namespace nade::c_abi
