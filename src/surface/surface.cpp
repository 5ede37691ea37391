#include "nade/surface.h"

#include <atomic>
#include <cmath>

#include "nade/assert.h"
#include "surface_query.h"

namespace nade {
namespace {

RayHit hit_at(const Ray& ray, double distance, const Vec3& point, const Vec3& normal) {
  return {distance, point, normal, normal.dot(ray.direction) > 0.0};
}

/// A squared length of a rotation is not off by more than this.
constexpr double kNormalized = 1e-12;

class NoSurface final : public Surface {
 public:
  [[nodiscard]] std::optional<RayHit> first_hit(const Ray& /*ray*/) const noexcept override {
    return std::nullopt;
  }
  [[nodiscard]] std::optional<SurfacePoint> closest_point(
      const Vec3& /*query*/, double /*max_distance*/,
      SurfaceHint& /*hint*/) const noexcept override {
    return std::nullopt;
  }
};

}  // namespace

std::uint64_t new_shape() noexcept {
  static std::atomic<std::uint64_t> shapes{0};
  return ++shapes;
}

std::optional<RayHit> PlaneSurface::first_hit(const Ray& ray) const noexcept {
  if (!is_query(ray) || ray.direction.y() == 0.0) return std::nullopt;
  const double distance = -ray.origin.y() / ray.direction.y();
  if (!(distance >= 0.0 && distance <= ray.max_distance)) return std::nullopt;
  Vec3 point = ray.origin + distance * ray.direction;
  point.y() = 0.0;
  if (!std::isfinite(distance) || !point.allFinite()) return std::nullopt;
  return hit_at(ray, distance, point, Vec3::UnitY());
}

std::optional<SurfacePoint> PlaneSurface::closest_point(const Vec3& query, double max_distance,
                                                        SurfaceHint& /*hint*/) const noexcept {
  if (!is_query(query, max_distance) || std::abs(query.y()) > max_distance) return std::nullopt;
  return SurfacePoint{{query.x(), 0.0, query.z()}, Vec3::UnitY(), query.y()};
}

SphereSurface::SphereSurface(double radius_m) : radius_(radius_m) {
  NADE_ASSERT(std::isfinite(radius_m) && radius_m > 0.0);
}

std::optional<RayHit> SphereSurface::first_hit(const Ray& ray) const noexcept {
  if (!is_query(ray)) return std::nullopt;
  const std::optional<Chord> chord = chord_in_ball(ray.origin, ray.direction, radius_);
  if (!chord) return std::nullopt;
  const bool leaves = chord->enters < 0.0;
  const double distance = leaves ? chord->leaves : chord->enters;
  if (!(distance >= 0.0 && distance <= ray.max_distance)) return std::nullopt;
  const Vec3 normal = (ray.origin + distance * ray.direction).normalized();
  RayHit hit = hit_at(ray, distance, radius_ * normal, normal);
  hit.from_inside = leaves;
  return hit;
}

std::optional<SurfacePoint> SphereSurface::closest_point(const Vec3& query, double max_distance,
                                                         SurfaceHint& /*hint*/) const noexcept {
  if (!is_query(query, max_distance)) return std::nullopt;
  const double from_centre = query.stableNorm();
  const double signed_distance = from_centre - radius_;
  if (!std::isfinite(from_centre) || std::abs(signed_distance) > max_distance) return std::nullopt;
  // At the centre every direction is as good.
  const Vec3 normal = from_centre > 0.0 ? query.stableNormalized() : Vec3::UnitY();
  return SurfacePoint{radius_ * normal, normal, signed_distance};
}

std::optional<SurfaceBounds> SphereSurface::bounds() const noexcept {
  return SurfaceBounds{Vec3::Constant(-radius_), Vec3::Constant(radius_)};
}

Object::Object(const Surface& surface, const Placement& placement, std::uint64_t instance)
    : surface_(&surface), placement_(placement), instance_(instance) {
  if (!std::isfinite(placement_.scale) || placement_.scale < 0.0) placement_.scale = 0.0;
  // Bit for bit as it is where rounding alone is off; and no number is none of a rotation.
  Quat& rotation = placement_.pose.rotation;
  if (std::abs(rotation.squaredNorm() - 1.0) > kNormalized) rotation.normalize();
}

std::optional<RayHit> Object::first_hit(const Ray& ray_world) const noexcept {
  if (placement_.scale == 0.0) return std::nullopt;
  const Ray ray_local{placement_.to_local(ray_world.origin),
                      placement_.pose.rotation.conjugate() * ray_world.direction,
                      ray_world.max_distance / placement_.scale};
  std::optional<RayHit> hit = surface_->first_hit(ray_local);
  if (!hit) return std::nullopt;
  hit->distance *= placement_.scale;
  hit->point = placement_.to_world(hit->point);
  hit->normal = placement_.pose.rotation * hit->normal;
  return hit;
}

std::optional<SurfacePoint> Object::closest_point(const Vec3& query_world, double max_distance,
                                                  SurfaceHint& hint) const noexcept {
  if (placement_.scale == 0.0) return std::nullopt;
  std::optional<SurfacePoint> found = surface_->closest_point(
      placement_.to_local(query_world), max_distance / placement_.scale, hint);
  if (!found) return std::nullopt;
  found->point = placement_.to_world(found->point);
  found->normal = placement_.pose.rotation * found->normal;
  found->signed_distance *= placement_.scale;
  return found;
}

const Object& nothing() noexcept {
  static const NoSurface kNoSurface;
  static const Object kNothing(kNoSurface);
  return kNothing;
}

}  // namespace nade
