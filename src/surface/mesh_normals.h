#pragma once

#include <span>
#include <vector>

#include "mesh_topology.h"
#include "octahedral.h"
#include "triangle_tree.h"

namespace nade::detail {

/// Two kinds of normals. Pseudonormals tell inside from outside and nothing else. Shading
/// normals run smoothly over the surface and break at creases; they are what queries return.
class MeshNormals {
 public:
  /// `update` must follow.
  void build(const WeldedMesh& mesh, const MeshTopology& topology);

  /// After vertices have moved, in the mesh and in its tree. Creases stay where `build` found them.
  /// Does not allocate.
  void update(const WeldedMesh& mesh, const TriangleTree& tree) noexcept;

  /// Angle-weighted, not unit (Baerentzen, Aanaes 2005).
  [[nodiscard]] Eigen::Vector3d vertex_pseudonormal(std::uint32_t vertex) const {
    return vertex_pseudonormals_[vertex].cast<double>();
  }
  /// Whether the vertex ends a border edge.
  [[nodiscard]] bool on_border(std::uint32_t vertex) const { return on_border_[vertex] != 0; }

  [[nodiscard]] std::span<const Octahedral> shading() const { return packed_; }
  /// For each triangle's corners, which of `shading`.
  [[nodiscard]] std::span<const Corners> shading_of() const { return shading_index_; }

 private:
  std::vector<Eigen::Vector3f> vertex_pseudonormals_;
  std::vector<std::uint8_t> on_border_;
  std::vector<Eigen::Vector3f> shading_;       ///< room: sums of what is about each
  std::vector<std::uint32_t> shading_vertex_;  ///< whose they are
  std::vector<Octahedral> packed_;
  std::vector<Corners> shading_index_;
};

/// Not normalised: its length is twice the area.
[[nodiscard]] Eigen::Vector3d face_normal(const WeldedMesh& mesh, std::uint32_t triangle);

}  // namespace nade::detail
