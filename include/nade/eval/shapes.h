#pragma once

#include <string>

#include "nade/io/mesh_file.h"
#include "nade/io/object_file.h"
#include "nade/mesh.h"

namespace nade {

/// A box about the origin, 12 triangles. Sizes above 0, metres.
[[nodiscard]] TriangleSoup box_soup(const Vec3& half_size_m);

/// Half a ball's shell of even thickness, open to +Y, its lowest inner point at the origin.
/// `rings` for each of its two faces, at least 2; `sectors` at least 3.
struct BowlSize {
  double inner_radius_m = 0.15;
  double thickness_m = 0.008;
  std::uint32_t sectors = 128;
  std::uint32_t rings = 32;
};
[[nodiscard]] TriangleSoup bowl_soup(const BowlSize& size = {});

/// A rod along Y about the origin with round ends, `length_m` >= 0 between their middles: a ball
/// where that is 0. `radius_m` > 0.
[[nodiscard]] TriangleSoup capsule_soup(double radius_m, double length_m);

/// A beaker open to +Y whose foot stands on y = 0 about the origin; all > 0, the wall (and bottom)
/// thinner than radius and height.
[[nodiscard]] TriangleSoup cup_soup(double radius_m, double height_m, double wall_m);

/// An open bowl to be stroked inside: "bottom".
[[nodiscard]] MeshFile bowl_shape();

/// A board of 400 x 10 x 300 mm, its upper side at y = 0: "top".
[[nodiscard]] MeshFile board_shape();

/// A box of 400 x 200 x 300 mm, its upper side at y = 0, with an edge along X through the origin:
/// "across", where a stroke leaves over the edge, and "along", where the hand lies on it.
[[nodiscard]] MeshFile box_shape();

/// Triangles with places as an object by the name `spec`. The error is that of MeshSurface::build.
[[nodiscard]] Result<LoadedObject> shape_object(const std::string& spec, MeshFile shape);

}  // namespace nade
