#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <span>
#include <string_view>
#include <utility>

#include "gltf_rig.h"

// Based on: The Khronos Group. glTF 2.0 Specification. 2021 (skins, morph targets).

namespace nade::gltf {
namespace {

using Vec3f = Eigen::Vector3f;
using Matrix = Eigen::Matrix4d;

Error bad_file(const std::string& path, std::string_view problem) {
  return {ErrorCode::bad_format, fmt::format("{}: {}", path, problem)};
}

/// Numbers of a file where it gives all of `Size`, else what is there already.
template <class Vector>
void take(const std::vector<double>& from, Vector& to) {
  if (from.size() != static_cast<std::size_t>(to.size())) return;
  for (std::size_t i = 0; i < from.size(); ++i) to[static_cast<Eigen::Index>(i)] = from[i];
}

Node node_of(const tinygltf::Node& from) {
  Node node;
  take(from.translation, node.translation);
  take(from.rotation, node.rotation.coeffs());
  take(from.scale, node.scale);
  if (from.matrix.size() == 16) node.fixed = Eigen::Map<const Matrix>(from.matrix.data());
  return node;
}

std::vector<Vec3f> vectors_of(const std::vector<float>& numbers) {
  std::vector<Vec3f> vectors;
  vectors.reserve(numbers.size() / 3);
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
    vectors.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  }
  return vectors;
}

int attribute(const std::map<std::string, int>& attributes, const std::string& name) {
  const auto found = attributes.find(name);
  return found == attributes.end() ? -1 : found->second;
}

/// Reads a file into nodes, skins and rig_.pieces.
class Reader {
 public:
  Reader(const tinygltf::Model& model, const std::string& path) : model_(model), path_(path) {}

  [[nodiscard]] Result<Rig> read() {
    Status status = read_nodes();
    if (status.ok()) status = read_skins();
    if (status.ok()) status = read_pieces();
    if (!status) return status.error();
    return std::move(rig_);
  }

 private:
  [[nodiscard]] Status read_nodes() {
    for (const tinygltf::Node& node : model_.nodes) rig_.nodes.push_back(node_of(node));
    for (std::size_t i = 0; i < rig_.nodes.size(); ++i) {
      for (const int child : model_.nodes[i].children) {
        const auto index = static_cast<std::size_t>(child);
        if (child < 0 || index >= rig_.nodes.size()) {
          return bad_file(path_, fmt::format("node {}: no such child {}", i, child));
        }
        if (rig_.nodes[index].parent) {
          return bad_file(path_, fmt::format("node {}: expected one parent, found two", index));
        }
        rig_.nodes[index].parent = i;
      }
    }
    for (std::size_t i = 0; i < rig_.nodes.size(); ++i) {
      if (!rig_.nodes[i].parent) rig_.order.push_back(i);
    }
    for (std::size_t i = 0; i < rig_.order.size(); ++i) {
      for (const int child : model_.nodes[rig_.order[i]].children) {
        rig_.order.push_back(static_cast<std::size_t>(child));
      }
    }
    rig_.worlds.resize(rig_.nodes.size(), Matrix::Identity());
    if (rig_.order.size() == rig_.nodes.size()) return ok_status();
    return bad_file(path_, "expected a tree of nodes, found some in a circle");
  }

  [[nodiscard]] Status read_skins() {
    for (std::size_t i = 0; i < model_.skins.size(); ++i) {
      const tinygltf::Skin& from = model_.skins[i];
      Skin skin;
      for (const int joint : from.joints) {
        if (joint < 0 || static_cast<std::size_t>(joint) >= rig_.nodes.size()) {
          return bad_file(path_, fmt::format("skin {}: no such joint {}", i, joint));
        }
        skin.joints.push_back(static_cast<std::size_t>(joint));
      }
      skin.inverse_binds.assign(skin.joints.size(), Matrix::Identity());
      skin.bones.resize(skin.joints.size());
      if (from.inverseBindMatrices >= 0) {
        const auto numbers =
            read_floats({model_, path_, "inverse bind matrices", from.inverseBindMatrices}, 16);
        if (!numbers) return numbers.error();
        if (numbers->size() < 16 * skin.joints.size()) {
          return bad_file(path_, fmt::format("skin {}: {} inverse bind matrices for {} joints", i,
                                             numbers->size() / 16, skin.joints.size()));
        }
        for (std::size_t k = 0; k < skin.joints.size(); ++k) {
          const Eigen::Map<const Eigen::Matrix4f> matrix(numbers->data() + 16 * k);
          skin.inverse_binds[k] = matrix.cast<double>();
        }
      }
      rig_.skins.push_back(std::move(skin));
    }
    return ok_status();
  }

  /// The nodes a scene starts from: all that have no parent, where the file has no scene.
  [[nodiscard]] Result<std::vector<int>> first_nodes() const {
    if (model_.scenes.empty()) {
      std::vector<int> first;
      for (std::size_t i = 0; i < rig_.nodes.size(); ++i) {
        if (!rig_.nodes[i].parent) first.push_back(static_cast<int>(i));
      }
      return first;
    }
    const auto chosen = static_cast<std::size_t>(std::max(model_.defaultScene, 0));
    if (chosen < model_.scenes.size()) return model_.scenes[chosen].nodes;
    return bad_file(path_, fmt::format("no such scene {}", chosen));
  }

  [[nodiscard]] Status read_pieces() {
    const Result<std::vector<int>> first = first_nodes();
    if (!first) return first.error();
    std::vector<int> open(first->rbegin(), first->rend());
    std::vector<bool> seen(rig_.nodes.size(), false);
    while (!open.empty()) {
      const int index = open.back();
      open.pop_back();
      if (index < 0 || static_cast<std::size_t>(index) >= rig_.nodes.size()) {
        return bad_file(path_, fmt::format("scene: no such node {}", index));
      }
      const auto at = static_cast<std::size_t>(index);
      const tinygltf::Node& node = model_.nodes[at];
      // A node that is hidden hides all below it.
      if (seen[at] || node.extensions.count("KHR_node_visibility") > 0) continue;
      seen[at] = true;
      rig_.shown.push_back(at);
      if (node.mesh >= 0) {
        const Status status = read_mesh(at);
        if (!status) return status;
      }
      open.insert(open.end(), node.children.rbegin(), node.children.rend());
    }
    return ok_status();
  }

  [[nodiscard]] Status read_mesh(std::size_t node) {
    const auto index = static_cast<std::size_t>(model_.nodes[node].mesh);
    if (index >= model_.meshes.size()) {
      return bad_file(path_, fmt::format("node {}: no such mesh {}", node, index));
    }
    const tinygltf::Mesh& mesh = model_.meshes[index];
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
      Piece piece;
      piece.node = node;
      piece.mesh = index;
      piece.primitive = i;
      const Status status = read_primitive(mesh.primitives[i], piece);
      if (!status) return status;
      if (rig_.pieces.size() == kMostPieces) {
        return bad_file(path_,
                        fmt::format("node {}: expected at most {} parts", node, kMostPieces));
      }
      std::vector<double>& weights = rig_.nodes[node].weights;
      weights.resize(std::max(weights.size(), piece.targets.size()), 0.0);
      rig_.pieces.push_back(std::move(piece));
    }
    const std::vector<double>& own = model_.nodes[node].weights;
    const std::vector<double>& given = own.empty() ? mesh.weights : own;
    std::vector<double>& weights = rig_.nodes[node].weights;
    std::copy_n(given.begin(), std::min(given.size(), weights.size()), weights.begin());
    return ok_status();
  }

  [[nodiscard]] Status read_primitive(const tinygltf::Primitive& primitive, Piece& piece) {
    const auto position = attribute(primitive.attributes, "POSITION");
    if (position < 0) return ok_status();
    const auto positions = read_floats({model_, path_, "POSITION", position}, 3);
    if (!positions) return positions.error();
    piece.positions = vectors_of(*positions);
    if (const Status status = read_triangles(primitive, piece); !status) return status;
    for (const auto& target : primitive.targets) {
      piece.targets.emplace_back();
      const int moved = attribute(target, "POSITION");
      if (moved < 0) continue;
      const auto offsets = read_floats({model_, path_, "morph target's POSITION", moved}, 3);
      if (!offsets) return offsets.error();
      piece.targets.back() = vectors_of(*offsets);
      if (piece.targets.back().size() != piece.positions.size()) {
        return bad_file(path_, fmt::format("morph target {}: expected {} vertices, found {}",
                                           piece.targets.size() - 1, piece.positions.size(),
                                           piece.targets.back().size()));
      }
    }
    const bool has_bones = attribute(primitive.attributes, "JOINTS_0") >= 0;
    if (model_.nodes[piece.node].skin < 0 || !has_bones) return ok_status();
    const auto skin = static_cast<std::size_t>(model_.nodes[piece.node].skin);
    if (skin >= rig_.skins.size()) {
      return bad_file(path_, fmt::format("node {}: no such skin {}", piece.node, skin));
    }
    piece.skin = skin;
    return read_carriers(primitive, piece);
  }

  /// Of lists, strips and fans; points and lines have none.
  [[nodiscard]] Status read_triangles(const tinygltf::Primitive& primitive, Piece& piece) const {
    const std::size_t count = piece.positions.size();
    std::vector<std::uint32_t> corners(count);
    std::iota(corners.begin(), corners.end(), 0U);
    if (primitive.indices >= 0) {
      auto indices = read_integers({model_, path_, "indices", primitive.indices}, 1);
      if (!indices) return indices.error();
      corners = std::move(*indices);
    }
    for (const std::uint32_t corner : corners) {
      if (corner < count) continue;
      return Error{ErrorCode::bad_value,
                   fmt::format("{}: mesh {}: expected vertices below {}, found {}", path_,
                               model_.nodes[piece.node].mesh, count, corner)};
    }
    const bool strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
    const bool fan = primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
    const bool list = primitive.mode == TINYGLTF_MODE_TRIANGLES || primitive.mode == -1;
    if (!strip && !fan && !list) return ok_status();
    for (std::size_t i = 0; i + 2 < corners.size(); i += list ? 3 : 1) {
      const std::size_t turned = strip ? i % 2 : 0;
      piece.triangles.push_back(
          {corners[fan ? 0 : i], corners[i + 1 + turned], corners[i + 2 - turned]});
    }
    return ok_status();
  }

  /// Four carriers of a vertex are in JOINTS_0 and WEIGHTS_0, the next four in JOINTS_1 and
  /// WEIGHTS_1, and so on.
  [[nodiscard]] Status read_carriers(const tinygltf::Primitive& primitive, Piece& piece) const {
    const std::size_t sets = count_bone_sets(primitive);
    piece.carriers_each = 4 * sets;
    piece.carriers.resize(piece.carriers_each * piece.positions.size());
    for (std::size_t set = 0; set < sets; ++set) {
      const Status status = read_set(primitive, set, piece);
      if (!status) return status;
    }
    for (std::size_t i = 0; i < piece.carriers.size(); i += piece.carriers_each) {
      const std::span<Carrier> of_vertex(piece.carriers.data() + i, piece.carriers_each);
      float sum = 0.0F;
      for (const Carrier& carrier : of_vertex) sum += carrier.weight;
      // What nothing carries goes with the first bone, as in common viewers.
      if (sum == 0.0F) of_vertex[0].weight = sum = 1.0F;
      for (Carrier& carrier : of_vertex) carrier.weight /= sum;
    }
    return ok_status();
  }

  [[nodiscard]] Status read_set(const tinygltf::Primitive& primitive, std::size_t set,
                                Piece& piece) const {
    const std::size_t count = piece.positions.size();
    const Result<BoneSet> read = read_bone_set(model_, path_, primitive, set, count);
    if (!read) return read.error();
    const std::size_t bones = std::min<std::size_t>(rig_.skins[*piece.skin].joints.size(), 65535);
    for (std::size_t i = 0; i < 4 * count; ++i) {
      const float weight = read->weights[i];
      const std::uint32_t bone = read->joints[i];
      if (weight == 0.0F) continue;
      if (bone >= bones) {
        return bad_file(
            path_, fmt::format("JOINTS_{} of vertex {}: expected joints below {}, found {}", set,
                               i / 4, bones, bone));
      }
      piece.carriers[piece.carriers_each * (i / 4) + 4 * set + i % 4] = {
          static_cast<std::uint16_t>(bone), weight};
    }
    return ok_status();
  }

  static constexpr std::size_t kMostPieces = 100'000;
  const tinygltf::Model& model_;
  const std::string& path_;
  Rig rig_;
};

}  // namespace

Result<Rig> read_rig(const tinygltf::Model& model, const std::string& path) {
  return Reader(model, path).read();
}

}  // namespace nade::gltf
