#include "nade/hand.h"

#include <algorithm>
#include <cmath>

namespace nade {
namespace {

struct JointNames {
  std::string_view name;
  std::string_view webxr;
};

constexpr std::array<JointNames, kJointCount> kNames{{
    {"palm", "palm"},
    {"wrist", "wrist"},
    {"thumb_metacarpal", "thumb-metacarpal"},
    {"thumb_proximal", "thumb-phalanx-proximal"},
    {"thumb_distal", "thumb-phalanx-distal"},
    {"thumb_tip", "thumb-tip"},
    {"index_metacarpal", "index-finger-metacarpal"},
    {"index_proximal", "index-finger-phalanx-proximal"},
    {"index_intermediate", "index-finger-phalanx-intermediate"},
    {"index_distal", "index-finger-phalanx-distal"},
    {"index_tip", "index-finger-tip"},
    {"middle_metacarpal", "middle-finger-metacarpal"},
    {"middle_proximal", "middle-finger-phalanx-proximal"},
    {"middle_intermediate", "middle-finger-phalanx-intermediate"},
    {"middle_distal", "middle-finger-phalanx-distal"},
    {"middle_tip", "middle-finger-tip"},
    {"ring_metacarpal", "ring-finger-metacarpal"},
    {"ring_proximal", "ring-finger-phalanx-proximal"},
    {"ring_intermediate", "ring-finger-phalanx-intermediate"},
    {"ring_distal", "ring-finger-phalanx-distal"},
    {"ring_tip", "ring-finger-tip"},
    {"little_metacarpal", "pinky-finger-metacarpal"},
    {"little_proximal", "pinky-finger-phalanx-proximal"},
    {"little_intermediate", "pinky-finger-phalanx-intermediate"},
    {"little_distal", "pinky-finger-phalanx-distal"},
    {"little_tip", "pinky-finger-tip"},
}};

/// Longer than any hand, shorter than any tracking blunder worth stopping.
constexpr double kLongestHand_m = 0.5;
/// Numbers are too coarse beyond, or distances not finite.
constexpr double kFarthest_m = 1e6;
constexpr double kShortestHand_m = 1e-3;
constexpr double kUnitTolerance = 1e-3;  // of the squared length
constexpr double kShortestRotation = 0.5;
constexpr double kLongestRotation = 2.0;

bool is_unit(const Quat& rotation) {
  return std::abs(rotation.squaredNorm() - 1.0) <= kUnitTolerance;
}

}  // namespace

std::string_view name_of(Joint joint) { return kNames[index_of(joint)].name; }

std::string_view name_of(Part part) {
  constexpr std::array<std::string_view, kPartCount> kPartNames{"palm",   "thumb", "index",
                                                                "middle", "ring",  "little"};
  return kPartNames[index_of(part)];
}

std::string_view name_of(Handedness side) { return side == Handedness::left ? "left" : "right"; }

std::string_view name_of(HandStatus status) {
  constexpr std::array<std::string_view, 4> kStatusNames{"free", "corrected", "released",
                                                         "untracked"};
  return kStatusNames[static_cast<std::size_t>(status)];
}

std::string_view webxr_name_of(Joint joint) { return kNames[index_of(joint)].webxr; }

std::optional<Joint> joint_from_webxr_name(std::string_view name) {
  const auto found = std::find_if(kNames.begin(), kNames.end(),
                                  [&](const JointNames& names) { return names.webxr == name; });
  if (found == kNames.end()) return std::nullopt;
  return joint_at(static_cast<std::size_t>(found - kNames.begin()));
}

std::string_view name_of(HandFault fault) {
  constexpr std::array<std::string_view, 5> kFaultNames{
      "a joint is not finite", "a joint is not turned by a rotation",
      "the wrist is 1000 km or more from the origin",
      "a joint is half a metre or more from the wrist", "the hand has no length"};
  return kFaultNames[static_cast<std::size_t>(fault)];
}

std::optional<HandFault> fault_of(const HandPose& hand) noexcept {
  bool finite = true;
  bool unit = true;
  bool near = true;
  const Vec3& wrist = hand[Joint::wrist].position;
  for (const Pose& joint : hand.joints) {
    finite = finite && joint.position.allFinite() && joint.rotation.coeffs().allFinite();
    unit = unit && is_unit(joint.rotation);
    near = near && (joint.position - wrist).norm() < kLongestHand_m;
  }
  if (!finite) return HandFault::not_finite;
  if (!unit) return HandFault::rotation_not_unit;
  if (!(wrist.norm() < kFarthest_m)) return HandFault::wrist_far;
  if (!near) return HandFault::joint_far;
  if (hand_length(hand) < kShortestHand_m) return HandFault::no_length;
  return std::nullopt;
}

bool is_usable(const HandPose& hand) noexcept { return !fault_of(hand); }

HandPose with_unit_rotations(const HandPose& hand) noexcept {
  HandPose result = hand;
  for (Pose& joint : result.joints) {
    const double length = joint.rotation.norm();
    const bool can_be = length >= kShortestRotation && length <= kLongestRotation;
    if (can_be && !is_unit(joint.rotation)) joint.rotation.coeffs() /= length;
  }
  return result;
}

double hand_length(const HandPose& hand) noexcept {
  return (hand[Joint::middle_proximal].position - hand[Joint::wrist].position).norm();
}

Pose palm_from_middle_metacarpal(const HandPose& hand) noexcept {
  const Pose& metacarpal = hand[Joint::middle_metacarpal];
  return {0.5 * (metacarpal.position + hand[Joint::middle_proximal].position), metacarpal.rotation};
}

HandPose moved(const HandPose& hand, const Pose& motion) noexcept {
  HandPose result = hand;
  for (Pose& joint : result.joints) joint = motion * joint;
  return result;
}

Pose mirrored(const Pose& pose) noexcept {
  Pose result = pose;
  result.position.x() = -pose.position.x();
  // Conjugating a rotation with the reflection of x keeps its x and w.
  result.rotation.y() = -pose.rotation.y();
  result.rotation.z() = -pose.rotation.z();
  return result;
}

HandPose mirrored(const HandPose& hand) noexcept {
  HandPose result = hand;
  result.side = hand.side == Handedness::left ? Handedness::right : Handedness::left;
  for (Pose& joint : result.joints) joint = mirrored(joint);
  return result;
}

}  // namespace nade
