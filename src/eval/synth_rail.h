#pragma once

#include <functional>
#include <vector>

#include "nade/geometry.h"
#include "nade/surface.h"

namespace nade {

/// A point of a stroke's pattern on flat paper, metres: `aside` along the place's X, `forward`
/// along its -Z.
struct PatternPoint {
  double aside = 0.0;
  double forward = 0.0;
};

/// A stroke's pattern, from 0 to 1; outside, where it goes on.
using Pattern = std::function<PatternPoint(double)>;

/// How far the surface lets a hand go from a place before it turns away, metres.
struct PlaceExtent {
  double forward = 0.0;
  double aside = 0.0;
};

/// The surface about a place, as a hand that strokes it sees it.
class StrokePatch {
 public:
  /// `place` is in world coordinates, on the surface, +Y out of it.
  StrokePatch(const Object& object, const Pose& place) : object_(object), place_(place) {}

  [[nodiscard]] PlaceExtent extent() const;

  /// The surface point that lies `point` away from the place, walking straight on.
  [[nodiscard]] Vec3 walk(const PatternPoint& point) const;

  /// The surface's normal averaged over a palm's breadth.
  [[nodiscard]] Vec3 broad_normal(const Vec3& point) const;

  /// Heading as at the place, turned the shortest way so that +Y is `normal`.
  [[nodiscard]] Quat heading(const Vec3& normal) const;

  /// The point `depth_m` below `point` of the surface, against `normal`: at that signed distance
  /// where the object is thick enough.
  [[nodiscard]] Vec3 sunk(const Vec3& point, const Vec3& normal, double depth_m) const;

 private:
  [[nodiscard]] double reach(const PatternPoint& way) const;

  Object object_;
  Pose place_;
};

/// Where the palm's skin and the hand's frame are along a stroke: smooth, twice differentiable.
class Rail {
 public:
  /// The palm's skin, world, and the hand's rotation with +Y the surface's normal.
  struct Point {
    Vec3 skin = Vec3::Zero();
    Quat rotation = Quat::Identity();
  };

  /// The pattern laid onto the patch at a depth.
  Rail(const StrokePatch& patch, const Pattern& pattern, double depth_m);

  /// `x` from 0 to 1.
  [[nodiscard]] Point at(double x) const;

  /// How far a point goes from 0 to 1 that is fixed to the hand, `offset` from the palm's skin in
  /// the hand's frame.
  [[nodiscard]] double length(const Vec3& offset_hand) const;

 private:
  std::vector<Point> knots_;
};

}  // namespace nade
