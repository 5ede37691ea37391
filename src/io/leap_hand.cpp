#include "leap_hand.h"

// Based on: WebXR Input Profiles. generic-hand, @webxr-input-profiles/assets 1.0.20. (its rest
// pose gives the proportions of what a Leap Motion does not report)
// Based on: Kabsch. A Solution for the Best Rotation to Relate Two Sets of Vectors. 1976.

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <optional>

#include "../ramps.h"
#include "nade/assert.h"

namespace nade::io {
namespace {

/// The rest pose of the right generic hand, seen from its wrist. Metres.
struct RestFinger {
  Vec3 metacarpal;
  Vec3 knuckle;
  double metacarpal_roll_deg;  ///< of +X about the bone, from the wrist's +X
  double finger_roll_deg;
};
const std::array<RestFinger, 4> kRest{{
    {{-0.01016, -0.00706, -0.02921}, {-0.02355, -0.00732, -0.08855}, -2.4, -2.0},
    {{-0.00343, -0.00605, -0.02911}, {-0.00173, -0.00254, -0.09165}, 6.7, 1.9},
    {{0.00810, -0.00605, -0.02699}, {0.01747, -0.00653, -0.08469}, 14.5, 8.7},
    {{0.02300, -0.00942, -0.03407}, {0.03505, -0.01369, -0.07390}, 25.2, 17.0},
}};
const Vec3 kRestThumbBone = {-0.5206, -0.4660, -0.7154};
const Vec3 kRestThumbHinge = {-0.073, 0.862, -0.501};

/// Below the first a finger counts as straight, above the second as bent: sines of the bends at
/// its two hinges, added.
constexpr double kStraight = 0.17;
constexpr double kBent = 0.5;
/// The same for how well the plane of the bend agrees with the rest pose (cosine).
constexpr double kPlaneAstray = 0.5;
constexpr double kPlaneAgrees = 0.8;
constexpr double kShortestBone_m = 1e-6;

/// The rotation whose -Z is `forward` and whose +X is nearest to `right`; none where they are
/// parallel or have no length.
std::optional<Quat> facing(const Vec3& forward, const Vec3& right) {
  const double length = forward.norm();
  if (!(length > kShortestBone_m)) return std::nullopt;
  const Vec3 z = -forward / length;
  const Vec3 across = right - right.dot(z) * z;
  if (!(across.norm() > kShortestBone_m)) return std::nullopt;
  const Vec3 x = across.normalized();
  Eigen::Matrix3d axes;
  axes << x, z.cross(x), z;
  return Quat(Quat(axes).normalized());
}

Vec3 unit_or(const Vec3& vector, const Vec3& fallback) {
  const double length = vector.norm();
  return length > kShortestBone_m ? Vec3(vector / length) : fallback;
}

/// The hinge axis (+X) of a finger whose three bones point along `bones`: across the plane in
/// which it bends, and `rest` where it is straight. `rest` is taken across the first bone.
Vec3 hinge_of(const std::array<Vec3, 3>& bones, const Vec3& rest) {
  const Vec3 across = unit_or(rest - rest.dot(bones[0]) * bones[0], rest);
  const Vec3 bend = bones[1].cross(bones[0]) + bones[2].cross(bones[1]);
  const double amount = bend.norm();
  if (!(amount > kStraight)) return across;
  const double agreement = bend.dot(across) / amount;
  const double weight = smoothstep(kStraight, kBent, amount) *
                        smoothstep(kPlaneAstray, kPlaneAgrees, std::abs(agreement));
  // A finger bent backwards turns about the same hinge the other way.
  const Vec3 measured = bend / (agreement < 0.0 ? -amount : amount);
  return unit_or((1.0 - weight) * across + weight * measured, across);
}

Vec3 rolled(const Vec3& right, const Vec3& bone, double roll_deg) {
  const Vec3 across = unit_or(right - right.dot(bone) * bone, right);
  return Eigen::AngleAxisd(roll_deg * kDegree, bone) * across;
}

/// What is the same for all joints of one hand, which is a right one.
struct PalmFrame {
  Quat rotation;
  double scale;  ///< over the generic hand
  Vec3 wrist;

  [[nodiscard]] Vec3 turned(const Vec3& wrist_frame) const { return rotation * wrist_frame; }
};

std::optional<PalmFrame> palm_frame(const LeapHand& leap) {
  const std::optional<Quat> rotation =
      facing(leap.direction, leap.direction.cross(-leap.palm_normal));
  if (!rotation) return std::nullopt;
  const Vec3& index = leap.fingers[index_of(Digit::index)].mcp;
  const Vec3& middle = leap.fingers[index_of(Digit::middle)].mcp;
  const Vec3& little = leap.fingers[index_of(Digit::little)].mcp;
  const double scale = (index - little).norm() / (kRest[0].knuckle - kRest[3].knuckle).norm();
  if (leap.wrist) return PalmFrame{*rotation, scale, *leap.wrist};
  // Sideways the palm's own axis is the better guide: the device spreads its knuckles a little
  // differently about the middle one than the generic hand does.
  const Vec3 knuckle = rotation->conjugate() * (middle - leap.palm);
  const Vec3 wrist(0.0, knuckle.y() - scale * kRest[1].knuckle.y(),
                   knuckle.z() - scale * kRest[1].knuckle.z());
  return PalmFrame{*rotation, scale, leap.palm + *rotation * wrist};
}

/// The base of a metacarpal: where the generic hand has it, carried along by its share of how
/// far this hand's knuckle lies from the generic one.
Vec3 metacarpal_base(const PalmFrame& palm, const RestFinger& rest, const Vec3& knuckle) {
  const double share = rest.metacarpal.norm() / rest.knuckle.norm();
  const Vec3 offset = palm.rotation.conjugate() * (knuckle - palm.wrist);
  const Vec3 base = palm.scale * rest.metacarpal + share * (offset - palm.scale * rest.knuckle);
  return palm.wrist + palm.turned(base);
}

void place_finger(const PalmFrame& palm, const LeapFinger& leap, std::size_t finger,
                  HandPose& hand) {
  const std::size_t first = index_of(joints_of(digit_at(finger + 1)).metacarpal);
  const RestFinger& rest = kRest[finger];
  const Vec3 base = leap.metacarpal.value_or(metacarpal_base(palm, rest, leap.mcp));
  const std::array<Vec3, 5> points{base, leap.mcp, leap.pip, leap.dip, leap.tip};
  const Vec3 ahead = palm.turned(-Vec3::UnitZ());
  const Vec3 right = palm.turned(Vec3::UnitX());
  std::array<Vec3, 4> bones;
  for (std::size_t i = 0; i < bones.size(); ++i) {
    bones[i] = unit_or(points[i + 1] - points[i], i == 0 ? ahead : bones[i - 1]);
  }
  const Vec3 hinge =
      hinge_of({bones[1], bones[2], bones[3]}, rolled(right, bones[1], rest.finger_roll_deg));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& bone = bones[std::min(i, bones.size() - 1)];
    const Vec3 across = i == 0 ? rolled(right, bone, rest.metacarpal_roll_deg) : hinge;
    hand.joints[first + i] = {points[i], facing(bone, across).value_or(palm.rotation)};
  }
}

void place_thumb(const PalmFrame& palm, const LeapFinger& leap, HandPose& hand) {
  const std::size_t first = index_of(Joint::thumb_metacarpal);
  const std::array<Vec3, 4> points{leap.mcp, leap.pip, leap.dip, leap.tip};
  std::array<Vec3, 3> bones;
  for (std::size_t i = 0; i < bones.size(); ++i) {
    bones[i] = unit_or(points[i + 1] - points[i],
                       i == 0 ? palm.turned(kRestThumbBone.normalized()) : bones[i - 1]);
  }
  // The thumb swings far from its rest pose and takes its hinge along on the shortest way.
  const Vec3 bone_palm = palm.rotation.conjugate() * bones[0];
  const Quat swing = Quat::FromTwoVectors(kRestThumbBone, bone_palm);
  const Vec3 hinge = hinge_of(bones, palm.turned(swing * kRestThumbHinge));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& bone = bones[std::min(i, bones.size() - 1)];
    hand.joints[first + i] = {points[i], facing(bone, hinge).value_or(palm.rotation)};
  }
}

Vec3 mirrored(const Vec3& vector) { return {-vector.x(), vector.y(), vector.z()}; }

LeapHand mirrored(const LeapHand& leap) {
  LeapHand result = leap;
  result.side = leap.side == Handedness::left ? Handedness::right : Handedness::left;
  result.palm = mirrored(leap.palm);
  if (leap.wrist) result.wrist = mirrored(*leap.wrist);
  result.palm_normal = mirrored(leap.palm_normal);
  result.direction = mirrored(leap.direction);
  for (LeapFinger& finger : result.fingers) {
    for (Vec3* const point : {&finger.mcp, &finger.pip, &finger.dip, &finger.tip}) {
      *point = mirrored(*point);
    }
    if (finger.metacarpal) finger.metacarpal = mirrored(*finger.metacarpal);
  }
  return result;
}

/// How a right hand's palm is turned whose knuckles lie so from its wrist.
Quat turn_of_palm(const std::array<Vec3, kRest.size()>& knuckles) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < knuckles.size(); ++i) {
    sum += knuckles[i] * kRest[i].knuckle.transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  const Eigen::Matrix3d turn =
      svd.matrixU() * Vec3(1.0, 1.0, sign).asDiagonal() * svd.matrixV().transpose();
  return Quat(turn).normalized();
}

}  // namespace

HandPose hand_from_leap(const LeapHand& leap) {
  if (leap.side == Handedness::left) return nade::mirrored(hand_from_leap(mirrored(leap)));
  HandPose hand;
  hand.confidence = leap.confidence;
  const std::optional<PalmFrame> palm = palm_frame(leap);
  if (!palm) {
    // No pose at all rather than one that looks like a hand.
    hand[Joint::palm].rotation.coeffs().setZero();
    return hand;
  }
  hand[Joint::wrist] = {palm->wrist, palm->rotation};
  place_thumb(*palm, leap.fingers[index_of(Digit::thumb)], hand);
  for (std::size_t finger = 0; finger < kRest.size(); ++finger) {
    place_finger(*palm, leap.fingers[finger + 1], finger, hand);
  }
  hand[Joint::palm] = {palm_from_middle_metacarpal(hand).position, palm->rotation};
  return hand;
}

HandPose hand_from_wrist_and_fingers(LeapHand leap) {
  NADE_ASSERT(leap.wrist.has_value());
  if (leap.side == Handedness::left) {
    return nade::mirrored(hand_from_wrist_and_fingers(mirrored(leap)));
  }
  std::array<Vec3, kRest.size()> knuckles;
  for (std::size_t i = 0; i < knuckles.size(); ++i) {
    knuckles[i] = leap.fingers[i + 1].mcp - *leap.wrist;
  }
  const Quat turn = turn_of_palm(knuckles);
  leap.direction = turn * -Vec3::UnitZ();
  leap.palm_normal = turn * -Vec3::UnitY();
  leap.palm = *leap.wrist;
  return hand_from_leap(leap);
}

}  // namespace nade::io
