#include "nade/skin.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "nade/assert.h"
#include "ramps.h"

namespace nade {
namespace {

/// Skin is palmar within 60 degrees of its bone's palmar axis; its flesh is all there from then on.
constexpr double kPalmarCosine = 0.5;
/// Along the hand, of wrist to middle knuckle: the stump ends, the heel ends, the knuckles begin.
constexpr double kStump = -0.12;
constexpr double kHeel = 0.4;
constexpr double kKnuckles = 0.8;
/// Across the hand, of index to little knuckle from their middle: the little finger's side begins.
constexpr double kLittleSide = -0.1;

/// How deep skin gives way at the least, and by region at the most.
constexpr double kBackFlesh_m = 0.0005;
constexpr std::array<double, kSkinRegionCount> kFlesh_m{0.003, 0.005, 0.012,       0.005,
                                                        0.012, 0.005, kBackFlesh_m};

Vec3 palmar_axis(const HandMesh& mesh, Joint joint) {
  return mesh.bind[joint].rotation * -Vec3::UnitY();
}

Joint leading_bone(const HandMesh& mesh, std::size_t vertex) {
  std::array<float, kJointCount> weights{};
  for (std::size_t k = 0; k < 4; ++k) weights[mesh.bones[vertex][k]] += mesh.weights[vertex][k];
  const auto most = std::max_element(weights.begin(), weights.end());
  return joint_at(static_cast<std::size_t>(most - weights.begin()));
}

bool is_thumb_ball(Joint joint) {
  return joint == Joint::thumb_metacarpal || joint == Joint::thumb_proximal;
}

/// The digit whose phalanx a joint begins; its last counts with its tip.
enum class Bone : std::uint8_t { palm, phalanx, last_phalanx };
Bone bone_of(Joint joint) {
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const DigitJoints joints = joints_of(digit_at(d));
    if (index_of(joint) <= index_of(joints.metacarpal) || joint > joints.tip) continue;
    return index_of(joint) + 1 >= index_of(joints.tip) ? Bone::last_phalanx : Bone::phalanx;
  }
  return Bone::palm;
}

/// The palm's own axes, in which places on it are counted.
struct PalmPlan {
  explicit PalmPlan(const HandPose& bind)
      : wrist(bind[Joint::wrist].position),
        along(bind[Joint::middle_proximal].position - wrist),
        across(bind[Joint::index_proximal].position - bind[Joint::little_proximal].position),
        middle(0.5 *
               (bind[Joint::index_proximal].position + bind[Joint::little_proximal].position)) {}

  [[nodiscard]] double u(const Vec3& at) const {
    return (at - wrist).dot(along) / along.squaredNorm();
  }
  [[nodiscard]] double v(const Vec3& at) const {
    return (at - middle).dot(across) / across.squaredNorm();
  }

  Vec3 wrist, along, across, middle;
};

/// Of skin on the palm's side, whichever way it faces.
SkinRegion region_at(const PalmPlan& plan, Joint bone, const Vec3& at) {
  if (is_thumb_ball(bone)) return SkinRegion::thenar;
  if (bone_of(bone) == Bone::last_phalanx) return SkinRegion::tip;
  if (bone_of(bone) == Bone::phalanx) return SkinRegion::finger;
  if (plan.u(at) > kKnuckles) return SkinRegion::knuckles;
  if (plan.u(at) < kHeel || plan.v(at) < kLittleSide) return SkinRegion::heel;
  return SkinRegion::hollow;
}

}  // namespace

std::string_view name_of(SkinRegion region) {
  constexpr std::array<std::string_view, kSkinRegionCount> kNames{
      "tip", "finger", "thenar", "knuckles", "heel", "hollow", "back"};
  return kNames[static_cast<std::size_t>(region)];
}

SkinMap measure_skin(const HandMesh& mesh) {
  const std::size_t count = mesh.vertices.size();
  NADE_ASSERT(mesh.normals.size() == count && mesh.bones.size() == count);
  const PalmPlan plan(mesh.bind);
  SkinMap skin;
  skin.region.resize(count);
  skin.flesh_m.resize(count);
  skin.area_m2.resize(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const Joint bone = leading_bone(mesh, i);
    const Vec3 at = mesh.vertices[i].cast<double>();
    const Vec3 normal = mesh.normals[i].cast<double>();
    double facing = normal.dot(palmar_axis(mesh, bone));
    // The thumb's ball faces as the palm does, whichever way its bones are turned.
    if (is_thumb_ball(bone)) {
      facing = std::max(facing, normal.dot(palmar_axis(mesh, Joint::middle_metacarpal)));
    }
    const SkinRegion region = region_at(plan, bone, at);
    const double most_m = kFlesh_m[static_cast<std::size_t>(region)];
    skin.flesh_m[i] =
        kBackFlesh_m + smoothstep(0.0, kPalmarCosine, facing) * (most_m - kBackFlesh_m);
    const bool palmar = facing >= kPalmarCosine && plan.u(at) >= kStump;
    skin.region[i] = palmar ? region : SkinRegion::back;
  }
  for (const auto& triangle : mesh.triangles) {
    const Vec3 a = mesh.vertices[triangle[0]].cast<double>();
    const Vec3 b = mesh.vertices[triangle[1]].cast<double>();
    const Vec3 c = mesh.vertices[triangle[2]].cast<double>();
    const double third_m2 = (b - a).cross(c - a).norm() / 6.0;
    for (const std::uint32_t i : triangle) skin.area_m2[i] += third_m2;
  }
  return skin;
}

}  // namespace nade
