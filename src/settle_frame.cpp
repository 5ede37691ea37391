#include "settle_frame.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "settle_unrest.h"

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

/// How far it has come in the world since the last frame, from where it was or from where it would
/// have gone on to, as in a car; none if it was not seen then, or jumped.
std::optional<double> way_of(const HandPose& tracked, double seconds, SettleMemory& memory) {
  const Vec3 went_before = std::exchange(memory.went, Vec3::Zero());
  if (!memory.last.tracked || seconds > kMissing_s) return std::nullopt;
  HandPose last = moved(*memory.last.tracked, memory.place);
  memory.went = tracked[Joint::palm].position - last[Joint::palm].position;
  const double from_there_m = largest_motion(last, tracked);
  for (Pose& joint : last.joints) joint.position += went_before;
  const double way_m = std::min(from_there_m, largest_motion(last, tracked));
  return way_m <= kTeleport_m ? std::optional(way_m) : std::nullopt;
}

Correction turned(const Quat& turn, Correction correction) {
  correction.palm.shift = turn * correction.palm.shift;
  correction.palm.turn = turn * correction.palm.turn * turn.conjugate();
  return correction;
}

/// Another object, to whose frame `to` leads: what is known of the hand goes on there, what is
/// known of the surface does not.
void go_on_at(const Object& object, const Pose& to, SettleMemory& memory) {
  const Quat& turn = to.rotation;
  SettledFrame& last = memory.last;
  last.tracked = moved(*last.tracked, to);
  last.drawn = moved(last.drawn, to);
  last.correction = turned(turn, last.correction);
  memory.before = turned(turn, memory.before);
  ContactState& contact = memory.contact;
  for (Vec3* const vector :
       {&contact.push, &contact.normal, &contact.carried, &contact.lag, &contact.drawn_lag}) {
    *vector = turn * *vector;
  }
  for (JointVectors* const vectors : {&memory.velocity, &memory.pace, &memory.drift}) {
    for (Vec3& vector : *vectors) vector = turn * vector;
  }
  for (const Eigen::Index first : {0, 3}) {
    memory.returning.segment<3>(first) = turn * Vec3(memory.returning.segment<3>(first));
  }
  memory.before_jumps = {};
  forget_surface(memory);
  memory.scale = object.placement().scale;
  memory.shape = object.surface().shape();
}

}  // namespace

bool is_nowhere(const Object& object, const HandPose& tracked) noexcept {
  const Placement& placement = object.placement();
  return placement.scale == 0.0 || !is_usable(moved(tracked, placement.pose.inverse()));
}

double rounded(double scale) noexcept { return kGrid * std::nearbyint(scale / kGrid); }

SeenHand see_hand(const HandPose& tracked, const Object& object, double seconds,
                  SettleMemory& memory) noexcept {
  SeenHand seen;
  const Pose& now = object.placement().pose;
  const std::optional<double> way_m = way_of(tracked, seconds, memory);
  const bool is_another = memory.object != object.identity();
  if (is_another && !way_m) memory.last.tracked.reset();
  if (!memory.last.tracked) memory.home = now;
  const Pose place = on_grid(memory.home.inverse() * now);
  const Pose before = std::exchange(memory.place, memory.home * place);
  const Pose to = memory.place.inverse() * before;
  if (way_m) seen.before = ShownBefore{turned(to.rotation, memory.shown), *way_m};
  seen.at_another = is_another && way_m;
  if (seen.at_another) go_on_at(object, to, memory);
  seen.from_home = moved(tracked, memory.home.inverse());
  for (Pose& joint : seen.from_home.joints) joint = on_grid(joint);
  seen.from_object = moved(seen.from_home, place.inverse());
  return seen;
}

std::optional<RayHit> ScaledSurface::first_hit(const Ray& ray) const noexcept {
  std::optional<RayHit> hit =
      surface().first_hit({ray.origin / scale_, ray.direction, ray.max_distance / scale_});
  if (!hit) return std::nullopt;
  hit->distance *= scale_;
  hit->point *= scale_;
  return hit;
}

std::optional<SurfacePoint> ScaledSurface::closest_point(const Vec3& query, double max_distance_m,
                                                         SurfaceHint& hint) const noexcept {
  std::optional<SurfacePoint> found =
      surface().closest_point(query / scale_, max_distance_m / scale_, hint);
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
