#include "gltf_rig.h"

#include <algorithm>
#include <utility>

#include "nade/assert.h"

// Based on: The Khronos Group. glTF 2.0 Specification. 2021 (skins, morph targets).

namespace nade::gltf {
namespace {

using Vec3f = Eigen::Vector3f;
using Matrix = Eigen::Matrix4d;

void place_nodes(Rig& rig) noexcept {
  for (const std::size_t i : rig.order) {
    const Node& node = rig.nodes[i];
    rig.worlds[i] = node.local();
    if (node.parent) rig.worlds[i] = rig.worlds[*node.parent] * rig.worlds[i];
  }
  for (Skin& skin : rig.skins) {
    for (std::size_t k = 0; k < skin.joints.size(); ++k) {
      const Matrix bone = rig.worlds[skin.joints[k]] * skin.inverse_binds[k];
      skin.bones[k] = bone.topRows<3>().cast<float>();
    }
  }
}

void morph(const Piece& piece, const Node& node, std::span<Vec3f> vertices) noexcept {
  std::copy(piece.positions.begin(), piece.positions.end(), vertices.begin());
  for (std::size_t t = 0; t < piece.targets.size(); ++t) {
    const auto weight = static_cast<float>(node.weights[t]);
    if (weight == 0.0F || piece.targets[t].empty()) continue;
    for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i] += weight * piece.targets[t][i];
  }
}

/// What carries a vertex of a skin.
Matrix34f blended_bones(const Rig& rig, const Piece& piece, std::size_t vertex) noexcept {
  const std::vector<Matrix34f>& bones = rig.skins[*piece.skin].bones;
  const Carrier* const carriers = piece.carriers.data() + piece.carriers_each * vertex;
  Matrix34f blend = carriers[0].weight * bones[carriers[0].bone];
  for (std::size_t k = 1; k < piece.carriers_each; ++k) {
    if (carriers[k].weight != 0.0F) blend += carriers[k].weight * bones[carriers[k].bone];
  }
  return blend;
}

void carry(const Rig& rig, const Piece& piece, std::span<Vec3f> vertices) noexcept {
  if (!piece.skin) {
    const Matrix& world = rig.worlds[piece.node];
    for (Vec3f& vertex : vertices) {
      const Vec3 moved = world.topLeftCorner<3, 3>() * vertex.cast<double>();
      vertex = (moved + world.topRightCorner<3, 1>()).cast<float>();
    }
    return;
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Matrix34f blend = blended_bones(rig, piece, i);
    vertices[i] = Vec3f(blend.leftCols<3>() * vertices[i] + blend.col(3));
  }
}

/// Whether a triangle is seen from the other side where its node, or its bones, put it.
bool is_mirrored(const Rig& rig, const Piece& piece, const std::array<std::uint32_t, 3>& corners) {
  if (!piece.skin) return rig.worlds[piece.node].topLeftCorner<3, 3>().determinant() < 0.0;
  float sum = 0.0F;
  for (const std::uint32_t corner : corners) {
    sum += blended_bones(rig, piece, corner).leftCols<3>().determinant();
  }
  return sum < 0.0F;
}

}  // namespace

std::size_t Rig::vertex_count() const {
  std::size_t count = 0;
  for (const Piece& piece : pieces) count += piece.positions.size();
  return count;
}

std::vector<std::array<std::uint32_t, 3>> triangles_of(const Rig& rig, const Piece& piece) {
  auto triangles = piece.triangles;
  for (auto& corners : triangles) {
    if (is_mirrored(rig, piece, corners)) std::swap(corners[1], corners[2]);
  }
  return triangles;
}

void pose_vertices(Rig& rig, std::span<Vec3f> vertices) noexcept {
  NADE_ASSERT(vertices.size() == rig.vertex_count());
  place_nodes(rig);
  std::size_t first = 0;
  for (const Piece& piece : rig.pieces) {
    const std::span<Vec3f> part = vertices.subspan(first, piece.positions.size());
    morph(piece, rig.nodes[piece.node], part);
    carry(rig, piece, part);
    first += part.size();
  }
}

}  // namespace nade::gltf
