#include "convert.h"

#include <limits>

#include "arguments.h"

namespace nade::c_abi {
namespace {

constexpr double kShortestRotation = 0.5;
constexpr double kLongestRotation = 2.0;
constexpr double kLargestScale = std::numeric_limits<float>::max();

Quat quaternion_from(const float* values) {
  return {static_cast<double>(values[3]), static_cast<double>(values[0]),
          static_cast<double>(values[1]), static_cast<double>(values[2])};
}

bool can_be_unit(const Quat& rotation) {
  const double length = rotation.norm();
  return length >= kShortestRotation && length <= kLongestRotation;
}

/// Also where they are no numbers.
template <class Vector>
bool are_same(const Vector& one, const Vector& other) {
  return (one.array() == other.array() || (one.array().isNaN() && other.array().isNaN())).all();
}

nade_contact contact_from(const SkinContact& contact) {
  nade_contact result{};
  result.object = contact.object;
  result.bone = static_cast<std::int32_t>(contact.bone);
  result.depth_m = static_cast<float>(contact.depth_m);
  put_vector(contact.point, result.point);
  put_vector(contact.normal, result.normal);
  put_vector(contact.velocity_mps, result.velocity_mps);
  return result;
}

}  // namespace

HandPose hand_from(nade_side side, const nade_joint* joints) noexcept {
  HandPose hand;
  hand.side = side == NADE_LEFT ? Handedness::left : Handedness::right;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Quat rotation = quaternion_from(joints[i].rotation);
    hand.joints[i].rotation = can_be_unit(rotation) ? Quat(rotation.normalized()) : rotation;
    hand.joints[i].position = vector_from(joints[i].position);
    hand.radius[i] = static_cast<double>(joints[i].radius);
  }
  return hand;
}

nade_joint joint_from(const Pose& pose) noexcept {
  nade_joint joint{};
  for (int k = 0; k < 4; ++k) joint.rotation[k] = static_cast<float>(pose.rotation.coeffs()[k]);
  put_vector(pose.position, joint.position);
  return joint;
}

void put_hand(const HandPose& hand, const HandPose& tracked, const nade_joint* given,
              nade_joint* drawn) noexcept {
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Pose& pose = hand.joints[i];
    const Pose& seen = tracked.joints[i];
    const bool is_tracked = are_same(pose.position, seen.position) &&
                            are_same(pose.rotation.coeffs(), seen.rotation.coeffs());
    nade_joint joint = is_tracked ? given[i] : joint_from(pose);
    joint.radius = given[i].radius;
    drawn[i] = joint;
  }
}

Placement placement_from(const nade_placement* placement) noexcept {
  if (placement == nullptr) return {};
  return {{vector_from(placement->position), quaternion_from(placement->rotation).normalized()},
          static_cast<double>(placement->scale)};
}

nade_feel default_feel() noexcept {
  const SettleOptions defaults;
  return {sizeof(nade_feel),
          0,
          defaults.softness_m,
          defaults.softness_depth_m,
          defaults.friction.coefficient,
          defaults.friction.kinetic,
          defaults.friction.longest_lag_m};
}

SettleOptions feel_from(const nade_feel* feel) noexcept {
  if (feel == nullptr) return {};
  const nade_feel whole = with_defaults(*feel, default_feel());
  SettleOptions options;
  options.softness_m = whole.softness_m;
  options.softness_depth_m = whole.softness_depth_m;
  options.friction.coefficient = whole.friction;
  options.friction.kinetic = whole.friction_kinetic;
  options.friction.longest_lag_m = whole.longest_lag_m;
  return options;
}

nade_status check_feel(const nade_feel* feel) {
  if (feel == nullptr) return NADE_OK;
  const nade_status status = Arguments().read(feel, "feel").status();
  if (status != NADE_OK) return status;
  const Status checked = check_options(feel_from(feel));
  if (checked.ok()) return NADE_OK;
  return fail(NADE_ERROR_ARGUMENT, "feel: %s", checked.error().message.c_str());
}

nade_result result_from(const CorrectedHand& hand, const HandPose& tracked,
                        const nade_joint* given) noexcept {
  nade_result result{};
  result.status = static_cast<nade_hand_status>(hand.status);
  if (hand.fault) result.fault = 1 + static_cast<nade_fault>(*hand.fault);
  result.contact_count = static_cast<std::uint32_t>(hand.skin_contact_count);
  put_hand(hand.pose, tracked, given, result.joints);
  for (std::size_t i = 0; i < kJointCount; ++i) {
    put_vector(hand.velocity_mps[i], result.velocity_mps[i]);
  }
  for (std::size_t i = 0; i < hand.skin_contact_count; ++i) {
    result.contacts[i] = contact_from(hand.skin_contacts[i]);
  }
  return result;
}

Arguments& Arguments::placement(const nade_placement* placement) {
  if (placement == nullptr) return *this;
  finite(placement->rotation, 4, "placement: rotation");
  finite(placement->position, 3, "placement: position");
  within(static_cast<double>(placement->scale), 0.0, kLargestScale, "placement: scale");
  return expects(can_be_unit(quaternion_from(placement->rotation)), NADE_ERROR_ARGUMENT,
                 "placement: rotation: expected a quaternion of length 1");
}

}  // namespace nade::c_abi
