#include <algorithm>
#include <cmath>

#include "nade/assert.h"
#include "nade/solids.h"
#include "surface_query.h"

namespace nade {
namespace {

using Vec2 = Eigen::Vector2d;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }
Vec2 from_above(const Vec3& point) { return {point.x(), point.z()}; }

double twice_area(std::span<const Vec2> outline) {
  double area = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    area += cross(outline[i] - outline[0], outline[(i + 1) % outline.size()] - outline[0]);
  }
  return area;
}

struct FromOutline {
  Vec2 normal = Vec2::UnitX();
  double distance = 0.0;  ///< below 0 within
};

/// Whether a side crosses the way from a point to +X: an odd number of them around it.
bool passes(const Vec2& point, const Vec2& a, const Vec2& b) {
  if ((a.y() > point.y()) == (b.y() > point.y())) return false;
  return cross(b - a, point - a) * (b.y() - a.y()) > 0.0;
}

FromOutline from_outline(const Vec2& point, std::span<const Vec2> outline) {
  FromOutline from;
  Vec2 nearest = Vec2::Zero();
  double least = std::numeric_limits<double>::infinity();
  bool within = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2& a = outline[i];
    const Vec2& b = outline[(i + 1) % outline.size()];
    if (passes(point, a, b)) within = !within;
    const Vec2 side = b - a;
    const double length2 = side.squaredNorm();
    const double share =
        length2 > 0.0 ? std::clamp((point - a).dot(side) / length2, 0.0, 1.0) : 0.0;
    const Vec2 off = point - (a + share * side);
    if (off.squaredNorm() >= least) continue;
    least = off.squaredNorm();
    nearest = off;
    from.normal = Vec2(side.y(), -side.x()).stableNormalized();
  }
  const double distance = nearest.stableNorm();
  from.distance = within ? -distance : distance;
  if (distance > 0.0) from.normal = nearest / from.distance;
  return from;
}

}  // namespace

PlateSurface::PlateSurface(std::span<const Vec2> outline_m, double thickness_m)
    : outline_(outline_m.begin(), outline_m.end()), thickness_(thickness_m), shape_(new_shape()) {
  const double area = twice_area(outline_);
  NADE_ASSERT(outline_.size() >= 3 && std::isfinite(area) && area != 0.0);
  NADE_ASSERT(std::isfinite(thickness_m) && thickness_m > 0.0);
  if (area < 0.0) std::reverse(outline_.begin(), outline_.end());
}

std::optional<SurfacePoint> PlateSurface::closest_point(const Vec3& query, double max_distance,
                                                        SurfaceHint& /*hint*/) const noexcept {
  if (!is_query(query, max_distance)) return std::nullopt;
  const double middle = -0.5 * thickness_;
  const double side = query.y() < middle ? -1.0 : 1.0;
  const double above = std::abs(query.y() - middle) - 0.5 * thickness_;
  const FromOutline beside = from_outline(from_above(query), outline_);
  const Vec3 up = side * Vec3::UnitY();
  const Vec3 out(beside.normal.x(), 0.0, beside.normal.y());
  SurfacePoint found;
  if (above <= 0.0 && beside.distance <= 0.0) {
    found.normal = above > beside.distance ? up : out;
    found.signed_distance = std::max(above, beside.distance);
  } else {
    const Vec3 off = std::max(above, 0.0) * up + std::max(beside.distance, 0.0) * out;
    found.signed_distance = off.stableNorm();
    found.normal = off / found.signed_distance;
  }
  if (!(std::abs(found.signed_distance) <= max_distance)) return std::nullopt;
  found.point = query - found.signed_distance * found.normal;
  return found;
}

std::optional<RayHit> PlateSurface::first_hit(const Ray& ray) const noexcept {
  if (!is_query(ray)) return std::nullopt;
  RayHit first;
  first.distance = ray.max_distance;
  bool is_hit = false;
  const auto meet = [&](double distance, const Vec3& normal) {
    if (!(distance >= 0.0 && distance <= first.distance) || !std::isfinite(distance)) return;
    is_hit = true;
    const Vec3 point = ray.origin + distance * ray.direction;
    first = {distance, point, normal, normal.dot(ray.direction) > 0.0};
  };
  for (const double height : {0.0, -thickness_}) {
    const double distance = (height - ray.origin.y()) / ray.direction.y();
    const Vec3 point = ray.origin + distance * ray.direction;
    if (!point.allFinite() || from_outline(from_above(point), outline_).distance > 0.0) continue;
    meet(distance, height == 0.0 ? Vec3::UnitY() : Vec3(-Vec3::UnitY()));
  }
  const Vec2 origin = from_above(ray.origin);
  const Vec2 direction = from_above(ray.direction);
  for (std::size_t i = 0; i < outline_.size(); ++i) {
    const Vec2& a = outline_[i];
    const Vec2 side = outline_[(i + 1) % outline_.size()] - a;
    const double facing = cross(direction, side);
    if (facing == 0.0) continue;
    const double share = cross(a - origin, direction) / facing;
    const double distance = cross(a - origin, side) / facing;
    const double height = ray.origin.y() + distance * ray.direction.y();
    if (!(share >= 0.0 && share <= 1.0 && height <= 0.0 && height >= -thickness_)) continue;
    const Vec2 out = Vec2(side.y(), -side.x()).normalized();
    meet(distance, {out.x(), 0.0, out.y()});
  }
  return is_hit ? std::optional(first) : std::nullopt;
}

std::optional<SurfaceBounds> PlateSurface::bounds() const noexcept {
  Vec2 low = outline_.front();
  Vec2 high = low;
  for (const Vec2& corner : outline_) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  return SurfaceBounds{{low.x(), -thickness_, low.y()}, {high.x(), 0.0, high.y()}};
}

}  // namespace nade
