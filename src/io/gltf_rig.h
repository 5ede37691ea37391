#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gltf_accessor.h"
#include "nade/geometry.h"

namespace nade::gltf {

/// The upper three rows of a transform.
using Matrix34f = Eigen::Matrix<float, 3, 4>;

/// A node's own transform, as the animation has it.
struct Node {
  Vec3 translation = Vec3::Zero();
  Quat rotation = Quat::Identity();
  Vec3 scale = Vec3::Ones();
  std::optional<Eigen::Matrix4d> fixed;  ///< given as a matrix, which cannot be animated
  std::optional<std::size_t> parent;
  std::vector<double> weights;  ///< of its mesh's morph targets

  [[nodiscard]] Eigen::Matrix4d local() const {
    if (fixed) return *fixed;
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.topLeftCorner<3, 3>() = rotation.toRotationMatrix() * scale.asDiagonal();
    matrix.topRightCorner<3, 1>() = translation;
    return matrix;
  }
};

struct Skin {
  std::vector<std::size_t> joints;  ///< nodes
  std::vector<Eigen::Matrix4d> inverse_binds;
  std::vector<Matrix34f> bones;  ///< room: the joints' transforms from the bind pose
};

/// One of the bones of a vertex, whose weights have a sum of 1.
struct Carrier {
  std::uint16_t bone = 0;
  float weight = 0.0F;
};

/// One primitive where one node has it.
struct Piece {
  std::size_t node = 0;
  std::size_t mesh = 0;
  std::size_t primitive = 0;  ///< of the mesh
  std::optional<std::size_t> skin;
  std::vector<Eigen::Vector3f> positions;
  std::vector<std::vector<Eigen::Vector3f>> targets;    ///< what each morph target adds
  std::size_t carriers_each = 0;                        ///< of a vertex: 4, 8, …
  std::vector<Carrier> carriers;                        ///< of a skin, vertex after vertex
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< of its own positions
};

/// A scene's meshes, and what carries their vertices.
struct Rig {
  std::vector<Node> nodes;
  std::vector<std::size_t> order;  ///< of the nodes, parents first
  std::vector<std::size_t> shown;  ///< the scene's nodes that are visible, in its order
  std::vector<Skin> skins;
  std::vector<Piece> pieces;
  std::vector<Eigen::Matrix4d> worlds;  ///< room: of the nodes

  [[nodiscard]] std::size_t vertex_count() const;
};

/// A piece's triangles as they are seen: a mirroring node or bone turns them inside out. Of a posed
/// rig.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> triangles_of(const Rig& rig,
                                                                     const Piece& piece);

/// Where a rig's nodes, bones and morph weights put its vertices, piece after piece; `vertices`
/// holds `vertex_count()`. Does not allocate.
void pose_vertices(Rig& rig, std::span<Eigen::Vector3f> vertices) noexcept;

/// Reads a model's nodes, skins and its first scene's meshes with their morph targets.
[[nodiscard]] Result<Rig> read_rig(const tinygltf::Model& model, const std::string& path);

}  // namespace nade::gltf
