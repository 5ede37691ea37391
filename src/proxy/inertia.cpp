#include "inertia.h"

#include <algorithm>
#include <cmath>

#include "ramps.h"

namespace nade {
namespace {

// Numerics: how firmly the speed bound holds, and from which excess on.
constexpr double kHoldStiffness = 1e6;
constexpr double kHeldLoosely = 1.05;
constexpr double kLoose_m = 1e-6;
/// A hand whose skin is pressed in deeper than surely pressed rests on the object; so many times as
/// deep, it surely does.
constexpr double kSurelyRests = 5.0;

}  // namespace

JointVectors coasted_joints(const ProxyTuning& tuning, const ProxyState& state,
                            const HandPose& tracked, const Vec3& moved, double seconds) noexcept {
  const SettledFrame& last = *state.last;
  const double kept_s = seconds * std::exp(-seconds / tuning.offset_time_s);
  const Vec3& normal = state.touch.normal;
  const double rests =
      smoothstep(tuning.pressed_m, kSurelyRests * tuning.pressed_m, state.touch.deepest_m);
  JointVectors coasted;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Vec3 offset = last.drawn.joints[i].position - last.tracked.joints[i].position;
    coasted[i] = tracked.joints[i].position + offset + moved + kept_s * state.offset_velocity[i];
    const Vec3 own = last.drawn.joints[i].position +
                     seconds * (state.motion.velocity[i] + state.offset_velocity[i]);
    coasted[i] -= rests * std::max(0.0, normal.dot(coasted[i] - own)) * normal;
  }
  return coasted;
}

bool hold_back(const HandPose& last, const HandPose& next, double most_m, const PosedHand& posed,
               const HandFreedoms& step, std::vector<ContactTerm>& terms) noexcept {
  const auto way_of = [&](std::size_t joint) -> Vec3 {
    return next.joints[joint].position - last.joints[joint].position;
  };
  bool any = false;
  const auto hold = [&](std::size_t joint) {
    const Vec3 way = way_of(joint);
    const double length_m = way.norm();
    if (length_m <= kHeldLoosely * most_m + kLoose_m || terms.size() == terms.capacity()) return;
    ContactTerm& term = terms.emplace_back();
    term.kind = ContactKind::speed;
    term.stiffness = kHoldStiffness;
    term.row = motion_along(posed, joint_point(joint), -way / length_m);
    term.row.gap_m = most_m - length_m - gap_after(term.row, step);
    any = true;
  };
  hold(index_of(Joint::wrist));
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const DigitJoints joints = joints_of(digit_at(d));
    std::size_t farthest = index_of(joints.tip);
    for (std::size_t i = index_of(joints.metacarpal); i < index_of(joints.tip); ++i) {
      if (way_of(i).squaredNorm() > way_of(farthest).squaredNorm()) farthest = i;
    }
    hold(farthest);
  }
  return any;
}

}  // namespace nade
