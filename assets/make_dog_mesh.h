#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "make_dog_shape.h"

namespace dog {

/// Triangles over shared vertices, counter-clockwise seen from outside.
struct Mesh {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// How well-shaped the triangles are.
struct Quality {
  double smallest_angle_deg;
  double smallest_angle_p01_deg;  ///< of each triangle's smallest angle, the first percentile
  double smallest_angle_p50_deg;
  double volume;           ///< cubic metres; positive where the triangles face out
  double largest_miss;     ///< metres, from a vertex to the surface it should lie on
  double worst_alignment;  ///< lowest cosine between a triangle's normal and the surface's
};

/// The surface of the body as a closed mesh of badly shaped triangles: marching tetrahedra on a
/// lattice of this spacing, which always give a manifold.
[[nodiscard]] Mesh extract_surface(const Body& body, double spacing);

/// Even triangles with edges of the length the body asks for, every vertex on its surface, the
/// topology kept.
[[nodiscard]] Mesh remesh(const Body& body, const Mesh& rough);

/// What keeps the mesh from being one closed manifold without handles; nothing where it is one.
[[nodiscard]] std::optional<std::string> topology_defect(const Mesh& mesh);

[[nodiscard]] Quality measure_quality(const Body& body, const Mesh& mesh);

}  // namespace dog
