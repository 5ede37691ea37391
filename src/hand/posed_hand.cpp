#include "posed_hand.h"

#include <algorithm>

namespace nade {
namespace {

/// The digit that carries a joint, and how many of its freedoms move it.
struct Carrier {
  std::size_t digit = kDigitCount;  ///< kDigitCount: none, the joint goes with the wrist
  std::size_t freedoms = 0;
};

constexpr std::array<Carrier, kJointCount> make_carriers() {
  std::array<Carrier, kJointCount> carriers{};
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    for (std::size_t hinge = 0; hinge <= kHingeCount; ++hinge) {
      // The first hinge has two freedoms; the tip goes with the last bone.
      carriers[index_of(hinge_joint(digit_at(d), hinge))] = {d,
                                                             std::min(hinge + 2, kDigitFreedoms)};
    }
  }
  return carriers;
}
constexpr std::array<Carrier, kJointCount> kCarriers = make_carriers();

/// The digit that moves a point most; kDigitCount where none does.
std::size_t leading_digit(const FleshPoint& point) {
  std::array<double, kDigitCount + 1> shares{};
  for (std::size_t k = 0; k < point.joints.size(); ++k) {
    shares[kCarriers[point.joints[k]].digit] += point.weights[k];
  }
  const auto most = std::max_element(shares.begin(), shares.begin() + kDigitCount);
  return *most > 0.0 ? static_cast<std::size_t>(most - shares.begin()) : kDigitCount;
}

/// What one freedom of a digit does to a point: the share of it that turns about an axis, and the
/// way there from the axis.
struct Arm {
  Eigen::Index freedom;
  double share;
  const Vec3& axis;
  Vec3 reach;
};

/// The arms of a point with the freedoms of one digit, if any; gives where the point is.
template <class Take>
Vec3 for_each_arm(const PosedHand& posed, const FleshPoint& point, std::size_t digit, Take take) {
  Vec3 position = Vec3::Zero();
  for (std::size_t k = 0; k < point.joints.size() && point.weights[k] > 0.0; ++k) {
    const std::size_t joint = point.joints[k];
    const Vec3 carried = posed.flesh.carried(joint, point.local[k]).head<3>();
    position += point.weights[k] * carried;
    if (digit == kDigitCount || kCarriers[joint].digit != digit) continue;
    const DigitAxes& axes = posed.axes[digit];
    for (std::size_t f = 0; f < kCarriers[joint].freedoms; ++f) {
      take(Arm{static_cast<Eigen::Index>(f), point.weights[k], axes.axis[f],
               carried - axes.center[f]});
    }
  }
  return position;
}

}  // namespace

HandModel measure_model(const HandPose& tracked, double scale) noexcept {
  HandModel model;
  model.tracked = tracked;
  model.scale = scale;
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    model.chains[d] = measure_chain(tracked, digit_at(d));
    const BendRange range = bend_range(model.chains[d]);
    const DigitFreedoms bent = freedoms_of(model.chains[d].angles);
    model.ranges[d] = {range.low - bent, range.high - bent};
  }
  return model;
}

PosedFlesh pose_flesh(const HandPose& hand, double scale) noexcept {
  PosedFlesh flesh;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Pose& joint = hand.joints[i];
    flesh.carry[i].topLeftCorner<3, 3>() = scale * joint.rotation.toRotationMatrix();
    flesh.carry[i].topRightCorner<3, 1>() = joint.position;
    flesh.carry[i].row(3).setZero();
  }
  return flesh;
}

PosedHand pose_hand(const HandModel& model, const Correction& correction) noexcept {
  PosedHand posed;
  posed.hand = apply(correction.palm, model.tracked);
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    DigitChain chain = model.chains[d];
    chain.base = posed.hand[hinge_joint(chain.digit, 0)].position;
    chain.parent_rotation = (correction.palm.turn * chain.parent_rotation).normalized();
    const DigitAngles angles =
        with_freedoms(chain.angles, freedoms_of(chain.angles) + correction.bend[d]);
    if (correction.bend[d].isZero(0.0)) {
      posed.axes[d] = chain_axes(chain, angles);
      continue;
    }
    const PosedDigit digit = pose_with_axes(chain, angles);
    posed.axes[d] = digit.axes;
    set_digit(posed.hand, chain.digit, digit.joints);
  }
  posed.flesh = pose_flesh(posed.hand, model.scale);
  return posed;
}

ContactRow motion_along(const PosedHand& posed, const FleshPoint& point,
                        const Vec3& direction) noexcept {
  ContactRow row;
  const std::size_t digit = leading_digit(point);
  const Vec3 position = for_each_arm(posed, point, digit, [&](const Arm& arm) {
    row.bend[arm.freedom] += arm.share * arm.axis.dot(arm.reach.cross(direction));
  });
  row.wrist.head<3>() = direction;
  row.wrist.tail<3>() = (position - posed.hand[Joint::palm].position).cross(direction);
  if (digit != kDigitCount) row.digit = digit_at(digit);
  return row;
}

JointMotion motion_of(const PosedHand& posed, std::size_t joint) noexcept {
  const Carrier& carrier = kCarriers[joint];
  const Vec3& position = posed.hand.joints[joint].position;
  JointMotion motion;
  motion.reach = position - posed.hand[Joint::palm].position;
  motion.digit = carrier.digit;
  motion.bends = carrier.freedoms;
  for (std::size_t f = 0; f < carrier.freedoms; ++f) {
    const DigitAxes& axes = posed.axes[carrier.digit];
    motion.with_bend[f] = axes.axis[f].cross(position - axes.center[f]);
  }
  return motion;
}

const FleshPoint& joint_point(std::size_t joint) noexcept {
  static const auto kPoints = [] {
    std::array<FleshPoint, kJointCount> all;
    for (std::size_t i = 0; i < kJointCount; ++i) {
      all[i].joints[0] = static_cast<std::uint8_t>(i);
      all[i].weights[0] = 1.0;
    }
    return all;
  }();
  return kPoints[joint];
}

}  // namespace nade
