#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <optional>

#include "nade/geometry.h"

namespace nade {

/// A half-line. `direction` is of unit length; hits beyond `max_distance` do not count.
struct Ray {
  Vec3 origin = Vec3::Zero();
  Vec3 direction = Vec3::UnitY();
  double max_distance = std::numeric_limits<double>::infinity();
};

/// Where a ray meets a surface.
struct RayHit {
  double distance = 0.0;  ///< along the ray
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitY();  ///< unit, out of the solid, whichever side the ray came from
  bool from_inside = false;     ///< the ray leaves the solid here: normal . direction > 0
};

/// The point of a surface nearest to a query.
struct SurfacePoint {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitY();   ///< unit, out of the solid; on a crease between its faces
  double signed_distance = 0.0;  ///< of the query: negative inside the solid
};

/// What a query leaves behind to make the next, nearby one fast. Any value is correct; keep one
/// for each point that is followed from frame to frame.
struct SurfaceHint {
  static constexpr std::uint32_t kNone = 0xffffffff;
  std::uint32_t element = kNone;
};

/// A box along the axes of a surface's frame.
struct SurfaceBounds {
  Vec3 low = Vec3::Zero();
  Vec3 high = Vec3::Zero();

  /// How far a point is outside; 0 within.
  [[nodiscard]] double distance(const Vec3& point) const {
    return (point - point.cwiseMax(low).cwiseMin(high)).norm();
  }
};

/// A solid's surface, in its own frame. Implement it to bring an object of your own (a height
/// field, a distance function); queries must be thread-safe, must not allocate, and give no
/// result for a query that is not finite. One whose form may change says so by `shape`: a hand that
/// rests on it would else be left inside.
class Surface {
 public:
  virtual ~Surface() = default;

  /// The first hit along the ray, from either side.
  [[nodiscard]] virtual std::optional<RayHit> first_hit(const Ray& ray) const noexcept = 0;

  /// The nearest point within `max_distance` of the query, and the query's signed distance.
  [[nodiscard]] virtual std::optional<SurfacePoint> closest_point(
      const Vec3& query, double max_distance, SurfaceHint& hint) const noexcept = 0;

  /// Another number whenever the surface has another shape, and for one that is built in another's
  /// place in memory, so that answers are not remembered beyond it. The default is for surfaces
  /// that keep theirs.
  [[nodiscard]] virtual std::uint64_t shape() const noexcept { return 0; }

  /// A box that all of the surface is in, finite; none where there is no such box, or nobody knows.
  /// Only a `Scene` asks: of what has none it can never tell that it is out of reach.
  [[nodiscard]] virtual std::optional<SurfaceBounds> bounds() const noexcept {
    return std::nullopt;
  }
};

/// The half-space below y = 0.
class PlaneSurface final : public Surface {
 public:
  [[nodiscard]] std::optional<RayHit> first_hit(const Ray& ray) const noexcept override;
  [[nodiscard]] std::optional<SurfacePoint> closest_point(
      const Vec3& query, double max_distance, SurfaceHint& hint) const noexcept override;
};

/// A ball about the origin.
class SphereSurface final : public Surface {
 public:
  /// `radius_m` > 0.
  explicit SphereSurface(double radius_m);
  [[nodiscard]] double radius() const { return radius_; }
  [[nodiscard]] std::uint64_t shape() const noexcept override {
    return std::bit_cast<std::uint64_t>(radius_);
  }
  [[nodiscard]] std::optional<SurfaceBounds> bounds() const noexcept override;
  [[nodiscard]] std::optional<RayHit> first_hit(const Ray& ray) const noexcept override;
  [[nodiscard]] std::optional<SurfacePoint> closest_point(
      const Vec3& query, double max_distance, SurfaceHint& hint) const noexcept override;

 private:
  double radius_;
};

/// Which object it is, wherever it stands and however it deforms.
struct ObjectIdentity {
  const Surface* surface = nullptr;  ///< only its address counts
  std::uint64_t instance = 0;
  bool operator==(const ObjectIdentity&) const = default;
};

/// A surface where it stands in the world: the object the hand strokes. Does not own the
/// surface. All queries and answers are in world coordinates.
class Object {
 public:
  /// The rotation of `placement` is normalized. A scale of 0, below it or that is not finite leaves
  /// nothing to touch, and so does a pose that is not finite. `surface` must outlive the object.
  /// Objects that share one, as two chairs of a kind, are told apart by `instance`, any number:
  /// else a hand that goes over from one to the other would be on one that is suddenly elsewhere.
  explicit Object(const Surface& surface, const Placement& placement = {},
                  std::uint64_t instance = 0);
  explicit Object(const Surface&&, const Placement& = {}, std::uint64_t = 0) = delete;

  [[nodiscard]] const Surface& surface() const { return *surface_; }
  [[nodiscard]] ObjectIdentity identity() const { return {surface_, instance_}; }
  [[nodiscard]] const Placement& placement() const { return placement_; }

  [[nodiscard]] std::optional<RayHit> first_hit(const Ray& ray_world) const noexcept;
  [[nodiscard]] std::optional<SurfacePoint> closest_point(const Vec3& query_world,
                                                          double max_distance,
                                                          SurfaceHint& hint) const noexcept;

 private:
  const Surface* surface_;
  Placement placement_;
  std::uint64_t instance_;
};

/// Nothing to touch: for frames in which no object is near.
[[nodiscard]] const Object& nothing() noexcept;

}  // namespace nade
