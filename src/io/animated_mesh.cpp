#include "nade/io/animated_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "gltf_accessor.h"
#include "gltf_animation.h"
#include "gltf_rig.h"
#include "nade/assert.h"

// Based on: The Khronos Group. glTF 2.0 Specification. 2021 (skins, morph targets).

namespace nade {
namespace {

using gltf::Matrix34f;
using Vec3f = Eigen::Vector3f;
using Matrix = Eigen::Matrix4d;

Error bad_file(const std::string& path, std::string_view problem) {
  return {ErrorCode::bad_format, fmt::format("{}: {}", path, problem)};
}

Result<std::size_t> find_animation(const tinygltf::Model& model, const std::string& path,
                                   std::string_view name) {
  std::string known;
  for (std::size_t i = 0; i < model.animations.size(); ++i) {
    if (name.empty() || model.animations[i].name == name) return i;
    known += (known.empty() ? "" : ", ") + model.animations[i].name;
  }
  if (known.empty()) return bad_file(path, "expected an animation, found none");
  return Error{ErrorCode::out_of_range,
               fmt::format("{}: no animation '{}': expected one of {}", path, name, known)};
}

}  // namespace

struct AnimatedMesh::Impl {
  gltf::Rig rig;
  std::vector<gltf::Track> tracks;
  std::vector<Matrix> worlds;  ///< room: of the nodes
  std::size_t vertex_count = 0;
  double duration_s = 0.0;

  void move_nodes(double time_s) noexcept {
    for (const gltf::Track& track : tracks) {
      gltf::Node& node = rig.nodes[track.node];
      switch (track.property) {
        case gltf::Property::translation:
          track.at(time_s, {node.translation.data(), 3});
          break;
        case gltf::Property::rotation:
          track.at(time_s, {node.rotation.coeffs().data(), 4});
          break;
        case gltf::Property::scale:
          track.at(time_s, {node.scale.data(), 3});
          break;
        case gltf::Property::weights:
          track.at(time_s, node.weights);
          break;
      }
    }
    for (const std::size_t i : rig.order) {
      const gltf::Node& node = rig.nodes[i];
      worlds[i] = node.local();
      if (node.parent) worlds[i] = worlds[*node.parent] * worlds[i];
    }
    for (gltf::Skin& skin : rig.skins) {
      for (std::size_t k = 0; k < skin.joints.size(); ++k) {
        const Matrix bone = worlds[skin.joints[k]] * skin.inverse_binds[k];
        skin.bones[k] = bone.topRows<3>().cast<float>();
      }
    }
  }

  static void morph(const gltf::Piece& piece, const gltf::Node& node,
                    std::span<Vec3f> vertices) noexcept {
    std::copy(piece.positions.begin(), piece.positions.end(), vertices.begin());
    for (std::size_t t = 0; t < piece.targets.size(); ++t) {
      const auto weight = static_cast<float>(node.weights[t]);
      if (weight == 0.0F || piece.targets[t].empty()) continue;
      for (std::size_t i = 0; i < vertices.size(); ++i) {
        vertices[i] += weight * piece.targets[t][i];
      }
    }
  }

  void carry(const gltf::Piece& piece, std::span<Vec3f> vertices) const noexcept {
    if (!piece.skin) {
      const Matrix34f world = worlds[piece.node].topRows<3>().cast<float>();
      for (Vec3f& vertex : vertices) {
        vertex = Vec3f(world.leftCols<3>() * vertex + world.col(3));
      }
      return;
    }
    const std::vector<Matrix34f>& bones = rig.skins[*piece.skin].bones;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const gltf::Carriers& carriers = piece.carriers[i];
      Matrix34f blend = carriers.weight[0] * bones[carriers.bone[0]];
      for (std::size_t k = 1; k < 4; ++k) {
        if (carriers.weight[k] != 0.0F) blend += carriers.weight[k] * bones[carriers.bone[k]];
      }
      vertices[i] = Vec3f(blend.leftCols<3>() * vertices[i] + blend.col(3));
    }
  }
};

AnimatedMesh::AnimatedMesh(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
AnimatedMesh::AnimatedMesh(AnimatedMesh&&) noexcept = default;
AnimatedMesh& AnimatedMesh::operator=(AnimatedMesh&&) noexcept = default;
AnimatedMesh::~AnimatedMesh() = default;

Result<AnimatedMesh> AnimatedMesh::load(const std::string& path, std::string_view animation) {
  const Result<tinygltf::Model> model = gltf::read_model(path);
  if (!model) return model.error();
  const Result<std::size_t> chosen = find_animation(*model, path, animation);
  if (!chosen) return chosen.error();
  Result<gltf::Rig> rig = gltf::read_rig(*model, path);
  if (!rig) return rig.error();
  std::vector<std::size_t> morph_targets;
  for (const gltf::Node& node : rig->nodes) morph_targets.push_back(node.weights.size());
  const tinygltf::Animation& played = model->animations[*chosen];
  Result<std::vector<gltf::Track>> tracks = gltf::read_tracks(*model, path, played, morph_targets);
  if (!tracks) return tracks.error();
  auto impl = std::make_unique<Impl>();
  for (const gltf::Track& track : *tracks) {
    impl->duration_s = std::max(impl->duration_s, double{track.times.back()});
  }
  if (!(impl->duration_s > 0.0)) {
    return bad_file(
        path, fmt::format("animation '{}': expected it to last longer than 0 s", played.name));
  }
  impl->rig = std::move(*rig);
  impl->tracks = std::move(*tracks);
  impl->worlds.resize(impl->rig.nodes.size(), Matrix::Identity());
  for (const gltf::Piece& piece : impl->rig.pieces) impl->vertex_count += piece.positions.size();
  return AnimatedMesh(std::move(impl));
}

std::size_t AnimatedMesh::vertex_count() const { return impl_->vertex_count; }
double AnimatedMesh::duration_s() const { return impl_->duration_s; }

void AnimatedMesh::sample(double time_s, std::span<Vec3f> vertices) noexcept {
  NADE_ASSERT(vertices.size() == impl_->vertex_count);
  double time = std::isfinite(time_s) ? std::fmod(time_s, impl_->duration_s) : 0.0;
  if (time < 0.0) time += impl_->duration_s;
  impl_->move_nodes(time);
  std::size_t first = 0;
  for (const gltf::Piece& piece : impl_->rig.pieces) {
    const std::span<Vec3f> part = vertices.subspan(first, piece.positions.size());
    Impl::morph(piece, impl_->rig.nodes[piece.node], part);
    impl_->carry(piece, part);
    first += part.size();
  }
}

}  // namespace nade
