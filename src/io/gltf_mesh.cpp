#include <fmt/format.h>

#include <optional>
#include <string_view>
#include <utility>

#include "gltf_animation.h"
#include "gltf_document.h"
#include "gltf_resource.h"
#include "gltf_rig.h"
#include "mesh_formats.h"

namespace nade::io {
namespace {

constexpr std::string_view kPlacePrefix = "place-";

std::optional<MeshPlace> place_of(const tinygltf::Node& node, const Eigen::Matrix4d& world) {
  if (node.mesh >= 0 || !node.name.starts_with(kPlacePrefix)) return std::nullopt;
  const Vec3 up = world.block<3, 1>(0, 1);
  const Vec3 back = world.block<3, 1>(0, 2);
  const Vec3 right = up.cross(back);
  if (!world.allFinite() || !(right.norm() > 0.0)) return std::nullopt;
  // Up is what matters most, so it is kept and the stroke's way made square to it.
  Eigen::Matrix3d axes;
  axes.col(0) = right.normalized();
  axes.col(1) = up.normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  MeshPlace place;
  place.name = node.name.substr(kPlacePrefix.size());
  place.pose = {world.block<3, 1>(0, 3), Quat(axes).normalized()};
  return place;
}

const std::string& name_of(const tinygltf::Model& model, const gltf::Piece& piece) {
  const std::string& name = model.meshes[piece.mesh].name;
  return name.empty() ? model.nodes[piece.node].name : name;
}

}  // namespace

Result<MeshFile> read_gltf(const std::string& path) {
  const Result<tinygltf::Model> model = gltf::read_model(path);
  if (!model) return model.error();
  Result<gltf::Rig> rig = gltf::read_rig(*model, path);
  if (!rig) return rig.error();
  MeshFile file;
  file.soup.vertices.resize(rig->vertex_count());
  gltf::pose_vertices(*rig, file.soup.vertices);
  std::uint32_t first = 0;
  for (const gltf::Piece& piece : rig->pieces) {
    for (const auto& [a, b, c] : gltf::triangles_of(*rig, piece)) {
      file.soup.triangles.push_back({first + a, first + b, first + c});
    }
    if (piece.primitive == 0) file.parts.push_back({name_of(*model, piece), 0, 0});
    file.parts.back().vertices += piece.positions.size();
    file.parts.back().triangles += piece.triangles.size();
    first += static_cast<std::uint32_t>(piece.positions.size());
  }
  file.animations = gltf::animations_of(*model);
  for (const std::size_t i : rig->shown) {
    const tinygltf::Node& node = model->nodes[i];
    if (node.mesh >= 0 && node.extensions.count(std::string(gltf::kInstancing)) > 0) {
      file.warnings.push_back(
          fmt::format("{}: node '{}' is there once: {}, which repeats it, is not read", path,
                      gltf::shortened(node.name), gltf::kInstancing));
    }
    if (auto place = place_of(node, rig->worlds[i])) {
      file.places.push_back(std::move(*place));
    }
  }
  return file;
}

}  // namespace nade::io
