#include "nade/io/hand_file.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "gltf_accessor.h"

namespace nade {
namespace {

using gltf::AccessorRef;

/// The mesh and the skin that belong to one another in a file.
struct SkinnedNode {
  const tinygltf::Mesh* mesh;
  const tinygltf::Skin* skin;
};

/// Which joint of ours each joint of a skin stands for; none for what hangs on no joint of ours.
using JointMap = std::vector<std::optional<Joint>>;

/// Inverse bind matrices may be off by this and count as unscaled.
constexpr double kScaleNoise = 1e-3;
/// Wrist to middle knuckle, metres: what a hand in metres can measure.
constexpr double kShortestLength_m = 0.02;
constexpr double kLongestLength_m = 0.3;

Error bad_hand(const std::string& path, std::string_view problem) {
  return {ErrorCode::bad_format, fmt::format("{}: {}", path, problem)};
}

Result<SkinnedNode> find_skinned_node(const tinygltf::Model& model, const std::string& path) {
  for (const tinygltf::Node& node : model.nodes) {
    if (node.mesh < 0 || node.skin < 0) continue;
    const auto mesh = static_cast<std::size_t>(node.mesh);
    const auto skin = static_cast<std::size_t>(node.skin);
    if (mesh >= model.meshes.size() || skin >= model.skins.size()) continue;
    return SkinnedNode{&model.meshes[mesh], &model.skins[skin]};
  }
  return bad_hand(path, "has no skinned mesh, expected a hand with a skin");
}

/// A "palm" bone moves with the middle metacarpal, since the palm joint is made from it.
std::optional<Joint> joint_of_node(const tinygltf::Model& model, int node) {
  if (node < 0 || static_cast<std::size_t>(node) >= model.nodes.size()) return std::nullopt;
  const auto joint = joint_from_webxr_name(model.nodes[static_cast<std::size_t>(node)].name);
  return joint == Joint::palm ? Joint::middle_metacarpal : joint;
}

std::vector<int> parents_of_nodes(const tinygltf::Model& model) {
  std::vector<int> parents(model.nodes.size(), -1);
  for (std::size_t node = 0; node < model.nodes.size(); ++node) {
    for (const int child : model.nodes[node].children) {
      if (child < 0 || static_cast<std::size_t>(child) >= parents.size()) continue;
      parents[static_cast<std::size_t>(child)] = static_cast<int>(node);
    }
  }
  return parents;
}

JointMap map_joints(const tinygltf::Model& model, const tinygltf::Skin& skin) {
  const std::vector<int> parents = parents_of_nodes(model);
  std::vector<std::optional<Joint>> nearest(parents.size());
  std::vector<bool> known(parents.size(), false);
  JointMap map;
  for (const int joint : skin.joints) {
    // Each node is passed once, also where a file has its parents in a circle.
    std::vector<std::size_t> passed;
    std::optional<Joint> found;
    int node = joint;
    while (!found && node >= 0 && static_cast<std::size_t>(node) < parents.size()) {
      const auto at = static_cast<std::size_t>(node);
      found = known[at] ? nearest[at] : joint_of_node(model, node);
      if (known[at]) break;
      known[at] = true;
      passed.push_back(at);
      node = parents[at];
    }
    for (const std::size_t at : passed) nearest[at] = found;
    map.push_back(found);
  }
  return map;
}

/// What an inverse bind matrix says of its joint.
struct BindJoint {
  Pose pose;
  double scale;  ///< from the mesh's unit to the joint's
};

std::optional<BindJoint> bind_from_inverse(const float* column_major) {
  const Eigen::Matrix4d inverse = Eigen::Map<const Eigen::Matrix4f>(column_major).cast<double>();
  const Eigen::Matrix3d linear = inverse.topLeftCorner<3, 3>();
  const double determinant = linear.determinant();
  if (!inverse.allFinite() || !(determinant > 1e-12)) return std::nullopt;
  const Eigen::Vector3d position = -linear.inverse() * inverse.topRightCorner<3, 1>();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(linear, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d rotation = svd.matrixV() * svd.matrixU().transpose();
  const Quat turn = Quat(rotation).normalized();
  if (!position.allFinite() || !turn.coeffs().allFinite()) return std::nullopt;
  return BindJoint{{position, turn}, std::cbrt(determinant)};
}

/// Reads the bind pose, with the scale that its matrices share taken into the positions and
/// returned, so that the vertices can follow.
Result<double> read_bind(const tinygltf::Model& model, const std::string& path,
                         const tinygltf::Skin& skin, HandMesh& mesh) {
  const Result<std::vector<float>> matrices = gltf::read_floats(
      {model, path, "inverse bind matrices of the skin", skin.inverseBindMatrices}, 16);
  if (!matrices) return matrices.error();
  if (matrices->size() < 16 * skin.joints.size()) {
    return bad_hand(path, fmt::format("skin: {} inverse bind matrices for {} joints",
                                      matrices->size() / 16, skin.joints.size()));
  }
  std::array<std::optional<BindJoint>, kJointCount> found{};
  for (std::size_t i = 0; i < skin.joints.size(); ++i) {
    const int node = skin.joints[i];
    const std::optional<Joint> joint = joint_of_node(model, node);
    if (!joint || found[index_of(*joint)]) continue;
    const bool is_palm = model.nodes[static_cast<std::size_t>(node)].name == "palm";
    if (is_palm) continue;
    found[index_of(*joint)] = bind_from_inverse(matrices->data() + 16 * i);
    if (!found[index_of(*joint)]) {
      return bad_hand(path, fmt::format("joint {}: its inverse bind matrix cannot be inverted",
                                        name_of(*joint)));
    }
  }
  double scale_sum = 0.0;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    if (joint_at(i) == Joint::palm) continue;
    if (!found[i]) {
      return bad_hand(path, fmt::format("the skin has no joint {}, expected the 25 of WebXR by "
                                        "their names (\"index-finger-tip\")",
                                        name_of(joint_at(i))));
    }
    scale_sum += found[i]->scale;
  }
  const double mean = scale_sum / static_cast<double>(kJointCount - 1);
  const double scale = std::abs(mean - 1.0) < kScaleNoise ? 1.0 : mean;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    if (!found[i]) continue;
    if (std::abs(found[i]->scale / mean - 1.0) > 0.01) {
      return bad_hand(path, fmt::format("joint {}: scaled {:.3g} times, expected {:.3g} as in the "
                                        "mean of all joints",
                                        name_of(joint_at(i)), found[i]->scale, mean));
    }
    mesh.bind.joints[i] = {scale * found[i]->pose.position, found[i]->pose.rotation};
  }
  mesh.bind[Joint::palm] = palm_from_middle_metacarpal(mesh.bind);
  return scale;
}

/// Refuses what would be drawn mangled: centimetres, other axes, the other hand.
Status check_bind(const std::string& path, const HandPose& bind) {
  const double length = hand_length(bind);
  if (!(length > kShortestLength_m && length < kLongestLength_m)) {
    return bad_hand(path, fmt::format("the hand is {:.3g} m from wrist to middle knuckle, expected "
                                      "{} to {} (metres)",
                                      length, kShortestLength_m, kLongestLength_m));
  }
  for (std::size_t i = 0; i < kDigitCount; ++i) {
    const DigitJoints digit = joints_of(digit_at(i));
    const Joint base = joint_at(index_of(digit.metacarpal) + 1);
    const Vec3 to_tip = bind[digit.tip].position - bind[base].position;
    const Vec3 forward = bind[base].rotation * -Vec3::UnitZ();
    if (!(forward.dot(to_tip) > 0.5 * to_tip.norm())) {
      return bad_hand(
          path, fmt::format("joint {}: expected its -Z to point to the fingertip", name_of(base)));
    }
  }
  const Vec3 thumb_wrist = bind[Joint::wrist].inverse().apply(bind[Joint::thumb_proximal].position);
  const bool is_right = thumb_wrist.x() < 0.0;
  if (is_right != (bind.side == Handedness::right)) {
    return bad_hand(path, fmt::format("is a {} hand, expected a {} one",
                                      is_right ? "right" : "left", name_of(bind.side)));
  }
  return ok_status();
}

/// An attribute of a primitive, -1 where it has none.
int attribute(const tinygltf::Primitive& primitive, const char* name) {
  const auto found = primitive.attributes.find(name);
  return found == primitive.attributes.end() ? -1 : found->second;
}

/// What reading one primitive needs to know of its file.
struct PrimitiveSource {
  const tinygltf::Model& model;
  const std::string& path;
  const tinygltf::Primitive& primitive;

  [[nodiscard]] AccessorRef accessor(const char* name) const {
    return {model, path, name, attribute(primitive, name)};
  }
  [[nodiscard]] bool has(const char* name) const { return attribute(primitive, name) >= 0; }
};

Status read_shape(const PrimitiveSource& source, HandMesh& mesh) {
  const Result<std::vector<float>> positions = gltf::read_floats(source.accessor("POSITION"), 3);
  if (!positions) return positions.error();
  const std::size_t count = positions->size() / 3;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Map<const Eigen::Vector3f> vertex(positions->data() + 3 * i);
    if (!vertex.allFinite()) {
      return bad_hand(source.path,
                      fmt::format("POSITION of vertex {}: expected finite numbers", i));
    }
    mesh.vertices.emplace_back(vertex);
  }
  if (source.has("NORMAL")) {
    const Result<std::vector<float>> normals = gltf::read_floats(source.accessor("NORMAL"), 3);
    if (!normals) return normals.error();
    if (normals->size() == positions->size()) {
      for (std::size_t i = 0; i < count; ++i) {
        mesh.normals.emplace_back(Eigen::Map<const Eigen::Vector3f>(normals->data() + 3 * i));
      }
    }
  }
  mesh.normals.resize(mesh.vertices.size(), Eigen::Vector3f::Zero());
  if (source.has("TEXCOORD_0")) {
    const Result<std::vector<float>> coords = gltf::read_floats(source.accessor("TEXCOORD_0"), 2);
    if (!coords) return coords.error();
    for (std::size_t i = 0; i < std::min(count, coords->size() / 2); ++i) {
      mesh.texcoords.emplace_back(Eigen::Map<const Eigen::Vector2f>(coords->data() + 2 * i));
    }
  }
  mesh.texcoords.resize(mesh.vertices.size(), Eigen::Vector2f::Zero());
  return ok_status();
}

/// A bone of a vertex while it is read.
struct Share {
  std::uint8_t bone;
  float weight;
};

/// Adds what JOINTS_`set` and WEIGHTS_`set` say to the shares of each vertex.
Status read_shares(const PrimitiveSource& source, const JointMap& map, std::size_t set,
                   std::vector<std::vector<Share>>& shares) {
  const Result<gltf::BoneSet> read =
      gltf::read_bone_set(source.model, source.path, source.primitive, set, shares.size());
  if (!read) return read.error();
  for (std::size_t i = 0; i < read->joints.size(); ++i) {
    const std::uint32_t joint = read->joints[i];
    if (read->weights[i] == 0.0F) continue;
    if (joint >= map.size() || !map[joint]) {
      return bad_hand(source.path, fmt::format("JOINTS_{} of vertex {}: joint {} of the skin is "
                                               "neither a joint of the hand nor below one",
                                               set, i / 4, joint));
    }
    shares[i / 4].push_back({static_cast<std::uint8_t>(index_of(*map[joint])), read->weights[i]});
  }
  return ok_status();
}

/// Of more than four bones the four that weigh most.
Status read_weights(const PrimitiveSource& source, const JointMap& map, HandMesh& mesh) {
  std::vector<std::vector<Share>> all(mesh.vertices.size() - mesh.bones.size());
  const std::size_t sets = gltf::count_bone_sets(source.primitive);
  for (std::size_t set = 0; set < sets; ++set) {
    const Status status = read_shares(source, map, set, all);
    if (!status) return status;
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].empty()) {
      return bad_hand(source.path, fmt::format("WEIGHTS_0 of vertex {}: all are 0", i));
    }
    if (all[i].size() > 4) {
      std::stable_sort(all[i].begin(), all[i].end(),
                       [](const Share& a, const Share& b) { return a.weight > b.weight; });
      all[i].resize(4);
    }
    std::array<std::uint8_t, 4> bones{};
    bones.fill(static_cast<std::uint8_t>(index_of(Joint::wrist)));
    std::array<float, 4> weights{};
    float sum = 0.0F;
    for (const Share& share : all[i]) sum += share.weight;
    for (std::size_t k = 0; k < all[i].size(); ++k) {
      bones[k] = all[i][k].bone;
      weights[k] = all[i][k].weight / sum;
    }
    mesh.bones.push_back(bones);
    mesh.weights.push_back(weights);
  }
  return ok_status();
}

Status read_triangles(const PrimitiveSource& source, std::size_t first_vertex, HandMesh& mesh) {
  const std::size_t count = mesh.vertices.size() - first_vertex;
  std::vector<std::uint32_t> corners;
  if (source.primitive.indices >= 0) {
    Result<std::vector<std::uint32_t>> indices =
        gltf::read_integers({source.model, source.path, "indices", source.primitive.indices}, 1);
    if (!indices) return indices.error();
    corners = std::move(*indices);
  } else {
    for (std::size_t i = 0; i < count; ++i) corners.push_back(static_cast<std::uint32_t>(i));
  }
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (corners[i + k] >= count) {
        return bad_hand(source.path,
                        fmt::format("triangle {}: vertex {} of {}", i / 3, corners[i + k], count));
      }
      triangle[k] = corners[i + k] + static_cast<std::uint32_t>(first_vertex);
    }
    mesh.triangles.push_back(triangle);
  }
  return ok_status();
}

Status read_primitive(const PrimitiveSource& source, const JointMap& map, HandMesh& mesh) {
  const int mode = source.primitive.mode;
  if (mode != -1 && mode != TINYGLTF_MODE_TRIANGLES) {
    return bad_hand(source.path, "the hand's mesh is not a list of triangles");
  }
  const std::size_t first_vertex = mesh.vertices.size();
  Status status = read_shape(source, mesh);
  if (status.ok()) status = read_weights(source, map, mesh);
  if (status.ok()) status = read_triangles(source, first_vertex, mesh);
  return status;
}

/// Where the file gives no usable normal: the mean of the triangles', by area.
void complete_normals(HandMesh& mesh) {
  std::vector<Eigen::Vector3f> sums(mesh.vertices.size(), Eigen::Vector3f::Zero());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3f area =
        (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
    for (const std::uint32_t corner : {a, b, c}) sums[corner] += area;
  }
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    Eigen::Vector3f& normal = mesh.normals[i];
    const float length = normal.norm();
    if (std::isfinite(length) && length > 0.1F) {
      normal /= length;
    } else {
      const float area = sums[i].norm();
      normal = std::isfinite(area) && area > 0.0F ? Eigen::Vector3f(sums[i] / area)
                                                  : Eigen::Vector3f(Eigen::Vector3f::UnitY());
    }
  }
}

}  // namespace

Result<HandMesh> load_hand_mesh(const std::string& path, Handedness side) {
  const Result<tinygltf::Model> model = gltf::read_model(path);
  if (!model) return model.error();
  const Result<SkinnedNode> skinned = find_skinned_node(*model, path);
  if (!skinned) return skinned.error();
  HandMesh mesh;
  mesh.side = side;
  mesh.bind.side = side;
  const Result<double> scale = read_bind(*model, path, *skinned->skin, mesh);
  if (!scale) return scale.error();
  const Status bind_status = check_bind(path, mesh.bind);
  if (!bind_status) return bind_status.error();
  const JointMap map = map_joints(*model, *skinned->skin);
  for (const tinygltf::Primitive& primitive : skinned->mesh->primitives) {
    const Status status = read_primitive({*model, path, primitive}, map, mesh);
    if (!status) return status.error();
  }
  if (mesh.triangles.empty()) return bad_hand(path, "the hand's mesh has no triangles");
  if (*scale != 1.0) {
    for (Eigen::Vector3f& vertex : mesh.vertices) vertex *= static_cast<float>(*scale);
  }
  complete_normals(mesh);
  return mesh;
}

}  // namespace nade
