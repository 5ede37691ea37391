#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "nade/hand_mesh.h"
#include "nade/skin.h"

namespace nade {

/// A point of the flesh or on its skin, carried by up to four joints as the drawn hand's vertices
/// are.
struct FleshPoint {
  std::array<std::uint8_t, 4> joints{};  ///< as index_of(Joint)
  /// By joint: where the joint's frame has the point, in the mesh's own size, times its weight; and
  /// the weight. Weights sum to 1, largest first. Floats hold that to 1e-8 metres.
  std::array<Eigen::Vector4f, 4> shares{Eigen::Vector4f::Zero(), Eigen::Vector4f::Zero(),
                                        Eigen::Vector4f::Zero(), Eigen::Vector4f::Zero()};

  /// Takes a joint of that weight in as number `k`.
  void attach(std::size_t k, std::size_t joint, double weight, const Vec3& local) noexcept {
    joints[k] = static_cast<std::uint8_t>(joint);
    shares[k] << (weight * local).cast<float>(), static_cast<float>(weight);
  }
};

/// Where a hand that is so many times the mesh's size has it.
[[nodiscard]] Vec3 position_of(const FleshPoint& point, const HandPose& hand,
                               double scale) noexcept;

/// The palmar skin near a pad, as one point.
struct PalmarPatch {
  FleshPoint middle;                     ///< its middle by area
  double area_m2 = 0.0;                  ///< the mesh's own size
  SkinRegion region = SkinRegion::back;  ///< of most of it
};

/// A piece of the hand about the size of a fingertip.
struct FleshPad {
  FleshPoint middle;        ///< in the flesh
  std::uint32_t first = 0;  ///< of `HandFlesh::skin`: the points that stick out
  std::uint32_t count = 0;
  double radius_m = 0.0;     ///< no skin of it is farther from the middle, in the bind pose
  std::optional<Part> part;  ///< whose contact patch it belongs to
  std::optional<PalmarPatch> palmar;  ///< none where there is no palmar skin nearest to it
};

/// All of a hand that can touch: its skin, in pieces. Metres, the mesh's own size.
struct HandFlesh {
  Handedness side = Handedness::right;
  double hand_length_m = kGenericHandLength;  ///< of the mesh, wrist to middle knuckle
  std::vector<FleshPad> pads;
  std::vector<FleshPoint> skin;
  /// By skin point: how far the flesh gives way there, as of SkinMap. Metres, alike for hands of
  /// any size.
  std::vector<double> depth_m;
  /// Of each phalanx, by the joint where it ends: from its middle to the nearest skin. 0 elsewhere.
  std::array<double, kJointCount> phalanx_radius_m{};
};

/// A hand has no more skin points than this: a frame looks at each of them.
inline constexpr std::size_t kMostSkinPoints = 1280;

/// Cuts a hand mesh into pads. A part's pads are the skin around the point where the part's
/// palmar axis leaves the flesh, as the metric `part_gap` has it. Of each pad only the points that
/// stick out are kept; of a fine mesh, only vertices that lie far enough apart. Each vertex has
/// some weight.
[[nodiscard]] HandFlesh measure_flesh(const HandMesh& mesh);

/// As `measure_flesh` gives for the generic hand, the left the mirror image of the right: for
/// programs that load no hand mesh.
[[nodiscard]] const HandFlesh& generic_flesh(Handedness side);

/// The generic hand as its mesh is bound: its palm joint in the origin, palm down, fingers along
/// -Z. Radii 0.
[[nodiscard]] HandPose generic_rest_pose(Handedness side);

}  // namespace nade
