#pragma once

#include <cstddef>
#include <span>

#include "nade/surface.h"

namespace nade {

/// Skin that lies in an object: the surface's nearest point, and how far the skin is beyond it.
struct DentSpot {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitY();  ///< unit, out of the solid
  double depth_m = 0.0;
};

/// How a soft object gives way. Lengths in the frame of the vertices.
struct DentOptions {
  /// It is pressed in whole so far about a spot, metres, >= 0: as long as the mesh's edges there,
  /// or triangles would still cut through the skin.
  double plateau_m = 0.006;
  /// And not at all from here on, metres, above `plateau_m`.
  double falloff_m = 0.03;
  double deepest_m = 0.03;  ///< skin that lies deeper is not followed farther than this
};

/// Finds the skin that lies in an object, no deeper than 5 cm. World coordinates. `spots` has room
/// for as many as there is skin; gives how many there are.
[[nodiscard]] std::size_t find_dent_spots(const Object& object,
                                          std::span<const Eigen::Vector3f> skin,
                                          std::span<DentSpot> spots) noexcept;

/// The object's vertices, pressed in smoothly under the skin, against the normals of the spots;
/// those farther from every spot than the falloff stay bit for bit. All in one frame. `dented` is
/// as long as `vertices`, and may be the same. Does not allocate.
void dent(std::span<const DentSpot> spots, const DentOptions& options,
          std::span<const Eigen::Vector3f> vertices, std::span<Eigen::Vector3f> dented) noexcept;

}  // namespace nade
