#pragma once

#include <array>
#include <cstdint>

#include "freedoms.h"
#include "nade/correction.h"
#include "nade/flesh.h"

namespace nade {

/// A tracked hand as something that can be moved: wrist and digits.
struct HandModel {
  HandPose tracked;
  double scale = 1.0;
  std::array<DigitChain, kDigitCount> chains{};
  std::array<BendRange, kDigitCount> ranges{};  ///< `bend_range`, as changes of the tracked angles
};
[[nodiscard]] HandModel measure_model(const HandPose& tracked, double scale) noexcept;

/// Where the joints carry the flesh.
struct PosedFlesh {
  Vec3 palm = Vec3::Zero();
  /// Rotation times scale, and the origin as seen from `palm`: in four floats, which processors add
  /// at once.
  std::array<Eigen::Matrix4f, kJointCount> carry{};

  [[nodiscard]] Vec3 origin(std::size_t joint) const noexcept {
    return palm + carry[joint].col(3).head<3>().cast<double>();
  }

  /// A joint's share in a point's place, as seen from `palm`; and its weight.
  [[nodiscard]] Eigen::Vector4f carried(std::size_t joint,
                                        const Eigen::Vector4f& share) const noexcept {
    const Eigen::Matrix4f& by = carry[joint];
    return by.col(0) * share.x() + by.col(1) * share.y() + by.col(2) * share.z() +
           by.col(3) * share.w();
  }

  [[nodiscard]] Vec3 position(const FleshPoint& point) const noexcept {
    Eigen::Vector4f sum = Eigen::Vector4f::Zero();
    for (std::size_t k = 0; k < point.joints.size() && point.shares[k].w() > 0.0F; ++k) {
      sum += carried(point.joints[k], point.shares[k]);
    }
    return palm + sum.head<3>().cast<double>();
  }
};
[[nodiscard]] PosedFlesh pose_flesh(const HandPose& hand, double scale) noexcept;

/// The hand with a correction applied, ready for derivatives.
struct PosedHand {
  HandPose hand;
  std::array<DigitAxes, kDigitCount> axes{};
  PosedFlesh flesh;
};
[[nodiscard]] PosedHand pose_hand(const HandModel& model, const Correction& correction) noexcept;

/// How far the point moves along `direction` with the hand's freedoms: the wrist shifted, and
/// turned about the palm, along and about the object's axes; the bends of the one digit that moves
/// it most. The row's gap is left 0.
[[nodiscard]] ContactRow motion_along(const PosedHand& posed, const FleshPoint& point,
                                      const Vec3& direction) noexcept;

/// A joint's origin as a point of the hand.
[[nodiscard]] const FleshPoint& joint_point(std::size_t joint) noexcept;

/// How a joint moves: with a turn of the wrist about the palm, and with each bend of its digit that
/// moves it.
struct JointMotion {
  Vec3 reach = Vec3::Zero();        ///< from the palm
  std::size_t digit = kDigitCount;  ///< kDigitCount: none, the joint goes with the wrist
  std::size_t bends = 0;
  std::array<Vec3, kDigitFreedoms> with_bend;  ///< a radian, as many as `bends`
};
[[nodiscard]] JointMotion motion_of(const PosedHand& posed, std::size_t joint) noexcept;

}  // namespace nade
