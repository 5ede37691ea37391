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
  std::array<float, kDigitCount + 1> shares{};
  for (std::size_t k = 0; k < point.joints.size() && point.shares[k].w() > 0.0F; ++k) {
    shares[kCarriers[point.joints[k]].digit] += point.shares[k].w();
  }
  const auto most = std::max_element(shares.begin(), shares.begin() + kDigitCount);
  return *most > 0.0F ? static_cast<std::size_t>(most - shares.begin()) : kDigitCount;
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
  flesh.palm = hand[Joint::palm].position;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Pose& joint = hand.joints[i];
    Eigen::Matrix4f& carry = flesh.carry[i];
    carry.topLeftCorner<3, 3>() = (scale * joint.rotation.toRotationMatrix()).cast<float>();
    carry.topRightCorner<3, 1>() = (joint.position - flesh.palm).cast<float>();
    carry.row(3) << 0.0F, 0.0F, 0.0F, 1.0F;
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
  Eigen::Vector4f reach = Eigen::Vector4f::Zero();
  std::array<Eigen::Vector4f, kDigitFreedoms> bent;  // what each freedom turns of it
  bent.fill(reach);
  for (std::size_t k = 0; k < point.joints.size() && point.shares[k].w() > 0.0F; ++k) {
    const Carrier& carrier = kCarriers[point.joints[k]];
    const Eigen::Vector4f share = posed.flesh.carried(point.joints[k], point.shares[k]);
    reach += share;
    if (carrier.digit != digit) continue;
    for (std::size_t f = 0; f < carrier.freedoms; ++f) bent[f] += share;
  }
  for (std::size_t f = 0; f < kDigitFreedoms && bent[f].w() > 0.0F; ++f) {
    const DigitAxes& axes = posed.axes[digit];
    const Eigen::Vector4d turned = bent[f].cast<double>();
    row.bend[static_cast<Eigen::Index>(f)] =
        direction.cross(axes.axis[f])
            .dot(turned.head<3>() - turned.w() * (axes.center[f] - posed.flesh.palm));
  }
  row.wrist.head<3>() = direction;
  row.wrist.tail<3>() = reach.head<3>().cast<double>().cross(direction);
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
      all[i].attach(0, i, 1.0, Vec3::Zero());
    }
    return all;
  }();
  return kPoints[joint];
}

}  // namespace nade
