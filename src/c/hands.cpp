#include <algorithm>
#include <limits>
#include <span>

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

/// NADE_OK, with the mesh in `mesh`, or what is wrong with the one that was given.
nade_status read_hand_mesh(const nade_hand_mesh* given, HandMesh& mesh) {
  Arguments arguments;
  arguments.read(given, "mesh");
  if (!arguments.ok()) return arguments.status();
  arguments.side(given->side)
      .given(given->vertices, "mesh: vertices")
      .given(given->normals, "mesh: normals")
      .given(given->triangles, "mesh: triangles")
      .given(given->bones, "mesh: bones")
      .given(given->weights, "mesh: weights")
      .given(given->bind, "mesh: bind")
      .at_least(given->vertex_count, 1, "mesh: vertex_count")
      .at_least(given->triangle_count, 1, "mesh: triangle_count");
  if (arguments.ok()) check_hand_mesh(*given, arguments);
  if (!arguments.ok()) return arguments.status();
  mesh = mesh_from(*given);
  if (const auto fault = fault_of(mesh.bind)) {
    return fail(NADE_ERROR_DATA, "mesh: bind: %s", name_of(*fault).data());
  }
  return NADE_OK;
}

nade_status make_flesh(const nade_hand_mesh* given, nade_flesh** handle) {
  HandMesh mesh;
  const nade_status status = read_hand_mesh(given, mesh);
  if (status != NADE_OK) return status;
  auto flesh = std::make_shared<const HandFlesh>(measure_flesh(mesh));
  if (flesh->pads.empty()) return fail(NADE_ERROR_DATA, "mesh: no skin that could touch was found");
  *handle = HandlePool<nade_flesh>::take(HeldFlesh{std::move(flesh), measure_skin_depths(mesh)});
  return NADE_OK;
}

nade_status make_skin(const nade_hand_mesh* given, nade_skin** handle) {
  HandMesh mesh;
  const nade_status status = read_hand_mesh(given, mesh);
  if (status != NADE_OK) return status;
  SkinFlattener flattener(mesh);
  *handle = HandlePool<nade_skin>::take(HeldSkin{nullptr, std::move(mesh), std::move(flattener)});
  return NADE_OK;
}

/// A call about the skin of a hand: what all of them are given.
struct SkinCall {
  const nade_skin* skin;
  const nade_joint* joints;
  double scale;
  float* vertices;
  float* normals;
  std::size_t vertex_count;
};

/// NADE_OK, with the hand in `hand`.
nade_status check_skin_call(const SkinCall& call, HandPose& hand) {
  Arguments arguments;
  arguments.handle(call.skin, "skin")
      .given(call.joints, "joints")
      .above_zero(call.scale, "scale")
      .given(call.vertices, "vertices");
  if (!arguments.ok()) return arguments.status();
  const HandMesh& mesh = call.skin->contents->mesh;
  if (call.vertex_count != mesh.vertices.size()) {
    return fail(NADE_ERROR_ARGUMENT, "vertex_count: expected %zu, as the mesh has, found %zu",
                mesh.vertices.size(), call.vertex_count);
  }
  hand = hand_from(mesh.side == Handedness::left ? NADE_LEFT : NADE_RIGHT, call.joints);
  if (const auto fault = fault_of(hand)) {
    return fail(NADE_ERROR_DATA, "joints: %s", name_of(*fault).data());
  }
  return NADE_OK;
}

/// Arrays of x y z, as the classes have them; none for NULL.
std::span<Eigen::Vector3f> points_in(float* numbers, std::size_t count) {
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
  return {reinterpret_cast<Eigen::Vector3f*>(numbers), numbers == nullptr ? 0 : count};
}

template <class Touchable>
void flatten(const SkinCall& call, HeldSkin& held, const HandPose& hand, const Touchable& touchable,
             double give_m) {
  const std::span<Eigen::Vector3f> vertices = points_in(call.vertices, call.vertex_count);
  held.flattener.flatten(touchable, hand, call.scale, give_m, vertices, vertices,
                         points_in(call.normals, call.vertex_count));
}

/// Of `flatten` and `flatten_scene`.
nade_status check_flattening(const SkinCall& call, double give_m, HandPose& hand) {
  const nade_status status = check_skin_call(call, hand);
  if (status != NADE_OK) return status;
  Arguments arguments;
  arguments.within(give_m, 0.0, std::numeric_limits<double>::max(), "give_m")
      .finite(call.vertices, 3 * call.vertex_count, "vertices");
  if (call.normals != nullptr) arguments.finite(call.normals, 3 * call.vertex_count, "normals");
  return arguments.status();
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
    const Arguments arguments = Arguments().given(flesh, "flesh");
    if (!arguments.ok()) return arguments.status();
    return nade::c_abi::make_flesh(mesh, flesh);
  });
}

nade_status nade_flesh_destroy(nade_flesh* flesh) noexcept {
  return nade::c_abi::destroy(__func__, flesh);
}

nade_status nade_skin_create(const nade_hand_mesh* mesh, nade_skin** skin) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments = Arguments().given(skin, "skin");
    if (!arguments.ok()) return arguments.status();
    return nade::c_abi::make_skin(mesh, skin);
  });
}

nade_status nade_skin_pose(const nade_skin* skin, const nade_joint* joints, double scale,
                           float* vertices, float* normals, size_t vertex_count) noexcept {
  return guarded(__func__, [&] {
    nade::HandPose hand;
    const nade_status status =
        nade::c_abi::check_skin_call({skin, joints, scale, vertices, normals, vertex_count}, hand);
    if (status != NADE_OK) return status;
    nade::pose_skin(skin->contents->mesh, hand, scale,
                    nade::c_abi::points_in(vertices, vertex_count),
                    nade::c_abi::points_in(normals, vertex_count));
    return status;
  });
}

nade_status nade_skin_flatten(nade_skin* skin, const nade_joint* joints, double scale,
                              const nade_surface* surface, const nade_placement* placement,
                              double give_m, float* vertices, float* normals,
                              size_t vertex_count) noexcept {
  return guarded(__func__, [&] {
    const nade::c_abi::SkinCall call{skin, joints, scale, vertices, normals, vertex_count};
    nade::HandPose hand;
    nade_status status = nade::c_abi::check_flattening(call, give_m, hand);
    if (status != NADE_OK) return status;
    Arguments arguments;
    arguments.placement(placement);
    if (surface != nullptr) arguments.handle(surface, "surface");
    if (!arguments.ok()) return arguments.status();
    nade::c_abi::HeldSkin& held = *skin->contents;
    if (surface == nullptr) return status;
    if (held.surface != *surface->contents) held.surface = *surface->contents;
    const nade::Object object(*held.surface->surface, nade::c_abi::placement_from(placement));
    nade::c_abi::flatten(call, held, hand, object, give_m);
    return status;
  });
}

nade_status nade_skin_flatten_scene(nade_skin* skin, const nade_joint* joints, double scale,
                                    const nade_scene* scene, double give_m, float* vertices,
                                    float* normals, size_t vertex_count) noexcept {
  return guarded(__func__, [&] {
    const nade::c_abi::SkinCall call{skin, joints, scale, vertices, normals, vertex_count};
    nade::HandPose hand;
    const nade_status status = nade::c_abi::check_flattening(call, give_m, hand);
    if (status != NADE_OK) return status;
    const Arguments arguments = Arguments().handle(scene, "scene");
    if (!arguments.ok()) return arguments.status();
    nade::c_abi::flatten(call, *skin->contents, hand, scene->contents->scene, give_m);
    return status;
  });
}

nade_status nade_skin_destroy(nade_skin* skin) noexcept {
  return nade::c_abi::destroy(__func__, skin);
}

}  // extern "C"
