#include "nade/skeleton.h"

// Based on: Grood, Suntay. A joint coordinate system for the clinical description of
// three-dimensional motions. 1983. Wu et al. ISB recommendation, part II: hand. 2005.

#include <algorithm>
#include <cmath>

namespace nade {
namespace {

constexpr double kShortestBone_m = 1e-5;

Quat turn_x(double angle) { return {std::cos(0.5 * angle), std::sin(0.5 * angle), 0.0, 0.0}; }

/// Abduction and twist change sign in the mirror; flexion does not.
double side_sign(Handedness side) { return side == Handedness::right ? 1.0 : -1.0; }

/// Rx(-flexion) Ry(abduction) Rz(twist), multiplied out.
Quat rotation_of(const HingeAngles& angles, double sign) {
  const double cx = std::cos(-0.5 * angles.flexion);
  const double sx = std::sin(-0.5 * angles.flexion);
  const double cy = std::cos(0.5 * sign * angles.abduction);
  const double sy = std::sin(0.5 * sign * angles.abduction);
  const double cz = std::cos(0.5 * sign * angles.twist);
  const double sz = std::sin(0.5 * sign * angles.twist);
  return {cx * cy * cz - sx * sy * sz, sx * cy * cz + cx * sy * sz, cx * sy * cz - sx * cy * sz,
          cx * cy * sz + sx * sy * cz};
}

/// The inverse of `rotation_of`.
HingeAngles angles_of(const Quat& rotation, double sign) {
  const Eigen::Matrix3d r = rotation.toRotationMatrix();
  HingeAngles angles;
  angles.flexion = -std::atan2(-r(1, 2), r(2, 2));
  angles.abduction = sign * std::asin(std::clamp(r(0, 2), -1.0, 1.0));
  angles.twist = sign * std::atan2(-r(0, 1), r(0, 0));
  return angles;
}

/// -Z along `bone_world`, +Y as near as can be to the joint's.
Quat bone_frame(const Vec3& bone_world, const Quat& joint) {
  const double length = bone_world.norm();
  if (!(length > kShortestBone_m)) return joint;
  const Vec3 z = -bone_world / length;
  const Vec3 x = (joint * Vec3::UnitY()).cross(z);
  const double x_norm = x.norm();
  if (!(x_norm > 1e-6)) return joint;
  Eigen::Matrix3d frame;
  frame.col(0) = x / x_norm;
  frame.col(2) = z;
  frame.col(1) = z.cross(frame.col(0));
  return Quat(frame);
}

/// How the metacarpal of a relaxed right thumb lies against the wrist. Measured on the relaxed
/// hand of npm iwer 2.5.0, captured on a headset.
Quat relaxed_thumb(Handedness side) {
  const double sign = side_sign(side);
  return Quat(0.72160, 0.07775, sign * 0.38106, sign * 0.57275).normalized();
}

/// Where a digit's last bone ends, and how it lies.
struct BoneEnd {
  Vec3 position;
  Quat frame;
};

/// Goes along a digit that is bent to `angles`: `take` gets each hinge, the frame of the bone
/// before it, where it is, and the frame of its own bone.
template <class Take>
BoneEnd go_along(const DigitChain& chain, const DigitAngles& angles, Take take) {
  const double sign = side_sign(chain.side);
  BoneEnd end{chain.base, chain.parent_rotation};
  for (std::size_t i = 0; i < kHingeCount; ++i) {
    const Quat frame = end.frame * rotation_of(angles[i], sign);
    take(i, end.frame, end.position, frame);
    end = {end.position + frame * chain.bone[i], frame};
  }
  return end;
}

Pose joint_on(const DigitChain& chain, std::size_t i, const Vec3& position, const Quat& frame) {
  return {position, (frame * chain.joint_from_bone[i]).normalized()};
}

/// Of one hinge, the first of which has two.
void add_axes(const DigitChain& chain, const DigitAngles& angles, std::size_t hinge,
              const Quat& parent, const Vec3& position, DigitAxes& axes) {
  const std::size_t flexion = hinge + 1;
  axes.axis[flexion] = parent * -Vec3::UnitX();
  axes.center[flexion] = position;
  if (hinge != 0) return;
  axes.axis[0] = parent * (turn_x(-angles[0].flexion) * (side_sign(chain.side) * Vec3::UnitY()));
  axes.center[0] = position;
}

}  // namespace

HingeRange range_of_motion(Digit digit, std::size_t hinge) noexcept {
  constexpr double kFinger = 20.0 * kDegree;
  constexpr std::array<HingeRange, kHingeCount> kFingerRanges{{
      {-45.0 * kDegree, 90.0 * kDegree, -kFinger, kFinger},
      {0.0, 110.0 * kDegree, 0.0, 0.0},
      {-10.0 * kDegree, 85.0 * kDegree, 0.0, 0.0},
  }};
  constexpr std::array<HingeRange, kHingeCount> kThumbRanges{{
      {-20.0 * kDegree, 15.0 * kDegree, -35.0 * kDegree, 35.0 * kDegree},
      {0.0, 50.0 * kDegree, 0.0, 0.0},
      {-20.0 * kDegree, 80.0 * kDegree, 0.0, 0.0},
  }};
  return digit == Digit::thumb ? kThumbRanges[hinge] : kFingerRanges[hinge];
}

double DigitChain::length() const noexcept {
  double sum = 0.0;
  for (const Vec3& segment : bone) sum += segment.norm();
  return sum;
}

DigitChain measure_chain(const HandPose& hand, Digit digit) noexcept {
  DigitChain chain;
  chain.digit = digit;
  chain.side = hand.side;
  const double sign = side_sign(hand.side);
  const Pose& first = hand[hinge_joint(digit, 0)];
  chain.base = first.position;
  if (digit == Digit::thumb) {
    chain.parent_rotation = hand[Joint::wrist].rotation * relaxed_thumb(hand.side);
  } else {
    const Pose& metacarpal = hand[joints_of(digit).metacarpal];
    chain.parent_rotation = bone_frame(first.position - metacarpal.position, metacarpal.rotation);
  }
  Quat parent = chain.parent_rotation;
  for (std::size_t i = 0; i < kHingeCount; ++i) {
    const Pose& joint = hand[hinge_joint(digit, i)];
    const Vec3 bone_world = hand[hinge_joint(digit, i + 1)].position - joint.position;
    const Quat frame = bone_frame(bone_world, joint.rotation);
    chain.bone[i] = frame.conjugate() * bone_world;
    chain.joint_from_bone[i] = frame.conjugate() * joint.rotation;
    chain.angles[i] = angles_of(parent.conjugate() * frame, sign);
    parent = frame;
  }
  chain.joint_from_bone[kHingeCount] = parent.conjugate() * hand[joints_of(digit).tip].rotation;
  return chain;
}

HandAngles measure_angles(const HandPose& hand) noexcept {
  HandAngles angles;
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    angles[d] = measure_chain(hand, digit_at(d)).angles;
  }
  return angles;
}

DigitPose pose_chain(const DigitChain& chain, const DigitAngles& angles) noexcept {
  DigitPose pose;
  const auto take = [&](std::size_t i, const Quat&, const Vec3& position, const Quat& frame) {
    pose[i] = joint_on(chain, i, position, frame);
  };
  const BoneEnd end = go_along(chain, angles, take);
  pose[kHingeCount] = joint_on(chain, kHingeCount, end.position, end.frame);
  return pose;
}

DigitAxes chain_axes(const DigitChain& chain, const DigitAngles& angles) noexcept {
  DigitAxes axes;
  const auto take = [&](std::size_t i, const Quat& parent, const Vec3& position, const Quat&) {
    add_axes(chain, angles, i, parent, position, axes);
  };
  axes.tip = go_along(chain, angles, take).position;
  return axes;
}

PosedDigit pose_with_axes(const DigitChain& chain, const DigitAngles& angles) noexcept {
  PosedDigit posed;
  const auto take = [&](std::size_t i, const Quat& parent, const Vec3& position,
                        const Quat& frame) {
    add_axes(chain, angles, i, parent, position, posed.axes);
    posed.joints[i] = joint_on(chain, i, position, frame);
  };
  const BoneEnd end = go_along(chain, angles, take);
  posed.axes.tip = end.position;
  posed.joints[kHingeCount] = joint_on(chain, kHingeCount, end.position, end.frame);
  return posed;
}

DigitAngles turned_whole(const DigitChain& chain, const Quat& turn_world) noexcept {
  const double sign = side_sign(chain.side);
  const Quat& parent = chain.parent_rotation;
  DigitAngles angles = chain.angles;
  angles[0] = angles_of(
      parent.conjugate() * (turn_world * (parent * rotation_of(chain.angles[0], sign))), sign);
  return angles;
}

double curl_of(const DigitAngles& finger) noexcept { return finger[1].flexion + finger[2].flexion; }

double curl_of(const HandAngles& hand) noexcept {
  double sum = 0.0;
  for (const Digit digit : {Digit::index, Digit::middle, Digit::ring, Digit::little}) {
    sum += curl_of(hand[index_of(digit)]);
  }
  return sum / 4.0;
}

DigitFreedoms freedoms_of(const DigitAngles& angles) noexcept {
  return {angles[0].abduction, angles[0].flexion, angles[1].flexion, angles[2].flexion};
}

DigitAngles with_freedoms(const DigitAngles& angles, const DigitFreedoms& freedoms) noexcept {
  DigitAngles result = angles;
  result[0].abduction = freedoms[0];
  for (std::size_t i = 0; i < kHingeCount; ++i) {
    result[i].flexion = freedoms[static_cast<Eigen::Index>(i) + 1];
  }
  return result;
}

BendRange bend_range(const DigitChain& chain) noexcept {
  const HingeRange base = range_of_motion(chain.digit, 0);
  const HingeRange middle = range_of_motion(chain.digit, 1);
  const HingeRange last = range_of_motion(chain.digit, 2);
  const DigitFreedoms tracked = freedoms_of(chain.angles);
  const DigitFreedoms low(base.abduction_min, base.flexion_min, middle.flexion_min,
                          last.flexion_min);
  const DigitFreedoms high(base.abduction_max, base.flexion_max, middle.flexion_max,
                           last.flexion_max);
  return {low.cwiseMin(tracked), high.cwiseMax(tracked)};
}

void set_digit(HandPose& hand, Digit digit, const DigitPose& pose) noexcept {
  for (std::size_t i = 0; i <= kHingeCount; ++i) hand[hinge_joint(digit, i)] = pose[i];
}

}  // namespace nade
