#include "nade/contact.h"

// Based on: Yanagida, Mori, Toyama. Composition of CG Hand Images for Visual Feedback of Contact
// Sensation in Stroking Motion. 2023. Section 2 (1).

#include <cmath>
#include <numbers>

#include "ramps.h"

namespace nade {
namespace {

/// A ray goes on from just behind the hit before; crossings closer than this count as one.
constexpr double kPastHit_m = 1e-6;
/// Walls a part may have been pushed through before it counts as gone.
constexpr int kMostWalls = 8;

/// A ray of a part, from the tested point.
struct PartRay {
  Vec3 origin = Vec3::Zero();
  Vec3 direction = Vec3::UnitY();  ///< unit
  double skin_depth_m = 0.0;       ///< length of c_j
};

PartContact contact_at(const PartRay& ray, const RayHit& hit, double depth_m,
                       const ContactOptions& options) {
  PartContact contact;
  contact.ray_origin = ray.origin;
  contact.ray_direction = ray.direction;
  contact.skin_depth_m = ray.skin_depth_m;
  contact.depth_m = depth_m;
  contact.turn = options.full_turn_depth_m > 0.0
                     ? smoothstep(0.0, options.full_turn_depth_m, hit.distance)
                     : 1.0;
  return moved_to(contact, ray.direction, hit);
}

/// The hit at which the ray leaves the wall nearest to where the part touched last, when the
/// part has been pushed through a thin wall and lies free on its far side.
std::optional<RayHit> leave_through(const PartRay& ray, const Object& object,
                                    const Vec3& last_point, double limit_m) {
  std::optional<RayHit> best;
  double best_distance = 0.0;
  double start_m = 0.0;
  for (int wall = 0; wall < kMostWalls && start_m < limit_m; ++wall) {
    const std::optional<RayHit> hit =
        object.first_hit({ray.origin + start_m * ray.direction, ray.direction, limit_m - start_m});
    if (!hit) break;
    const double distance = start_m + hit->distance;
    const double from_last = (hit->point - last_point).norm();
    if (hit->from_inside && (!best || from_last < best_distance)) {
      best = hit;
      best->distance = distance;
      best_distance = from_last;
    }
    start_m = distance + kPastHit_m;
  }
  // A wall that close to where the part touched is the one it touched; one farther away than
  // the part is deep is another.
  if (best && best_distance <= best->distance + kPastHit_m) return best;
  return std::nullopt;
}

PartRay palm_ray(const HandPose& tracked, const SkinDepths& skin, const Object& object,
                 const ContactOptions& options, const ContactMemory& memory) {
  PartRay ray;
  ray.skin_depth_m = skin[Part::palm];
  ray.direction = options.palm_ray == PalmRay::held && memory.held_palm_ray
                      ? Vec3(object.placement().pose.rotation * *memory.held_palm_ray)
                      : tracked.back();
  ray.origin = tracked[Joint::palm].position;
  return ray;
}

PartRay fingertip_ray(const HandPose& tracked, Part part, const SkinDepths& skin,
                      const ContactOptions& options) {
  const Pose& tip = tracked[joint_of(part)];
  PartRay ray;
  ray.skin_depth_m = skin[part];
  ray.direction =
      options.finger_ray == FingerRay::hand_back ? tracked.back() : tip.rotation * Vec3::UnitY();
  ray.origin = tip.position;
  return ray;
}

std::optional<PartContact> touch(const PartRay& ray, const Object& object,
                                 const ContactOptions& options,
                                 const std::optional<Vec3>& last_point, SurfaceHint& hint) {
  const std::optional<SurfacePoint> near =
      object.closest_point(ray.origin, std::numeric_limits<double>::infinity(), hint);
  if (!near) return std::nullopt;
  const double depth_m = -near->signed_distance;
  if (depth_m > 0.0 || options.counted_hits == CountedHits::any) {
    const std::optional<RayHit> hit = object.first_hit({ray.origin, ray.direction});
    const bool counts = hit && (options.counted_hits == CountedHits::any || hit->from_inside);
    if (counts) return contact_at(ray, *hit, depth_m, options);
  }
  if (!last_point || options.entry_side == EntrySide::forgotten) return std::nullopt;
  const std::optional<RayHit> wall =
      leave_through(ray, object, *last_point, options.push_through_limit_m);
  if (!wall) return std::nullopt;
  return contact_at(ray, *wall, wall->distance, options);
}

}  // namespace

Quat turn_toward(const Vec3& from, const Vec3& to, double fraction) noexcept {
  if (!(from.squaredNorm() > 0.0)) return Quat::Identity();
  const Vec3 axis = from.cross(to);
  const double sine = axis.norm();
  const double angle = fraction * std::atan2(sine, from.dot(to));
  // Opposite vectors have no shortest turn: any axis square to both will do.
  const Vec3 unit = sine > 1e-9 ? Vec3(axis / sine) : from.unitOrthogonal();
  return Quat(Eigen::AngleAxisd(angle, unit));
}

PartContact moved_to(PartContact contact, const Vec3& ray_direction, const RayHit& hit) noexcept {
  contact.surface_point = hit.point;
  contact.normal = hit.normal;
  // c_j starts along the part's own ray also where that was turned, so that the correction
  // still starts from nothing at first touch.
  contact.skin_direction =
      turn_toward(contact.ray_direction, hit.normal, contact.turn) * contact.ray_direction;
  contact.target = hit.point + contact.skin_depth_m * contact.skin_direction;  // Eq. (1)
  contact.ray_direction = ray_direction;
  return contact;
}

Contacts find_contacts(const HandPose& tracked, const SkinDepths& skin, const Object& object,
                       const ContactOptions& options, ContactMemory& memory) noexcept {
  const Placement& placement = object.placement();
  Contacts contacts;
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const Part part = part_at(i);
    PartRay ray = part == Part::palm ? palm_ray(tracked, skin, object, options, memory)
                                     : fingertip_ray(tracked, part, skin, options);
    if (options.test_point == TestPoint::skin) ray.origin -= ray.skin_depth_m * ray.direction;
    std::optional<Vec3> last_world;
    if (memory.last_point[i]) last_world = placement.to_world(*memory.last_point[i]);
    contacts[i] = touch(ray, object, options, last_world, memory.hints[i]);
    memory.last_point[i].reset();
    if (contacts[i]) memory.last_point[i] = placement.to_local(contacts[i]->surface_point);
  }
  const auto& palm = contacts[index_of(Part::palm)];
  if (palm) {
    memory.held_palm_ray = placement.pose.rotation.conjugate() * palm->ray_direction;
  } else {
    memory.held_palm_ray.reset();
  }
  return contacts;
}

}  // namespace nade
