#pragma once

// What the triangle tree is made of, and its queries. Kept apart from everything else, since it
// is compiled for more than one instruction set.

#include <cstdint>

namespace nade::detail {

/// Children of a node, and triangles of a leaf.
inline constexpr std::uint32_t kTreeWidth = 8;
/// In `TreeNode::child`: no child here.
inline constexpr std::uint32_t kNoChild = 0xffffffff;
/// In `TreeNode::child`: the rest of the number is a block's, not a node's.
inline constexpr std::uint32_t kLeafBit = 0x80000000;
/// A triangle's place: eight times its block, plus where in it.
inline constexpr std::uint32_t kNoSlot = 0xffffffff;
/// Deepest path from the root; the build sees to it that it holds.
inline constexpr std::uint32_t kTreeDepth = 64;

/// How many radii away a part must be to count as a dipole.
inline constexpr float kDipoleFar = 2.5F;

/// Nodes and blocks that a query looks at, whatever the mesh: it keeps a frame's time where
/// triangles go through each other by the thousand. A surface takes a few dozen.
inline constexpr std::uint32_t kMostSteps = 2048;
/// The same for `winding`, which looks at everything around: up to some hundred of a good mesh.
inline constexpr std::uint32_t kMostWindingSteps = 1024;

/// Up to eight child boxes, coordinate by coordinate. An unused child's box is inside out, so no
/// query enters it. Children stand behind their parent.
struct alignas(64) TreeNode {
  float side[6][kTreeWidth];  ///< low x, y, z; high x, y, z
  std::uint32_t child[kTreeWidth];
};

/// Up to eight triangles, coordinate by coordinate, and what an answer needs to know about them,
/// so that it costs no further look into memory. Unused places repeat one corner of the last
/// triangle three times: without area, at no distance that is not its own.
struct alignas(64) TriangleBlock {
  float a[3][kTreeWidth];
  float b[3][kTreeWidth];
  float c[3][kTreeWidth];
  /// Shading normals at a, b and c, on an octahedron (see `octahedral.h`).
  std::int16_t normal[3][2][kTreeWidth];
};

/// For each child of the node of the same number, what its triangles look like from afar: a
/// dipole (Barill et al. 2018).
struct alignas(64) DipoleNode {
  float centre[3][kTreeWidth];       ///< area-weighted
  float vector_area[3][kTreeWidth];  ///< sum of area x normal
  float near_squared[kTreeWidth];    ///< nearer than this it must be looked at in detail
  float area[kTreeWidth];            ///< weight of the centre
};

struct TreeHit {
  std::uint32_t slot = kNoSlot;
  float distance = 0.0F;
  std::uint32_t steps = 0;
};

struct TreeNearest {
  std::uint32_t slot = kNoSlot;
  std::uint32_t steps = 0;  ///< `kMostSteps`: of those looked at it is the nearest
};

struct TreeWinding {
  float number = 0.0F;
  std::uint32_t steps = 0;
};

struct TreeRay {
  float origin[3];
  float direction[3];
  float max_distance;
};

struct TreePoint {
  float point[3];
  float bound_squared;       ///< look only for what is nearer
  std::uint32_t hint_block;  ///< looked at first; or `kNoSlot`
};

/// The queries, compiled for one instruction set. All start at node 0.
struct TreeKernels {
  TreeHit (*first_hit)(const TreeNode*, const TriangleBlock*, const TreeRay&) noexcept;
  TreeNearest (*closest)(const TreeNode*, const TriangleBlock*, const TreePoint&) noexcept;
  TreeWinding (*winding)(const TreeNode*, const TriangleBlock*, const DipoleNode*,
                         const float (&point)[3]) noexcept;
};
[[nodiscard]] const TreeKernels& tree_kernels_baseline() noexcept;
[[nodiscard]] const TreeKernels& tree_kernels_avx2() noexcept;
/// The fastest that this processor runs.
[[nodiscard]] const TreeKernels& tree_kernels() noexcept;

}  // namespace nade::detail
