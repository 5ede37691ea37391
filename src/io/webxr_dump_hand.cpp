#include "webxr_dump_hand.h"

// Based on: W3C. WebXR Hand Input Module, Level 1. (joint names, fillPoses, fillJointRadii)

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "recording_limits.h"

namespace nade::io {
namespace {

constexpr std::size_t kPageJoints = kJointCount - 1;  // all but the palm
constexpr std::size_t kMatrixNumbers = 16;
/// How far from the last row of a rigid transform, and from a rotation's axes.
constexpr double kMatrixTolerance = 1e-2;

/// An element of an array, or of a typed array, which JSON.stringify writes as an object of
/// indices; none where it has none.
const Json* element_of(const Json& list, std::size_t index) {
  if (list.is_array()) return index < list.size() ? &list[index] : nullptr;
  if (!list.is_object()) return nullptr;
  const auto found = list.find(std::to_string(index));
  return found == list.end() ? nullptr : &*found;
}

std::optional<double> finite_in(const Json* value) {
  if (value == nullptr || !value->is_number()) return std::nullopt;
  const double number = value->get<double>();
  if (!(std::abs(number) <= kFarthest_m)) return std::nullopt;
  return number;
}

/// N numbers in an array or under x, y, z, w.
template <std::size_t N>
std::optional<std::array<double, N>> numbers_in(const Json* value) {
  if (value == nullptr) return std::nullopt;
  constexpr std::array<const char*, 4> kAxes{"x", "y", "z", "w"};
  std::array<double, N> numbers{};
  for (std::size_t k = 0; k < N; ++k) {
    const Json* element = element_of(*value, k);
    if constexpr (N <= kAxes.size()) {
      if (value->is_object() && value->contains(kAxes[k])) element = &(*value)[kAxes[k]];
    }
    const std::optional<double> number = finite_in(element);
    if (!number) return std::nullopt;
    numbers[k] = *number;
  }
  return numbers;
}

/// A rigid transform from 16 numbers, column by column; none where they are none.
std::optional<Pose> pose_of_matrix(const std::array<double, kMatrixNumbers>& numbers) {
  const Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix4d>(numbers.data());
  const Eigen::RowVector4d last(0.0, 0.0, 0.0, 1.0);
  if ((matrix.row(3) - last).norm() > kMatrixTolerance) return std::nullopt;
  const Eigen::Matrix3d axes = matrix.topLeftCorner<3, 3>();
  const Eigen::Matrix3d product = axes.transpose() * axes;
  if ((product - Eigen::Matrix3d::Identity()).norm() > kMatrixTolerance) return std::nullopt;
  if (axes.determinant() < 0.0) return std::nullopt;
  return Pose{matrix.topRightCorner<3, 1>(), Quat(axes).normalized()};
}

/// The first of the keys that an object has; none where it has none.
const Json* member_of(const Json& object, std::initializer_list<const char*> keys) {
  if (!object.is_object()) return nullptr;
  for (const char* key : keys) {
    const auto found = object.find(key);
    if (found != object.end()) return &*found;
  }
  return nullptr;
}

/// A joint from its position and rotation or its matrix, which may be in its "transform".
std::optional<Pose> pose_of_joint(const Json& joint) {
  const Json* const inner = member_of(joint, {"transform", "pose"});
  const Json& pose = inner == nullptr ? joint : *inner;
  if (const Json* const matrix = member_of(pose, {"matrix"})) {
    const auto numbers = numbers_in<kMatrixNumbers>(matrix);
    return numbers ? pose_of_matrix(*numbers) : std::nullopt;
  }
  const auto p = numbers_in<3>(member_of(pose, {"position"}));
  const auto q = numbers_in<4>(member_of(pose, {"orientation", "rotation", "quaternion"}));
  if (!p || !q) return std::nullopt;
  return Pose{{(*p)[0], (*p)[1], (*p)[2]}, Quat((*q)[3], (*q)[0], (*q)[1], (*q)[2])};
}

std::optional<Joint> joint_of_page(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return joint_from_webxr_name(name);
}

using KnownJoints = std::array<bool, kJointCount>;

Result<KnownJoints> read_named_joints(const Json& joints, const std::string& place,
                                      HandPose& pose) {
  KnownJoints known{};
  for (const auto& [name, value] : joints.items()) {
    // Words and numbers describe the hand ("handedness").
    if (value.is_string() || value.is_number() || value.is_boolean()) continue;
    const std::optional<Joint> joint = joint_of_page(name);
    if (!joint) {
      return Error{
          ErrorCode::bad_value,
          fmt::format("{}: expected the name of a WebXR joint, found \"{}\"", place, name)};
    }
    const std::optional<Pose> joint_pose = pose_of_joint(value);
    if (!joint_pose) continue;
    known[index_of(*joint)] = true;
    pose[*joint] = *joint_pose;
    const std::optional<double> radius = finite_in(member_of(value, {"radius"}));
    pose.radius[index_of(*joint)] = std::max(radius.value_or(0.0), 0.0);
  }
  return known;
}

/// The matrices of all joints in one array, or in an array for each.
KnownJoints read_matrices(const Json& matrices, const Json* radii, HandPose& pose) {
  KnownJoints known{};
  const Json* const first = element_of(matrices, 0);
  const bool nested = first != nullptr && first->is_structured();
  for (std::size_t i = 0; i < kPageJoints; ++i) {
    std::array<double, kMatrixNumbers> numbers{};
    bool whole = true;
    for (std::size_t k = 0; k < kMatrixNumbers; ++k) {
      const Json* const row = nested ? element_of(matrices, i) : &matrices;
      const std::optional<double> number = finite_in(
          row == nullptr ? nullptr : element_of(*row, nested ? k : kMatrixNumbers * i + k));
      whole = whole && number;
      numbers[k] = number.value_or(0.0);
    }
    const std::optional<Pose> joint = whole ? pose_of_matrix(numbers) : std::nullopt;
    if (!joint) continue;
    known[i + 1] = true;
    pose.joints[i + 1] = *joint;
    const Json* const radius = radii == nullptr ? nullptr : element_of(*radii, i);
    pose.radius[i + 1] = std::max(finite_in(radius).value_or(0.0), 0.0);
  }
  return known;
}

std::size_t count_of(const Json& list) { return list.is_structured() ? list.size() : 0; }

}  // namespace

Result<std::optional<HandPose>> hand_of_page(const Json& hand, Handedness side,
                                             const std::string& place, std::string& missing) {
  const Json* const inner = member_of(hand, {"joints"});
  const Json& joints = inner == nullptr ? hand : *inner;
  if (!joints.is_object()) {
    return Error{ErrorCode::bad_value,
                 fmt::format("{}: expected the joints of a hand by their names, found {}", place,
                             kind_of(joints))};
  }
  HandPose pose;
  pose.side = side;
  KnownJoints known{};
  if (const Json* const matrices = member_of(joints, {"matrices", "transforms", "poses"})) {
    const std::size_t count = count_of(*matrices);
    if (!matrices->is_null() && count != kPageJoints && count != kPageJoints * kMatrixNumbers) {
      return Error{ErrorCode::bad_value,
                   fmt::format("{}: expected {} matrices of {} numbers, found {}", place,
                               kPageJoints, kMatrixNumbers, count)};
    }
    known = read_matrices(*matrices, member_of(joints, {"radii"}), pose);
  } else {
    const Result<KnownJoints> named = read_named_joints(joints, place, pose);
    if (!named) return named.error();
    known = *named;
  }
  for (std::size_t i = 1; i < kJointCount; ++i) {
    if (known[i]) continue;
    missing = std::string(name_of(joint_at(i)));
    return std::optional<HandPose>();
  }
  if (!known[index_of(Joint::palm)]) pose[Joint::palm] = palm_from_middle_metacarpal(pose);
  return std::optional<HandPose>(pose);
}

}  // namespace nade::io
