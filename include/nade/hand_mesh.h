#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nade/hand.h"

namespace nade {

/// A skinned hand: what is drawn, and what is measured. One bone for each joint but the palm.
struct HandMesh {
  Handedness side = Handedness::right;
  std::vector<Eigen::Vector3f> vertices;  ///< bind pose, metres
  std::vector<Eigen::Vector3f> normals;   ///< bind pose, unit
  std::vector<Eigen::Vector2f> texcoords;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Up to four bones a vertex; weights sum to 1.
  std::vector<std::array<std::uint8_t, 4>> bones;  ///< as index_of(Joint)
  std::vector<std::array<float, 4>> weights;
  /// Bind pose of each joint, rotations re-orthonormalised; the palm's is made from the middle
  /// metacarpal.
  HandPose bind;
};

/// Scale from the mesh's own size to the tracked hand's: k = hand_length(hand) /
/// hand_length(mesh.bind), wrist to middle knuckle; 1 where the hand has no length.
[[nodiscard]] double hand_scale(const HandMesh& mesh, const HandPose& hand) noexcept;

/// Poses the skin: bone matrix = joint pose x scale x inverse bind. `positions` and `normals`
/// (world) hold as many elements as the mesh has vertices; `normals` may be empty.
void pose_skin(const HandMesh& mesh, const HandPose& hand, double scale,
               std::span<Eigen::Vector3f> positions, std::span<Eigen::Vector3f> normals) noexcept;

/// Joint to palmar skin for each part, metres.
struct SkinDepths {
  std::array<double, kPartCount> depth_m{};
  [[nodiscard]] double operator[](Part part) const { return depth_m[index_of(part)]; }
  [[nodiscard]] double& operator[](Part part) { return depth_m[index_of(part)]; }
};

/// The length of c_j in Eq. (1), measured on the mesh in its bind pose: from the palm joint and
/// each fingertip along the joint's palmar axis (-Y) to the first skin that leads out; 0 where
/// there is none. Times `hand_scale` for a tracked hand.
[[nodiscard]] SkinDepths measure_skin_depths(const HandMesh& mesh);

/// Whether a vertex is of a part's contact patch: in the bind pose it faces the part's palmar axis
/// (-Y) within 60 degrees, and lies within 22 mm (palm) or 7 mm (fingertip) of the point where that
/// axis leaves the skin, as `depths` has it.
[[nodiscard]] bool is_in_patch(const HandMesh& mesh, const SkinDepths& depths, Part part,
                               std::size_t vertex);

/// As `measure_skin_depths` gives for the generic hand, for programs that load no hand mesh.
[[nodiscard]] SkinDepths generic_skin_depths();
/// Wrist to middle knuckle of the generic hand, metres.
inline constexpr double kGenericHandLength = 0.0916981;

}  // namespace nade
