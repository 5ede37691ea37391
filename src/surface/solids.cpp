#include "nade/solids.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "convex_ray.h"
#include "nade/assert.h"
#include "surface_query.h"

// Based on: Eberly. Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid. 2013.

namespace nade {
namespace {

std::optional<SurfacePoint> answer(const Vec3& query, const SignedDistance& from,
                                   double max_distance) {
  if (!(std::abs(from.distance) <= max_distance)) return std::nullopt;
  return SurfacePoint{query - from.distance * from.normal, from.normal, from.distance};
}

template <int N>
struct FromBox {
  Eigen::Matrix<double, N, 1> normal;
  double distance;
};

/// Of a box of two or three dimensions with a rounding around it.
template <int N>
FromBox<N> from_box(const Eigen::Matrix<double, N, 1>& query,
                    const Eigen::Matrix<double, N, 1>& core, double rounding) {
  const Eigen::Matrix<double, N, 1> off = query - query.cwiseMax(-core).cwiseMin(core);
  const double length = off.stableNorm();
  if (length > 0.0) return {off / length, length - rounding};
  Eigen::Index axis = 0;
  const double depth = (core - query.cwiseAbs()).minCoeff(&axis);
  Eigen::Matrix<double, N, 1> normal = Eigen::Matrix<double, N, 1>::Zero();
  normal[axis] = query[axis] < 0.0 ? -1.0 : 1.0;
  return {normal, -depth - rounding};
}

SignedDistance from_cylinder(const Vec3& query, const Eigen::Vector2d& core, double rounding) {
  const Eigen::Vector2d across(query.x(), query.z());
  const double radius = across.stableNorm();
  // On the axis every way out is as good.
  const Eigen::Vector2d out =
      radius > 0.0 ? Eigen::Vector2d(across / radius) : Eigen::Vector2d::UnitX();
  const auto [normal, distance] = from_box<2>({radius, query.y()}, core, rounding);
  return {distance, Vec3(normal.x() * out.x(), normal.y(), normal.x() * out.y())};
}

/// The nearest point x of an ellipsoid has x_i = r_i y_i / (t + r_i - 1), where r_i are the
/// squared half axes as multiples of the least, and t is the one that puts x on it.
SurfacePoint nearest_on_ellipsoid(const Vec3& query, const Vec3& half_axes) {
  constexpr int kMostSteps = 200;
  constexpr double kOffMiddle = 1e-12;  // of the least half axis: the middle has no nearest point
  Eigen::Index least = 0;
  const double least_axis = half_axes.minCoeff(&least);
  const Vec3 ratio = (half_axes / least_axis).cwiseAbs2();
  Vec3 away = query.cwiseAbs();
  away[least] = std::max(away[least], kOffMiddle * least_axis);
  const Vec3 share = away.cwiseQuotient(half_axes);
  // From where one axis alone would do: the sum is convex and falls, so no step passes its root.
  double t = (ratio.cwiseProduct(share - Vec3::Ones()) + Vec3::Ones()).maxCoeff();
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::Array3d below = t + ratio.array() - 1.0;
    const Eigen::Array3d part = (ratio.array() * share.array() / below).square();
    const double excess = part.sum() - 1.0;
    const double next = t + excess / (2.0 * part / below).sum();
    if (!(next > t)) break;
    t = next;
  }
  Vec3 point = (ratio.array() * away.array() / (t + ratio.array() - 1.0)).matrix();
  point /= point.cwiseQuotient(half_axes).norm();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (std::signbit(query[axis])) point[axis] = -point[axis];
  }
  const Vec3 normal = point.cwiseQuotient(half_axes.cwiseAbs2()).normalized();
  const double distance = (query - point).stableNorm();
  return {point, normal, share.squaredNorm() < 1.0 ? -distance : distance};
}

}  // namespace

BoxSurface::BoxSurface(const Vec3& half_size_m, double rounding_m)
    : core_(half_size_m.array() - rounding_m), rounding_(rounding_m), shape_(new_shape()) {
  NADE_ASSERT(half_size_m.allFinite() && half_size_m.minCoeff() > 0.0);
  NADE_ASSERT(rounding_m >= 0.0 && rounding_m <= half_size_m.minCoeff());
}

std::optional<RayHit> BoxSurface::first_hit(const Ray& ray) const noexcept {
  if (!is_query(ray)) return std::nullopt;
  return convex_hit(ray, core_.norm() + rounding_, [this](const Vec3& point) -> SignedDistance {
    const auto [normal, distance] = from_box<3>(point, core_, rounding_);
    return {distance, normal};
  });
}

std::optional<SurfacePoint> BoxSurface::closest_point(const Vec3& query, double max_distance,
                                                      SurfaceHint& /*hint*/) const noexcept {
  if (!is_query(query, max_distance)) return std::nullopt;
  const auto [normal, distance] = from_box<3>(query, core_, rounding_);
  return answer(query, {distance, normal}, max_distance);
}

std::optional<SurfaceBounds> BoxSurface::bounds() const noexcept {
  const Vec3 half = core_ + Vec3::Constant(rounding_);
  return SurfaceBounds{-half, half};
}

CylinderSurface::CylinderSurface(double half_height_m, double radius_m, double rounding_m)
    : core_(radius_m - rounding_m, half_height_m - rounding_m),
      rounding_(rounding_m),
      shape_(new_shape()) {
  NADE_ASSERT(std::isfinite(half_height_m) && half_height_m > 0.0);
  NADE_ASSERT(std::isfinite(radius_m) && radius_m > 0.0);
  NADE_ASSERT(rounding_m >= 0.0 && core_.minCoeff() >= 0.0);
}

std::optional<RayHit> CylinderSurface::first_hit(const Ray& ray) const noexcept {
  if (!is_query(ray)) return std::nullopt;
  return convex_hit(ray, core_.norm() + rounding_,
                    [this](const Vec3& point) { return from_cylinder(point, core_, rounding_); });
}

std::optional<SurfacePoint> CylinderSurface::closest_point(const Vec3& query, double max_distance,
                                                           SurfaceHint& /*hint*/) const noexcept {
  if (!is_query(query, max_distance)) return std::nullopt;
  return answer(query, from_cylinder(query, core_, rounding_), max_distance);
}

std::optional<SurfaceBounds> CylinderSurface::bounds() const noexcept {
  const Vec3 half = Vec3(core_.x(), core_.y(), core_.x()) + Vec3::Constant(rounding_);
  return SurfaceBounds{-half, half};
}

CylinderSurface capsule_surface(double length_m, double radius_m) {
  return {0.5 * length_m + radius_m, radius_m, radius_m};
}

EllipsoidSurface::EllipsoidSurface(const Vec3& half_axes_m)
    : half_axes_(half_axes_m), shape_(new_shape()) {
  NADE_ASSERT(half_axes_m.allFinite() && half_axes_m.minCoeff() > 0.0);
}

std::optional<RayHit> EllipsoidSurface::first_hit(const Ray& ray) const noexcept {
  if (!is_query(ray)) return std::nullopt;
  // Where the ellipsoid is a ball of radius 1.
  const Vec3 origin = ray.origin.cwiseQuotient(half_axes_);
  const Vec3 direction = ray.direction.cwiseQuotient(half_axes_);
  const double speed = direction.norm();
  const std::optional<Chord> chord = chord_in_ball(origin, direction / speed, 1.0);
  if (!chord) return std::nullopt;
  const bool leaves = chord->enters < 0.0;
  const double distance = (leaves ? chord->leaves : chord->enters) / speed;
  if (!(distance >= 0.0 && distance <= ray.max_distance)) return std::nullopt;
  const Vec3 on_ball = (origin + distance * direction).normalized();
  return RayHit{distance, on_ball.cwiseProduct(half_axes_),
                on_ball.cwiseQuotient(half_axes_).normalized(), leaves};
}

std::optional<SurfacePoint> EllipsoidSurface::closest_point(const Vec3& query, double max_distance,
                                                            SurfaceHint& /*hint*/) const noexcept {
  if (!is_query(query, max_distance)) return std::nullopt;
  const SurfacePoint nearest = nearest_on_ellipsoid(query, half_axes_);
  const bool found =
      nearest.normal.allFinite() && std::abs(nearest.signed_distance) <= max_distance;
  return found ? std::optional(nearest) : std::nullopt;
}

std::optional<SurfaceBounds> EllipsoidSurface::bounds() const noexcept {
  return SurfaceBounds{-half_axes_, half_axes_};
}

}  // namespace nade
