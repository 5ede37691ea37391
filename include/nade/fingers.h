#pragma once

#include "nade/contact.h"
#include "nade/skeleton.h"

namespace nade {

/// The open points of the paper's finger step.
struct FingerOptions {
  /// The farthest a fingertip's ray turns toward extension, radians, 0 to pi/2.
  double max_ray_turn_rad = 80.0 * kDegree;
};

/// What was added to each digit's movable angles, radians.
using HandBend = std::array<DigitFreedoms, kDigitCount>;
[[nodiscard]] inline HandBend no_bend() {
  HandBend bend;
  bend.fill(DigitFreedoms::Zero());
  return bend;
}

/// The hand with its digits laid on the surface.
struct LaidFingers {
  HandPose hand;
  HandBend bend = no_bend();
  std::array<double, kDigitCount> ray_turn_rad{};  ///< of each fingertip's ray
};

/// Step 2 (b): brings each fingertip to its p_vr by inverse kinematics. Where the target lies
/// nearer to the digit's base than the tracked tip does, the tip's ray is first turned toward
/// extension by the least angle that mends it; `contacts` gets the targets used.
[[nodiscard]] LaidFingers lay_fingers(const HandPose& tracked, const HandPose& seated,
                                      const Object& object, const FingerOptions& options,
                                      Contacts& contacts) noexcept;

/// The angles, inside the range of motion, that bring the tip to `target_world` with the least
/// change from the chain's own; where it is out of reach, as near as can be. A tracked angle
/// outside the range widens the range to itself.
[[nodiscard]] DigitAngles reach(const DigitChain& chain, const Vec3& target_world) noexcept;

}  // namespace nade
