#include <algorithm>

#include "arguments.h"
#include "convert.h"
#include "nade/flesh.h"

namespace nade::c_abi {
namespace {

constexpr std::size_t kBones = 4;  ///< of a vertex

/// What is wrong with the arrays of a mesh whose pointers are given; none where `arguments` are ok.
void check_hand_mesh(const nade_hand_mesh& mesh, Arguments& arguments) {
  const std::size_t count = mesh.vertex_count;
  arguments.finite(mesh.vertices, 3 * count, "mesh: vertices")
      .finite(mesh.normals, 3 * count, "mesh: normals")
      .finite(mesh.weights, kBones * count, "mesh: weights");
  const auto is_vertex = [&](std::uint32_t index) { return index < count; };
  const auto is_bone = [](std::uint8_t bone) { return bone < kJointCount; };
  arguments
      .expects(std::all_of(mesh.triangles, mesh.triangles + 3 * std::size_t{mesh.triangle_count},
                           is_vertex),
               NADE_ERROR_DATA, "mesh: triangles: an index is out of range")
      .expects(std::all_of(mesh.bones, mesh.bones + kBones * count, is_bone), NADE_ERROR_DATA,
               "mesh: bones: a bone is no NADE_JOINT_");
  for (std::size_t i = 0; arguments.ok() && i < count; ++i) {
    const float* const weights = mesh.weights + kBones * i;
    const float sum = weights[0] + weights[1] + weights[2] + weights[3];
    const bool has_negative = std::any_of(weights, weights + kBones, [](float w) { return w < 0; });
    arguments.expects(!has_negative && sum > 0.0F && std::isfinite(sum), NADE_ERROR_DATA,
                      "mesh: weights: expected 0 or more, of a sum above 0");
  }
}

HandMesh mesh_from(const nade_hand_mesh& given) {
  HandMesh mesh;
  mesh.bind = hand_from(given.side, given.bind);
  mesh.side = mesh.bind.side;
  for (std::size_t i = 0; i < given.vertex_count; ++i) {
    mesh.vertices.emplace_back(vector_from(given.vertices + 3 * i).cast<float>());
    mesh.normals.emplace_back(vector_from(given.normals + 3 * i).cast<float>());
    mesh.texcoords.emplace_back(0.0F, 0.0F);
    auto& bones = mesh.bones.emplace_back();
    auto& weights = mesh.weights.emplace_back();
    const float* const shares = given.weights + kBones * i;
    const float sum = shares[0] + shares[1] + shares[2] + shares[3];
    for (std::size_t k = 0; k < kBones; ++k) {
      const std::uint8_t bone = given.bones[kBones * i + k];
      bones[k] = bone == NADE_JOINT_PALM ? std::uint8_t{NADE_JOINT_MIDDLE_METACARPAL} : bone;
      weights[k] = shares[k] / sum;
    }
  }
  mesh.triangles.resize(given.triangle_count);
  std::memcpy(mesh.triangles.data(), given.triangles,
              mesh.triangles.size() * sizeof mesh.triangles[0]);
  return mesh;
}

nade_status make_flesh(const nade_hand_mesh& given, nade_flesh** handle) {
  const HandMesh mesh = mesh_from(given);
  if (const auto fault = fault_of(mesh.bind)) {
    return fail(NADE_ERROR_DATA, "mesh: bind: %s", name_of(*fault).data());
  }
  auto flesh = std::make_shared<const HandFlesh>(measure_flesh(mesh));
  if (flesh->pads.empty()) return fail(NADE_ERROR_DATA, "mesh: no skin that could touch was found");
  *handle = HandlePool<nade_flesh>::take(HeldFlesh{std::move(flesh), measure_skin_depths(mesh)});
  return NADE_OK;
}

}  // namespace
}  // namespace nade::c_abi

using nade::c_abi::Arguments;
using nade::c_abi::guarded;

extern "C" {

nade_status nade_rest_hand(nade_side side, nade_joint* joints) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments = Arguments().side(side).given(joints, "joints");
    if (!arguments.ok()) return arguments.status();
    const nade::HandPose hand = nade::generic_rest_pose(
        side == NADE_LEFT ? nade::Handedness::left : nade::Handedness::right);
    for (std::size_t i = 0; i < nade::kJointCount; ++i) {
      joints[i] = nade::c_abi::joint_from(hand.joints[i]);
    }
    return arguments.status();
  });
}

nade_status nade_flesh_create(const nade_hand_mesh* mesh, nade_flesh** flesh) noexcept {
  return guarded(__func__, [&] {
    Arguments arguments;
    arguments.given(flesh, "flesh").read(mesh, "mesh");
    if (!arguments.ok()) return arguments.status();
    arguments.side(mesh->side)
        .given(mesh->vertices, "mesh: vertices")
        .given(mesh->normals, "mesh: normals")
        .given(mesh->triangles, "mesh: triangles")
        .given(mesh->bones, "mesh: bones")
        .given(mesh->weights, "mesh: weights")
        .given(mesh->bind, "mesh: bind")
        .at_least(mesh->vertex_count, 1, "mesh: vertex_count")
        .at_least(mesh->triangle_count, 1, "mesh: triangle_count");
    if (arguments.ok()) nade::c_abi::check_hand_mesh(*mesh, arguments);
    if (!arguments.ok()) return arguments.status();
    return nade::c_abi::make_flesh(*mesh, flesh);
  });
}

nade_status nade_flesh_destroy(nade_flesh* flesh) noexcept {
  return nade::c_abi::destroy(__func__, flesh);
}

}  // extern "C"
