#pragma once

#include "nade.h"
#include "nade/corrector.h"

namespace nade::c_abi {

/// Rotations of a half to twice the unit length are made unit; others stay, and are a fault.
[[nodiscard]] HandPose hand_from(nade_side side, const nade_joint* joints) noexcept;

[[nodiscard]] nade_joint joint_from(const Pose& pose) noexcept;  ///< radius 0

/// Joints that are as they were tracked stay bit for bit: floats are not rounded twice. `drawn` may
/// be `given`.
void put_hand(const HandPose& hand, const HandPose& tracked, const nade_joint* given,
              nade_joint* drawn) noexcept;

/// As the checks of `Arguments` take them; NULL stands for the defaults.
[[nodiscard]] Placement placement_from(const nade_placement* placement) noexcept;
[[nodiscard]] SettleOptions feel_from(const nade_feel* feel) noexcept;
[[nodiscard]] nade_feel default_feel() noexcept;

/// NADE_OK, or the error of one that a corrector or scene would not take; NULL is none.
[[nodiscard]] nade_status check_feel(const nade_feel* feel);

[[nodiscard]] nade_result result_from(const CorrectedHand& hand, const HandPose& tracked,
                                      const nade_joint* given) noexcept;

template <class Values>
[[nodiscard]] Vec3 vector_from(const Values* values) noexcept {
  return {values[0], values[1], values[2]};
}

template <class Values>
void put_vector(const Vec3& vector, Values* values) noexcept {
  for (Eigen::Index i = 0; i < 3; ++i) values[i] = static_cast<Values>(vector[i]);
}

}  // namespace nade::c_abi
