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

/// As `SeenHand::corrected_before`.
std::optional<Correction> corrected_before(const HandPose& tracked, const Quat& object,
                                           double seconds, const SettleMemory& memory) {
  const SettledFrame& last = memory.last;
  if (!last.tracked || seconds > kMissing_s) return std::nullopt;
  if (largest_motion(moved(*last.tracked, memory.place), tracked) > kTeleport_m) {
    return std::nullopt;
  }
  const Quat turn = object.conjugate() * memory.place.rotation;
  Correction correction = last.correction;
  correction.palm.shift = turn * correction.palm.shift;
  correction.palm.turn = turn * correction.palm.turn * turn.conjugate();
  return correction;
}

}  // namespace

double rounded(double scale) noexcept { return kGrid * std::nearbyint(scale / kGrid); }

SeenHand see_hand(const HandPose& tracked, const Object& object, double seconds,
                  SettleMemory& memory) noexcept {
  SeenHand seen;
  const Pose& now = object.placement().pose;
  seen.corrected_before = corrected_before(tracked, now.rotation, seconds, memory);
  if (memory.surface != &object.surface()) memory.last.tracked.reset();
  if (!memory.last.tracked) memory.home = now;
  const Pose place = on_grid(memory.home.inverse() * now);
  memory.place = memory.home * place;
  seen.from_home = moved(tracked, memory.home.inverse());
  for (Pose& joint : seen.from_home.joints) joint = on_grid(joint);
  seen.from_object = moved(seen.from_home, place.inverse());
  return seen;
}

std::optional<RayHit> ScaledSurface::first_hit(const Ray& ray) const noexcept {
  std::optional<RayHit> hit =
      surface_.first_hit({ray.origin / scale_, ray.direction, ray.max_distance / scale_});
  if (!hit) return std::nullopt;
  hit->distance *= scale_;
  hit->point *= scale_;
  return hit;
}

std::optional<SurfacePoint> ScaledSurface::closest_point(const Vec3& query, double max_distance_m,
                                                         SurfaceHint& hint) const noexcept {
  std::optional<SurfacePoint> found =
      surface_.closest_point(query / scale_, max_distance_m / scale_, hint);
  if (!found) return std::nullopt;
  found->point *= scale_;
  found->signed_distance *= scale_;
  return found;
}

SettledHand brought_back(const Pose& object, const HandPose& tracked,
                         SettledHand settled) noexcept {
  settled.hand = settled.corrected ? moved(settled.hand, object) : tracked;
  for (std::optional<PartContact>& contact : settled.contacts) {
    if (!contact) continue;
    for (Vec3* point : {&contact->ray_origin, &contact->surface_point, &contact->target}) {
      *point = object.apply(*point);
    }
    for (Vec3* way : {&contact->ray_direction, &contact->normal, &contact->skin_direction}) {
      *way = object.rotation * *way;
    }
  }
  return settled;
}

}  // namespace nade
