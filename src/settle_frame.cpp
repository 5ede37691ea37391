#include "settle_frame.h"

#include <cmath>

namespace nade {
namespace {

/// Metres, and parts of a quaternion: far above what rounding does to a hand some metres from the
/// origin, and far below what can be seen.
constexpr double kGrid = 1.0 / (1 << 24);

Pose on_grid(const Pose& pose) {
  Pose result;
  for (int axis = 0; axis < 3; ++axis) result.position[axis] = rounded(pose.position[axis]);
  for (int part = 0; part < 4; ++part) {
    result.rotation.coeffs()[part] = rounded(pose.rotation.coeffs()[part]);
  }
  result.rotation.normalize();
  return result;
}

}  // namespace

double rounded(double scale) noexcept { return kGrid * std::nearbyint(scale / kGrid); }

HandPose seen_from(const Pose& home, const HandPose& hand) noexcept {
  HandPose result = moved(hand, home.inverse());
  for (Pose& joint : result.joints) joint = on_grid(joint);
  return result;
}

Object seen_from(const Pose& home, const Object& object) noexcept {
  const Placement& placement = object.placement();
  return Object(object.surface(), {on_grid(home.inverse() * placement.pose), placement.scale});
}

SettledHand brought_back(const Pose& home, const HandPose& tracked, SettledHand settled) noexcept {
  settled.hand = settled.corrected ? moved(settled.hand, home) : tracked;
  for (std::optional<PartContact>& contact : settled.contacts) {
    if (!contact) continue;
    for (Vec3* point : {&contact->ray_origin, &contact->surface_point, &contact->target}) {
      *point = home.apply(*point);
    }
    for (Vec3* way : {&contact->ray_direction, &contact->normal, &contact->skin_direction}) {
      *way = home.rotation * *way;
    }
  }
  return settled;
}

}  // namespace nade
