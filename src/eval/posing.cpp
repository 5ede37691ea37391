#include "nade/eval/posing.h"

#include <cmath>
#include <numbers>

#include "nade/hand_mesh.h"

namespace nade {
namespace {

constexpr double kNear_m = 0.1;   // how far a point may lie off the surface
constexpr double kPalm_m = 0.03;  // half a palm's breadth
// A curl adds 45 degrees; the last joint follows the middle one at two thirds, as in free motion.
constexpr double kCurlMiddle_rad = 27.0 * kDegree;
constexpr double kCurlLast_rad = 18.0 * kDegree;
constexpr std::size_t kMiddleHinge = 1;
constexpr std::size_t kLastHinge = 2;
/// Toward the thumb's side: the digits fan out about the middle finger.
constexpr std::array<double, kDigitCount> kSpread_rad{10.0 * kDegree, 10.0 * kDegree, 0.0,
                                                      -10.0 * kDegree, -20.0 * kDegree};

}  // namespace

PosableHand::PosableHand(const HandPose& relaxed, Handedness side, double scale) {
  const HandPose sided = relaxed.side == side ? relaxed : mirrored(relaxed);
  hand_ = moved(sided, sided[Joint::palm].inverse());
  for (Pose& joint : hand_.joints) joint.position *= scale;
  for (double& radius : hand_.radius) radius *= scale;
  for (std::size_t i = 0; i < kDigitCount; ++i) chains_[i] = measure_chain(hand_, digit_at(i));
  palm_skin_depth_m_ = generic_skin_depths()[Part::palm] * hand_length(hand_) / kGenericHandLength;
}

HandPose PosableHand::posed(const HandShape& shape, const HandAngles& added) const {
  HandPose pose = hand_;
  for (std::size_t i = 0; i < kDigitCount; ++i) {
    DigitAngles angles = chains_[i].angles;
    angles[0].abduction += shape.spread * kSpread_rad[i];
    if (digit_at(i) != Digit::thumb) {
      angles[kMiddleHinge].flexion += shape.curl * kCurlMiddle_rad;
      angles[kLastHinge].flexion += shape.curl * kCurlLast_rad;
    }
    for (std::size_t hinge = 0; hinge < kHingeCount; ++hinge) {
      angles[hinge].flexion += added[i][hinge].flexion;
      angles[hinge].abduction += added[i][hinge].abduction;
    }
    set_digit(pose, digit_at(i), pose_chain(chains_[i], angles));
  }
  return pose;
}

Vec3 broad_normal(const Object& object, const Vec3& point, const Vec3& otherwise) {
  SurfaceHint hint;
  const auto center = object.closest_point(point, kNear_m, hint);
  if (!center) return otherwise;
  const Vec3 aside = center->normal.unitOrthogonal();
  const Vec3 forward = center->normal.cross(aside);
  constexpr int kSpokes = 8;
  Vec3 sum = center->normal;
  for (int i = 0; i < 2 * kSpokes; ++i) {
    const double angle = std::numbers::pi * i / kSpokes;
    const double radius = (i % 2 + 1) * 0.5 * kPalm_m;
    const auto near = object.closest_point(
        point + radius * (std::cos(angle) * aside + std::sin(angle) * forward), kNear_m, hint);
    // A thin part's far side is no part of what the palm lies on.
    if (near && near->normal.dot(center->normal) > 0.0) sum += near->normal;
  }
  return sum.normalized();
}

}  // namespace nade
