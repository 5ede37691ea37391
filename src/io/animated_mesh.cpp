#include "nade/io/animated_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "gltf_accessor.h"
#include "gltf_animation.h"
#include "gltf_resource.h"
#include "gltf_rig.h"

namespace nade {
namespace {

Error bad_file(const std::string& path, std::string_view problem) {
  return {ErrorCode::bad_format, fmt::format("{}: {}", path, problem)};
}

/// The names of some animations, for a sentence.
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 20;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) {
    text += (i == 0 ? "" : ", ") + gltf::shortened(names[i]);
  }
  return names.size() > kMost ? text + ", …" : text;
}

Result<std::size_t> find_animation(const tinygltf::Model& model, const std::string& path,
                                   std::string_view name) {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < model.animations.size(); ++i) {
    if (name.empty() || model.animations[i].name == name) return i;
    known.push_back(model.animations[i].name);
  }
  if (known.empty()) return bad_file(path, "expected an animation, found none");
  return Error{ErrorCode::out_of_range,
               fmt::format("{}: no animation '{}': expected one of {}", path, name, listed(known))};
}

/// Said where the chosen animation has one moment only.
std::string standing(const tinygltf::Model& model, const std::string& path, std::size_t chosen) {
  std::vector<std::string> others;
  for (const MeshAnimation& other : gltf::animations_of(model)) {
    if (other.duration_s > 0.0 && !other.name.empty()) others.push_back(other.name);
  }
  const std::string sentence =
      fmt::format("{}: animation '{}' has one moment only, so it stands still", path,
                  gltf::shortened(model.animations[chosen].name));
  return others.empty() ? sentence : fmt::format("{}; others: {}", sentence, listed(others));
}

}  // namespace

struct AnimatedMesh::Impl {
  gltf::Rig rig;
  std::vector<gltf::Track> tracks;
  double duration_s = 0.0;
  std::string warning;

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
  if (!(impl->duration_s > 0.0)) impl->warning = standing(*model, path, *chosen);
  impl->rig = std::move(*rig);
  impl->tracks = std::move(*tracks);
  return AnimatedMesh(std::move(impl));
}

std::size_t AnimatedMesh::vertex_count() const { return impl_->rig.vertex_count(); }
double AnimatedMesh::duration_s() const { return impl_->duration_s; }
const std::string& AnimatedMesh::warning() const { return impl_->warning; }

void AnimatedMesh::sample(double time_s, std::span<Eigen::Vector3f> vertices) noexcept {
  const bool moves = std::isfinite(time_s) && impl_->duration_s > 0.0;
  double time = moves ? std::fmod(time_s, impl_->duration_s) : 0.0;
  if (time < 0.0) time += impl_->duration_s;
  impl_->move_nodes(time);
  gltf::pose_vertices(impl_->rig, vertices);
}

}  // namespace nade
