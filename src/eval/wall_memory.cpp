#include "wall_memory.h"

namespace nade {
namespace {

/// A ray that goes on from a hit begins this much farther.
constexpr double kPastHit_m = 1e-6;

Vec3 turned(const Object& object, const Vec3& direction_object) {
  return object.placement().pose.rotation * direction_object;
}

}  // namespace

std::optional<EnteredSide> side_above(const Object& object, const Vec3& point, const Vec3& up) {
  const auto above = object.first_hit({point, up, kDeepestThrough_m});
  if (!above) return std::nullopt;
  if (above->from_inside) {
    const double left_m = kThickestWall_m - above->distance;
    const auto below =
        left_m > 0.0 ? object.first_hit({point, -up, left_m}) : std::optional<RayHit>();
    return EnteredSide{above->point, above->normal, above->distance, below && below->from_inside};
  }
  const double start_m = above->distance + kPastHit_m;
  const auto entered = object.first_hit({point + start_m * up, up, kThickestWall_m});
  if (!entered || !entered->from_inside) return std::nullopt;
  return EnteredSide{entered->point, entered->normal, start_m + entered->distance, true};
}

void WallMemory::forget() {
  for (Entry& entry : entries_) entry = {};
  palm_ = {};
}

bool WallMemory::is_with_hand(const Object& object, const RayHit& out) const {
  if (palm_.entered) return out.normal.dot(turned(object, palm_.normal_object)) > 0.0;
  const Vec3 from = out.point + kPastHit_m * out.normal;
  const Vec3 way = object.placement().to_world(palm_.last_object) - from;
  return out.normal.dot(way) > 0.0 && !object.first_hit({from, way.stableNormalized(), way.norm()});
}

void WallMemory::cross(const Object& object, const Vec3& from, const Vec3& to, Entry& entry) const {
  // More walls than these are not crossed from one frame to the next.
  constexpr int kMostHits = 8;
  const Vec3 direction = (to - from).stableNormalized();
  double left_m = (to - from).norm();
  Vec3 at = from;
  for (int i = 0; i < kMostHits && left_m > 0.0; ++i) {
    const auto hit = object.first_hit({at, direction, left_m});
    if (!hit) return;
    const Vec3 normal = turned(object, entry.normal_object);
    if (!hit->from_inside && !entry.entered) {
      entry.entered = true;
      entry.normal_object = object.placement().pose.rotation.conjugate() * hit->normal;
    } else if (hit->from_inside && (hit->normal.dot(normal) > 0.0 || is_with_hand(object, *hit))) {
      entry.entered = false;
    }
    at = hit->point + kPastHit_m * direction;
    left_m -= hit->distance + kPastHit_m;
  }
}

void WallMemory::follow_palm(const Vec3& now, const Object& object) {
  static_cast<void>(follow(palm_, {now, now, 0.0}, object));
}

std::optional<double> WallMemory::follow(std::size_t vertex, const Step& step,
                                         const Object& object) {
  return follow(entries_[vertex], step, object);
}

std::optional<double> WallMemory::follow(Entry& entry, const Step& step, const Object& object) {
  const Vec3& now = step.now;
  const Placement& placement = object.placement();
  const Vec3 from = entry.followed ? placement.to_world(entry.last_object) : step.bone;
  if ((now - from).norm() >= step.clear_m) cross(object, from, now, entry);
  entry.followed = true;
  entry.last_object = placement.to_local(now);
  if (!entry.entered) return std::nullopt;
  const auto side = side_above(object, now, turned(object, entry.normal_object));
  if (!side) {
    // Beside the wall, or far beyond it.
    entry.entered = false;
    return std::nullopt;
  }
  entry.normal_object = placement.pose.rotation.conjugate() * side->normal;
  if (!side->thin) return std::nullopt;
  return (side->point - now).dot(side->normal);
}

}  // namespace nade
