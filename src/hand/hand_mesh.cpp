#include "nade/hand_mesh.h"

#include <cmath>
#include <limits>
#include <optional>

#include "nade/assert.h"

namespace nade {
namespace {

/// From the mesh's bind pose to the posed hand, seen from the wrist's place: a hand far from the
/// world's origin loses no precision in float.
using BoneMatrix = Eigen::Matrix4f;

std::array<BoneMatrix, kJointCount> make_bone_matrices(const HandMesh& mesh, const HandPose& hand,
                                                       double scale) noexcept {
  const Vec3& wrist = hand[Joint::wrist].position;
  std::array<BoneMatrix, kJointCount> bones;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Pose& bind = mesh.bind.joints[i];
    const Pose& joint = hand.joints[i];
    const Quat turn = joint.rotation * bind.rotation.conjugate();
    const Eigen::Matrix3d linear = scale * turn.toRotationMatrix();
    bones[i].setIdentity();
    bones[i].topLeftCorner<3, 3>() = linear.cast<float>();
    bones[i].topRightCorner<3, 1>() =
        (joint.position - wrist - linear * bind.position).cast<float>();
  }
  return bones;
}

/// Where a ray from `origin` along the unit `direction` meets a triangle; none if it runs beside
/// or along it.
// Based on: Möller, Trumbore. Fast, Minimum Storage Ray/Triangle Intersection. 1997.
struct TriangleHit {
  double distance;
  bool leaves;  ///< through the triangle's back: out of a closed mesh
};
std::optional<TriangleHit> intersect(const std::array<Vec3, 3>& corners, const Vec3& origin,
                                     const Vec3& direction) {
  const Vec3 edge_b = corners[1] - corners[0];
  const Vec3 edge_c = corners[2] - corners[0];
  const Vec3 p = direction.cross(edge_c);
  const double determinant = edge_b.dot(p);
  if (std::abs(determinant) < 1e-18) return std::nullopt;
  const Vec3 from_a = origin - corners[0];
  const double u = from_a.dot(p) / determinant;
  const Vec3 q = from_a.cross(edge_b);
  const double v = direction.dot(q) / determinant;
  const double distance = edge_c.dot(q) / determinant;
  if (u < 0.0 || v < 0.0 || u + v > 1.0 || distance <= 0.0) return std::nullopt;
  return TriangleHit{distance, determinant < 0.0};
}

/// From inside the flesh to the first skin the ray leaves through; 0 where there is none.
double distance_to_skin(const HandMesh& mesh, const Vec3& origin, const Vec3& direction) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& triangle : mesh.triangles) {
    std::array<Vec3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = mesh.vertices[triangle[i]].cast<double>();
    const std::optional<TriangleHit> hit = intersect(corners, origin, direction);
    if (hit && hit->leaves && hit->distance < nearest) nearest = hit->distance;
  }
  return std::isfinite(nearest) ? nearest : 0.0;
}

}  // namespace

double hand_scale(const HandMesh& mesh, const HandPose& hand) noexcept {
  const double own = hand_length(mesh.bind);
  const double tracked = hand_length(hand);
  const double scale = tracked / own;
  return std::isfinite(scale) && scale > 0.0 ? scale : 1.0;
}

void pose_skin(const HandMesh& mesh, const HandPose& hand, double scale,
               std::span<Eigen::Vector3f> positions, std::span<Eigen::Vector3f> normals) noexcept {
  NADE_ASSERT(positions.size() == mesh.vertices.size());
  NADE_ASSERT(normals.empty() || normals.size() == mesh.vertices.size());
  const std::array<BoneMatrix, kJointCount> bones = make_bone_matrices(mesh, hand, scale);
  const Eigen::Vector3f wrist = hand[Joint::wrist].position.cast<float>();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const std::array<std::uint8_t, 4>& bone = mesh.bones[i];
    const std::array<float, 4>& weight = mesh.weights[i];
    BoneMatrix blend = weight[0] * bones[bone[0]];
    for (std::size_t k = 1; k < 4; ++k) {
      if (weight[k] > 0.0F) blend += weight[k] * bones[bone[k]];
    }
    const Eigen::Vector3f& vertex = mesh.vertices[i];
    const Eigen::Vector4f moved = blend.col(0) * vertex.x() + blend.col(1) * vertex.y() +
                                  blend.col(2) * vertex.z() + blend.col(3);
    positions[i] = moved.head<3>() + wrist;
    if (normals.empty()) continue;
    const Eigen::Vector3f normal = blend.topLeftCorner<3, 3>() * mesh.normals[i];
    const float length = normal.norm();
    normals[i] = length > 0.0F ? Eigen::Vector3f(normal / length) : mesh.normals[i];
  }
}

SkinDepths measure_skin_depths(const HandMesh& mesh) {
  SkinDepths depths;
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const Pose& joint = mesh.bind[joint_of(part_at(i))];
    depths.depth_m[i] = distance_to_skin(mesh, joint.position, joint.rotation * -Vec3::UnitY());
  }
  return depths;
}

bool is_in_patch(const HandMesh& mesh, const SkinDepths& depths, Part part, std::size_t vertex) {
  constexpr double kPalmRadius_m = 0.022;
  constexpr double kTipRadius_m = 0.007;
  constexpr double kFacing = 0.5;  // cosine
  const Pose& joint = mesh.bind[joint_of(part)];
  const Vec3 palmar = joint.rotation * -Vec3::UnitY();
  const Vec3 middle = joint.position + depths[part] * palmar;
  const double radius_m = part == Part::palm ? kPalmRadius_m : kTipRadius_m;
  return (mesh.vertices[vertex].cast<double>() - middle).norm() < radius_m &&
         mesh.normals[vertex].cast<double>().dot(palmar) > kFacing;
}

SkinDepths generic_skin_depths() {
  // The mean of its left and its right hand.
  return {{0.02124, 0.00814, 0.00623, 0.00675, 0.00664, 0.00521}};
}

}  // namespace nade
