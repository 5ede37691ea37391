#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nade/mesh.h"
#include "nade/surface.h"

namespace nade {

/// A box about the origin, as the colliders of engines are; its edges and corners may be rounded.
class BoxSurface final : public Surface {
 public:
  /// `half_size_m` > 0, with the rounding; `rounding_m` from 0 to the smallest of it.
  explicit BoxSurface(const Vec3& half_size_m, double rounding_m = 0.0);

  [[nodiscard]] std::optional<RayHit> first_hit(const Ray& ray) const noexcept override;
  [[nodiscard]] std::optional<SurfacePoint> closest_point(
      const Vec3& query, double max_distance, SurfaceHint& hint) const noexcept override;
  [[nodiscard]] std::uint64_t shape() const noexcept override { return shape_; }
  [[nodiscard]] std::optional<SurfaceBounds> bounds() const noexcept override;

 private:
  Vec3 core_;  ///< half the size of the box that the rounding goes around
  double rounding_;
  std::uint64_t shape_;
};

/// A cylinder about the Y axis, its middle in the origin; its rims may be rounded.
class CylinderSurface final : public Surface {
 public:
  /// `half_height_m` and `radius_m` > 0, with the rounding; `rounding_m` from 0 to the smaller.
  CylinderSurface(double half_height_m, double radius_m, double rounding_m = 0.0);

  [[nodiscard]] std::optional<RayHit> first_hit(const Ray& ray) const noexcept override;
  [[nodiscard]] std::optional<SurfacePoint> closest_point(
      const Vec3& query, double max_distance, SurfaceHint& hint) const noexcept override;
  [[nodiscard]] std::uint64_t shape() const noexcept override { return shape_; }
  [[nodiscard]] std::optional<SurfaceBounds> bounds() const noexcept override;

 private:
  Eigen::Vector2d core_;  ///< radius and half height of what the rounding goes around
  double rounding_;
  std::uint64_t shape_;
};

/// A capsule along Y: what is within `radius_m` > 0 of a line of `length_m` >= 0 between the
/// middles of its ends.
[[nodiscard]] CylinderSurface capsule_surface(double length_m, double radius_m);

/// An ellipsoid about the origin: what a ball becomes that is scaled differently along its axes.
class EllipsoidSurface final : public Surface {
 public:
  /// `half_axes_m` > 0.
  explicit EllipsoidSurface(const Vec3& half_axes_m);

  [[nodiscard]] std::optional<RayHit> first_hit(const Ray& ray) const noexcept override;
  [[nodiscard]] std::optional<SurfacePoint> closest_point(
      const Vec3& query, double max_distance, SurfaceHint& hint) const noexcept override;
  [[nodiscard]] std::uint64_t shape() const noexcept override { return shape_; }
  [[nodiscard]] std::optional<SurfaceBounds> bounds() const noexcept override;

 private:
  Vec3 half_axes_;
  std::uint64_t shape_;
};

/// A flat plate, as the planes of a room come: its top the part of the plane y = 0 within an
/// outline, solid for a thickness below it. A query looks at every corner of the outline.
class PlateSurface final : public Surface {
 public:
  /// The outline's corners are x and z, metres, in either order around; at least 3, of an area
  /// above 0, inward ones allowed, crossing itself not. `thickness_m` > 0.
  PlateSurface(std::span<const Eigen::Vector2d> outline_m, double thickness_m);

  [[nodiscard]] std::optional<RayHit> first_hit(const Ray& ray) const noexcept override;
  [[nodiscard]] std::optional<SurfacePoint> closest_point(
      const Vec3& query, double max_distance, SurfaceHint& hint) const noexcept override;
  [[nodiscard]] std::uint64_t shape() const noexcept override { return shape_; }
  [[nodiscard]] std::optional<SurfaceBounds> bounds() const noexcept override;

 private:
  std::vector<Eigen::Vector2d> outline_;  ///< the solid to the left of each side
  double thickness_;
  std::uint64_t shape_;
};

/// The smallest convex solid with all points in it, for `MeshSurface::build`. Refuses fewer than
/// four points, points that are not finite, and points in a plane. Time grows as the number of
/// points times that of the faces.
[[nodiscard]] Result<TriangleSoup> convex_hull(std::span<const Eigen::Vector3f> points);

/// A height field, for `MeshSurface::build`, which takes it for a sheet: heights (Y, metres) row by
/// row (+Z), each from -X to +X, `step_m` > 0 apart, about the origin. Refuses fewer than 2 columns
/// or rows, and another number of heights than columns times rows.
[[nodiscard]] Result<TriangleSoup> height_field(std::span<const float> heights, std::size_t columns,
                                                double step_m);

/// A mesh scaled differently along its axes, none of them 0; a mirrored one keeps its outside.
[[nodiscard]] TriangleSoup scaled(TriangleSoup soup, const Vec3& scale);

}  // namespace nade
