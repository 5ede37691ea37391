#include "nade/hand_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nade {
namespace {

constexpr double kOnePoint_m = 1e-3;
constexpr double kShortest_m = 0.06;
constexpr double kLongest_m = 0.13;
constexpr double kMostOffBone_rad = 30.0 * kDegree;
constexpr double kMostOffBack_rad = 45.0 * kDegree;
/// Below it another reading of the rotations fits the bones too well for chance.
constexpr double kFits_rad = 15.0 * kDegree;
constexpr double kMostBentBack = 0.2;  // sines, added
constexpr double kAlike = 1e-9;        // of the quaternions' dot product from 1
constexpr double kNoBone_m = 1e-6;

constexpr std::array<JointAxis, 6> kAxes{JointAxis::plus_x,  JointAxis::plus_y,
                                         JointAxis::plus_z,  JointAxis::minus_x,
                                         JointAxis::minus_y, JointAxis::minus_z};

/// Millimetres, centimetres, inches, feet, kilometres: in each of these no other could be meant.
constexpr std::array<double, 5> kUnits_m{1e-3, 1e-2, 0.0254, 0.3048, 1e3};

constexpr std::size_t kBoneCount = kJointCount - 2 - kDigitCount;
constexpr std::array<Joint, 5> kRigid{Joint::palm, Joint::index_metacarpal,
                                      Joint::middle_metacarpal, Joint::ring_metacarpal,
                                      Joint::little_metacarpal};

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

template <std::size_t N>
double median(std::array<double, N> values, std::size_t count) {
  if (count == 0) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

/// Between a local axis and the bones, median.
double off_bones(const HandPose& hand, JointAxis axis) {
  std::array<double, kBoneCount> angles{};
  std::size_t count = 0;
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const DigitJoints digit = joints_of(digit_at(d));
    for (std::size_t i = index_of(digit.metacarpal); i < index_of(digit.tip); ++i) {
      const Vec3 bone = hand.joints[i + 1].position - hand.joints[i].position;
      if (bone.norm() < kNoBone_m) continue;
      angles[count++] = angle_between(hand.joints[i].rotation * vector_of(axis), bone);
    }
  }
  return median(angles, count);
}

/// Out of the back of the hand, as wrist, knuckles and the side have it; zero where they do not.
Vec3 back_by_positions(const HandPose& hand) {
  const Vec3 ahead = hand[Joint::middle_proximal].position - hand[Joint::wrist].position;
  const Vec3 to_thumb =
      hand[Joint::index_proximal].position - hand[Joint::little_proximal].position;
  const Vec3 back = ahead.cross(to_thumb);
  return hand.side == Handedness::right ? back : Vec3(-back);
}

/// How far the fingers are bent to the back of the hand at their two last hinges: sines, added.
double bent_back(const HandPose& hand) {
  const Vec3 ahead = hand[Joint::middle_proximal].position - hand[Joint::wrist].position;
  const Vec3 hinge = ahead.cross(back_by_positions(hand)).normalized();
  double sum = 0.0;
  for (std::size_t d = 1; d < kDigitCount; ++d) {
    const auto bone = [&](std::size_t from_tip) {
      const std::size_t to = index_of(joints_of(digit_at(d)).tip) - from_tip;
      return Vec3((hand.joints[to].position - hand.joints[to - 1].position).normalized());
    };
    sum += (bone(2).cross(bone(1)) + bone(1).cross(bone(0))).dot(hinge);
  }
  return sum / (kDigitCount - 1);
}

/// Between a local axis of the rigid bones and the back of the hand, median.
double off_back(const HandPose& hand, JointAxis axis) {
  const Vec3 back = back_by_positions(hand);
  if (back.norm() < kNoBone_m * kNoBone_m)
    return axis == JointAxis::plus_y ? 0.0 : 0.5 * std::numbers::pi;
  std::array<double, kRigid.size()> angles{};
  for (std::size_t i = 0; i < kRigid.size(); ++i) {
    angles[i] = angle_between(hand[kRigid[i]].rotation * vector_of(axis), back);
  }
  return median(angles, angles.size());
}

/// The joints' axes as the positions have them.
struct Axes {
  JointAxis bone = JointAxis::minus_z;
  JointAxis back = JointAxis::plus_y;
  double off_bones_rad = 0.0;
};
Axes axes_of(const HandPose& hand) {
  Axes axes{JointAxis::minus_z, JointAxis::plus_y, off_bones(hand, JointAxis::minus_z)};
  double least_off_back = off_back(hand, JointAxis::plus_y);
  for (const JointAxis axis : kAxes) {
    if (const double off = off_bones(hand, axis); off < axes.off_bones_rad) {
      axes.bone = axis;
      axes.off_bones_rad = off;
    }
    if (const double off = off_back(hand, axis); off < least_off_back) {
      axes.back = axis;
      least_off_back = off;
    }
  }
  return axes;
}

bool all_turned_alike(const HandPose& hand) {
  const Quat& first = hand.joints.front().rotation;
  return std::all_of(hand.joints.begin(), hand.joints.end(), [&](const Pose& joint) {
    return std::abs(std::abs(joint.rotation.dot(first)) - 1.0) < kAlike;
  });
}

/// The hand with its rotations read as w, x, y, z.
HandPose with_w_first(const HandPose& hand) {
  HandPose result = hand;
  for (Pose& joint : result.joints) {
    const Quat& read = joint.rotation;
    joint.rotation = Quat(read.x(), read.y(), read.z(), read.w());
  }
  return result;
}

double extent(const HandPose& hand) {
  double farthest = 0.0;
  for (const Pose& joint : hand.joints) {
    farthest = std::max(farthest, (joint.position - hand[Joint::wrist].position).norm());
  }
  return farthest;
}

HandCause cause_of_turns(const HandPose& hand, const Axes& axes, bool alike) {
  if (alike) return HandCause::no_rotations;
  const Axes w_first = axes_of(with_w_first(hand));
  if (w_first.off_bones_rad < kFits_rad && w_first.off_bones_rad < axes.off_bones_rad) {
    return HandCause::quaternion_order;
  }
  if (axes.off_bones_rad > kMostOffBone_rad) return HandCause::unknown;
  if (axes.back == JointAxis::minus_y) {
    if (axes.bone == JointAxis::minus_z) return HandCause::swapped_sides;
    if (axes.bone == JointAxis::plus_z) return HandCause::mirrored;
  }
  return HandCause::other_bone_axes;
}

void check_turns(const HandPose& hand, HandCheck& check) {
  check.bone_angle_rad = off_bones(hand, JointAxis::minus_z);
  check.back_angle_rad = off_back(hand, JointAxis::plus_y);
  const bool alike = all_turned_alike(hand);
  const bool bones = check.bone_angle_rad > kMostOffBone_rad;
  const bool back = check.back_angle_rad > kMostOffBack_rad;
  check.doubts[static_cast<std::size_t>(HandDoubt::turns)] = alike;
  check.doubts[static_cast<std::size_t>(HandDoubt::bones)] = bones;
  check.doubts[static_cast<std::size_t>(HandDoubt::back)] = back;
  if (!alike && !bones && !back) {
    if (!(bent_back(hand) > kMostBentBack)) return;
    check.doubts[static_cast<std::size_t>(HandDoubt::bend)] = true;
    check.cause = HandCause::upside_down;
    return;
  }
  const Axes axes = axes_of(hand);
  check.bone_axis = axes.bone;
  check.back_axis = axes.back;
  check.cause = cause_of_turns(hand, axes, alike);
}

}  // namespace

HandCheck check_hand(const HandPose& hand) noexcept {
  HandCheck check;
  const HandPose unit = with_unit_rotations(hand);
  const std::optional<HandFault> fault = fault_of(unit);
  check.doubts[static_cast<std::size_t>(HandDoubt::unusable)] = fault.has_value();
  if (fault == HandFault::not_finite || fault == HandFault::rotation_not_unit) return check;
  check.length_m = hand_length(unit);
  if (!(check.length_m >= kShortest_m && check.length_m <= kLongest_m)) {
    check.doubts[static_cast<std::size_t>(HandDoubt::length)] = true;
    check.unit_m = unit_by_length(check.length_m);
  }
  if (!check.unit_m && extent(unit) < kOnePoint_m) {
    check.doubts[static_cast<std::size_t>(HandDoubt::collapsed)] = true;
    check.cause = HandCause::collapsed;
    return check;
  }
  check_turns(unit, check);
  if (!check.cause && check.has(HandDoubt::length)) {
    check.cause = check.unit_m ? HandCause::other_units : HandCause::unknown;
  }
  return check;
}

std::optional<double> unit_by_length(double length) noexcept {
  for (const double unit : kUnits_m) {
    if (unit * length >= kShortest_m && unit * length <= kLongest_m) return unit;
  }
  return std::nullopt;
}

std::string_view name_of(HandCause cause) {
  constexpr std::array<std::string_view, kHandCauseCount> kCauseNames{
      "all joints lie in one point, as where the hand was not tracked; leave it out there",
      "the positions look not to be in metres; convert them",
      "all joints are turned alike, as where rotations were never set; give each joint its own",
      "the quaternions look to have w first; write them as x, y, z, w",
      "the hand looks to be from a left-handed frame, as Unity's; negate z of the positions and x "
      "and y of the quaternions",
      "the fingers bend to the back of the hand, as where the frame is mirrored; negate y of the "
      "positions and x and z of the quaternions",
      "the hand looks to be of the other side; swap left and right or, where the frame is "
      "mirrored, negate x of the positions and y and z of the quaternions",
      "the joints look to have other axes; turn their rotations so that -Z points to the fingertip "
      "and +Y to the back of the hand",
      "positions, rotations and side disagree; expected -Z of each joint to the fingertip and +Y "
      "to the back of the hand",
  };
  return kCauseNames[static_cast<std::size_t>(cause)];
}

std::string_view name_of(JointAxis axis) {
  constexpr std::array<std::string_view, kAxes.size()> kAxisNames{"+X", "+Y", "+Z",
                                                                  "-X", "-Y", "-Z"};
  return kAxisNames[static_cast<std::size_t>(axis)];
}

Vec3 vector_of(JointAxis axis) noexcept {
  const auto index = static_cast<Eigen::Index>(axis);
  return (index < 3 ? 1.0 : -1.0) * Vec3::Unit(index % 3);
}

}  // namespace nade
