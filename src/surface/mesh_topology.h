#pragma once

#include <span>
#include <vector>

#include "nade/mesh.h"
#include "triangle_tree.h"

namespace nade::detail {

/// In `MeshTopology::neighbours`.
inline constexpr std::uint32_t kBorder = 0xffffffff;       ///< no triangle on the other side
inline constexpr std::uint32_t kNonManifold = 0xfffffffe;  ///< several, or one wound against it
[[nodiscard]] constexpr bool is_triangle(std::uint32_t neighbour) {
  return neighbour < kNonManifold;
}

/// Triangles over welded vertices, without the useless ones.
struct WeldedMesh {
  std::vector<std::uint32_t> source;  ///< for each vertex, which of the soup's it is
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Corners> triangles;
};

/// Joins vertices of equal position and drops degenerate and duplicate triangles, counting them.
[[nodiscard]] WeldedMesh weld(const TriangleSoup& soup, MeshReport& report);

/// Keeps triangles in the order given, and vertices in the order in which these use them.
void reorder(WeldedMesh& mesh, std::span<const std::uint32_t> order);

/// Whose sign a mesh follows.
enum class SignRule : std::uint8_t { pseudonormal, winding, sheet };

struct MeshTopology {
  /// For each triangle, what lies across its edges 0-1, 1-2, 2-0.
  std::vector<Corners> neighbours;
  SignRule sign = SignRule::pseudonormal;
};

/// Winds neighbours alike and components outward (turning triangles of `mesh`), and decides how
/// inside is told from outside.
[[nodiscard]] MeshTopology orient(WeldedMesh& mesh, MeshReport& report);

}  // namespace nade::detail
