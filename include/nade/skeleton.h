#pragma once

#include <array>

#include "nade/hand.h"

namespace nade {

/// The three places where a digit bends, from its base: MCP, PIP, DIP of a finger; CMC, MCP, IP
/// of the thumb.
inline constexpr std::size_t kHingeCount = 3;

/// How a bone is turned against the one before it, radians; zero where both are in line.
/// Flexion is toward the palm, abduction toward the thumb's side (of the thumb: away from the
/// palm's plane on the thumb's side), twist about the bone. Left and right hands give the same
/// numbers. Source of the axes: Grood and Suntay's joint coordinate system, as the ISB asks for.
struct HingeAngles {
  double flexion = 0.0;
  double abduction = 0.0;
  double twist = 0.0;
};
using DigitAngles = std::array<HingeAngles, kHingeCount>;
using HandAngles = std::array<DigitAngles, kDigitCount>;

/// The range of motion of one hinge, radians.
struct HingeRange {
  double flexion_min = 0.0;
  double flexion_max = 0.0;
  double abduction_min = 0.0;
  double abduction_max = 0.0;
};

/// The anatomical range of a hinge. Only a digit's first hinge abducts.
/// Source: docs/method.md, "Range of motion".
[[nodiscard]] HingeRange range_of_motion(Digit digit, std::size_t hinge) noexcept;

/// The joint at which a hinge turns; hinge 3 is the tip.
[[nodiscard]] constexpr Joint hinge_joint(Digit digit, std::size_t hinge) {
  return joint_at(index_of(joints_of(digit).tip) - kHingeCount + hinge);
}

/// One digit as a chain of bones, measured from a tracked hand: lengths, offsets and how each
/// joint frame sits on its bone are the person's own. A bone's frame has -Z along the bone and
/// +Y as near as can be to the joint's.
struct DigitChain {
  Digit digit = Digit::index;
  Handedness side = Handedness::right;
  /// What the first hinge turns against: the finger's metacarpal; for the thumb the wrist,
  /// turned to how a relaxed thumb's metacarpal lies.
  Quat parent_rotation = Quat::Identity();
  Vec3 base = Vec3::Zero();                             ///< the first hinge, world
  std::array<Vec3, kHingeCount> bone{};                 ///< to the next joint, in the bone's frame
  std::array<Quat, kHingeCount + 1> joint_from_bone{};  ///< tracked joint frame on its bone
  DigitAngles angles{};                                 ///< as tracked

  /// The longest distance from base to tip, metres.
  [[nodiscard]] double length() const noexcept;
};

/// Measures a digit. Where a bone has no length its joint's own frame serves.
[[nodiscard]] DigitChain measure_chain(const HandPose& hand, Digit digit) noexcept;

/// All hinge angles of a hand.
[[nodiscard]] HandAngles measure_angles(const HandPose& hand) noexcept;

/// How a finger is curled: its middle and last flexion together, radians.
[[nodiscard]] double curl_of(const DigitAngles& finger) noexcept;
/// The mean of the four fingers.
[[nodiscard]] double curl_of(const HandAngles& hand) noexcept;

/// A digit's moving joints, from the first hinge to the tip.
using DigitPose = std::array<Pose, kHingeCount + 1>;

/// Forward kinematics: the digit bent to `angles`. With the chain's own angles it gives the
/// tracked joints back.
[[nodiscard]] DigitPose pose_chain(const DigitChain& chain, const DigitAngles& angles) noexcept;

/// The world axes about which a digit's four movable angles turn, and the joint positions: what
/// a solver needs for derivatives. Order: base abduction, base, middle and last flexion.
inline constexpr std::size_t kDigitFreedoms = 4;
using DigitFreedoms = Eigen::Matrix<double, kDigitFreedoms, 1>;
struct DigitAxes {
  std::array<Vec3, kDigitFreedoms> axis{};
  std::array<Vec3, kDigitFreedoms> center{};
  Vec3 tip = Vec3::Zero();
};
[[nodiscard]] DigitAxes chain_axes(const DigitChain& chain, const DigitAngles& angles) noexcept;

/// Both at once.
struct PosedDigit {
  DigitPose joints;
  DigitAxes axes;
};
[[nodiscard]] PosedDigit pose_with_axes(const DigitChain& chain,
                                        const DigitAngles& angles) noexcept;

/// The chain's angles with the digit turned as a whole about its base by a world rotation.
[[nodiscard]] DigitAngles turned_whole(const DigitChain& chain, const Quat& turn_world) noexcept;

/// The four movable angles of a digit, and the digit with them changed.
[[nodiscard]] DigitFreedoms freedoms_of(const DigitAngles& angles) noexcept;
[[nodiscard]] DigitAngles with_freedoms(const DigitAngles& angles,
                                        const DigitFreedoms& freedoms) noexcept;

/// Bounds of a digit's movable angles.
struct BendRange {
  DigitFreedoms low = DigitFreedoms::Zero();
  DigitFreedoms high = DigitFreedoms::Zero();
};
/// The range of motion; a tracked angle outside of it widens it to itself.
[[nodiscard]] BendRange bend_range(const DigitChain& chain) noexcept;

/// Writes a digit's joints into a hand.
void set_digit(HandPose& hand, Digit digit, const DigitPose& pose) noexcept;

}  // namespace nade
