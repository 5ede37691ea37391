#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "nade/status.h"
#include "nade/surface.h"

namespace nade {

/// Triangles as they come from a file or a program: metres, counter-clockwise seen from outside.
struct TriangleSoup {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// How a mesh tells inside from outside.
enum class MeshSolid : std::uint8_t {
  /// Clean and closed. The sign is exact, from angle-weighted pseudonormals (Baerentzen, Aanaes
  /// 2005). Where parts may overlap (their boxes do) or touch in a vertex, pseudonormals would
  /// see only the nearest wall, and the winding number is asked instead: the parts are one
  /// solid, though walls within it remain surface. One part that cuts through itself is not
  /// found out.
  closed,
  /// Holes, doubles, non-manifold edges. The sign is the generalised winding number's (Jacobson
  /// et al. 2013) against one half: right up to holes, and cut across them as a film would.
  defective,
  /// An open surface that faces mostly one way. Solid behind it; free in front and where its
  /// border is nearest.
  sheet,
};

/// What was found, and mended, in the triangles of a mesh.
struct MeshReport {
  std::size_t triangles_used = 0;
  std::size_t triangles_degenerate = 0;  ///< without area; left out
  std::size_t triangles_duplicate = 0;   ///< the same three corners again; left out
  std::size_t triangles_turned = 0;      ///< wound against their neighbours; turned
  std::size_t border_edges = 0;          ///< edges with one triangle
  std::size_t nonmanifold_edges = 0;     ///< edges with more than two
  MeshSolid solid = MeshSolid::closed;
};

/// A triangle mesh as a solid. Queries are thread-safe and do not allocate. Normals run smoothly
/// over the surface and break where faces meet at more than 40 degrees.
///
/// What a query costs is bounded, whatever the mesh: it looks at no more than 2048 nodes and leaves
/// of eight triangles, and 1024 more to tell inside from outside where a mesh is not clean. A
/// surface takes a dozen or two. Where that is not enough, as in thousands of triangles that go
/// through each other, or from the middle of a ball of a million, the answer is a point of the
/// surface that may not be the very nearest, and on a clean mesh the side is still right.
/// `HandCorrector` bounds the whole frame besides.
///
/// When it is built, vertices of equal position become one; neighbours are wound alike and parts
/// outward, but a closed part wound inward within another stays: it is a cavity.
class MeshSurface final : public Surface {
 public:
  /// Builds the search tree. Refuses a mesh without any triangle of area, with a vertex that is
  /// not finite, or with an index out of range; `name` is what the error calls the mesh.
  [[nodiscard]] static Result<std::unique_ptr<MeshSurface>> build(const TriangleSoup& soup,
                                                                  const std::string& name);
  ~MeshSurface() override;

  [[nodiscard]] std::optional<RayHit> first_hit(const Ray& ray) const noexcept override;
  [[nodiscard]] std::optional<SurfacePoint> closest_point(
      const Vec3& query, double max_distance, SurfaceHint& hint) const noexcept override;

  /// Follows a deforming object: new positions for the vertices of the soup it was built from,
  /// same order and number, all finite and within 100 diagonals of the built mesh's box from it
  /// (one that is not stays where it was: far ones would make every query slow). What is a crease,
  /// a hole or a part, and which side is out, is not decided anew: a mirror image is inside out.
  /// Does not allocate. Not while another thread queries.
  void refit(std::span<const Eigen::Vector3f> vertices) noexcept;

  /// Another after each refit, and for each mesh.
  [[nodiscard]] std::uint64_t shape() const noexcept override;
  /// Others after a refit.
  [[nodiscard]] std::optional<SurfaceBounds> bounds() const noexcept override;

  [[nodiscard]] const MeshReport& report() const;

 private:
  struct Impl;
  explicit MeshSurface(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace nade
