#include "settle_fold.h"

#include <array>

#include "ramps.h"

namespace nade {
namespace {

/// A finger stands, more or less, whose cosine to the surface's normal is between these, and is
/// straight, whose share of its bones' length from knuckle to tip is between those.
constexpr double kLeans = 0.85;
constexpr double kStands = 0.95;
constexpr double kBent = 0.9;
constexpr double kStraight = 0.95;
/// A finger counts whose tip is pressed in so deep.
constexpr double kPressed_m = 0.004;
/// The torque, as of a spring of this stiffness bent by a radian.
constexpr double kTorque = 2.0;
/// From this lean on (sine) toward the palm fingers fold that way, and before it the other, where
/// they come to lie on their pulps; not by all of the torque within so much of it.
constexpr double kTurningLean = 0.1;
constexpr double kUndecided = 0.05;

/// Of a digit's freedoms.
constexpr int kKnuckleFlexion = 1;

/// A finger pressed against the surface.
struct Standing {
  double pressed = 0.0;  ///< 0 to 1
  double stands = 0.0;   ///< 0 to 1
  double lean = 0.0;     ///< sine, above 0 if the surface's push folds it toward the palm
};

Standing standing_of(const PosedHand& posed, Digit digit, const PatchTouch& patch) {
  Standing finger;
  if (!(patch.depth_m > 0.0)) return finger;
  const auto& joints = posed.hand.joints;
  const std::size_t knuckle = index_of(hinge_joint(digit, 0));
  const std::size_t tip = index_of(hinge_joint(digit, kHingeCount));
  double length_m = 0.0;
  for (std::size_t i = knuckle; i < tip; ++i) {
    length_m += (joints[i + 1].position - joints[i].position).norm();
  }
  const Vec3 reach = joints[tip].position - joints[knuckle].position;
  const double reach_m = reach.norm();
  if (!(reach_m > 0.0)) return finger;
  finger.pressed = smoothstep(0.0, kPressed_m, patch.depth_m);
  finger.stands = finger.pressed * smoothstep(kBent, kStraight, reach_m / length_m) *
                  smoothstep(kLeans, kStands, -reach.dot(patch.normal) / reach_m);
  finger.lean = motion_of(posed, tip).with_bend[kKnuckleFlexion].dot(patch.normal) / length_m;
  return finger;
}

}  // namespace

void fold_alike(const PosedHand& posed, const PatchTouches& patches, Springs& springs) noexcept {
  std::array<Standing, kDigitCount> fingers;
  double pressed = 0.0;
  double lean = 0.0;
  bool any = false;
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const Digit digit = digit_at(d);
    if (digit == Digit::thumb) continue;
    fingers[d] = standing_of(posed, digit, patches[index_of(part_of(digit))]);
    pressed += fingers[d].pressed;
    lean += fingers[d].pressed * fingers[d].lean;
    any = any || fingers[d].stands > 0.0;
  }
  if (!any) return;
  const double way = lean / pressed - kTurningLean;
  const double torque = kTorque * (2.0 * smoothstep(-kUndecided, kUndecided, way) - 1.0);
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    springs.force[first_freedom(d) + kKnuckleFlexion] += torque * fingers[d].stands;
  }
}

}  // namespace nade
