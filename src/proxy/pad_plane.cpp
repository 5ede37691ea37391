#include "pad_plane.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ramps.h"

namespace nade {
namespace {

/// A pad's plane serves until the surface could have bent away from it by so much, but for no
/// shorter and no longer way than these; or for this share of how far its skin is from touching.
constexpr double kBentAway_m = 0.0001;
constexpr double kLeastSame_m = 0.00002;
constexpr double kMostSame_m = 0.0025;
constexpr double kSameOfGap = 0.4;
/// A pad that is too far is not looked at again until it could have come so much nearer.
constexpr double kFarSlack_m = 0.02;
/// And then from so much farther out: the larger a ball is that rests on the surface, the farther
/// along the surface a pad can go in it.
constexpr double kFartherOut_m = 0.02;
/// That it is free by so much more than is needed costs less to know than where the surface is.
constexpr double kFartherSlack_m = 0.005;
/// Another pad's ball serves as well that leaves so much more than is needed.
constexpr double kSharedSlack_m = 0.002;
/// At an edge the nearest point's normal turns in a moment. A pad's follows over about this way.
constexpr double kTurningWay_m = 0.0026;
/// Cosine between the normals of two sides of a sheet, at most; well below that of a box's faces.
constexpr double kOtherSide = -0.5;
/// From a wall's side, what is looked for from so far outside is on it.
constexpr double kJustOutside_m = 0.0005;
/// Through a thicker wall no hand found anew is drawn back.
constexpr double kThickestWall_m = 0.02;
/// A pad that goes farther than this in a frame could go through a wall before that is what is
/// nearest to it: it looks along its way, and so much farther.
constexpr double kLongWay_m = 0.005;
constexpr double kAhead_m = 0.01;
/// Two sides of the surface meet in an inside corner where their normals differ by so much (cosine)
/// and each is so far in front of the other.
constexpr double kCornerCosine = 0.7;
constexpr double kInFront_m = 0.0005;
/// A pad is in the corner until it is so far from where it saw the other side, besides the way that
/// it came in the frame.
constexpr double kNearCorner_m = 0.02;
/// A pad's curvature is learned from ways of about this length on; no sharper.
constexpr double kLeastWay_m = 0.0018;
constexpr double kSharpest = 100.0;

/// Cosines between a surface's normal and the direction off it: at an edge, and surely not.
constexpr double kEdge = 0.95;
constexpr double kNoEdge = 0.995;
/// Nearer than this a direction off the surface says nothing.
constexpr double kNearest_m = 1e-4;

/// A unit direction that has turned this share of the way to another.
Vec3 mixed(const Vec3& from, const Vec3& to, double share) {
  return (from + share * (to - from)).normalized();
}

/// Lets the normal follow from where it was at the last look; across a thin sheet it turns at once.
void turn_slowly(const PadPlane& before, double way_m, PadPlane& now) {
  if (before.normal.dot(now.normal) <= kOtherSide) return;
  now.normal = mixed(before.normal, now.normal, followed(way_m, kTurningWay_m));
}

/// Takes in how the normal turned on the way since the last look. A way shorter than the least says
/// little.
void learn_curvature(const PadPlane& before, const Vec3& way, const PadPlane& now,
                     PadMemory& known) {
  const double trust = way.squaredNorm() / (way.squaredNorm() + kLeastWay_m * kLeastWay_m);
  const double seen = way.dot(now.normal - before.normal) / (way.squaredNorm() + 1e-18);
  known.curvature += trust * (std::clamp(seen, -kSharpest, kSharpest) - known.curvature);
}

/// The point on the side that a pad's last plane is on, where the nearest is on another: across a
/// thin wall; or inside the object, beside the seam between two that are one surface to a hand.
std::optional<SurfacePoint> on_side_of(const ScaledSurface& object, const PadPlane& plane,
                                       const SurfacePoint& nearest, const Vec3& middle,
                                       double search_m, SurfaceHint& hint) {
  const double behind_m = plane.normal.dot(plane.point - middle);
  const double cosine = plane.normal.dot(nearest.normal);
  const bool inside = nearest.signed_distance < 0.0 && cosine < kCornerCosine;
  if (behind_m <= 0.0 || (cosine > kOtherSide && !inside)) return std::nullopt;
  const Vec3 outside = middle + (behind_m + kJustOutside_m) * plane.normal;
  std::optional<SurfacePoint> same = object.closest_point(outside, search_m, hint);
  if (same && cosine > kOtherSide && same->signed_distance < 0.0) same.reset();
  return same;
}

/// Where a thin wall is between the palm and a pad: its side that the palm is on.
std::optional<PadPlane> wall_before(const ScaledSurface& object, const Vec3& palm,
                                    const Vec3& middle) {
  const double length = (middle - palm).norm();
  if (length < 1e-9) return std::nullopt;
  const Vec3 way = (middle - palm) / length;
  const std::optional<RayHit> in = object.first_hit({palm, way, length});
  if (!in || in->from_inside) return std::nullopt;
  const double begin = in->distance + kJustOutside_m;
  const double rest = std::max(0.0, length - begin);
  const std::optional<RayHit> out = object.first_hit({palm + begin * way, way, rest});
  const double thickness = std::abs(in->normal.dot(way)) * (out ? out->distance : rest);
  if (thickness > kThickestWall_m) return std::nullopt;
  return PadPlane{middle, in->point, in->normal};
}

/// The wall, if any, that a pad meets which comes a long way.
std::optional<PadPlane> wall_on_way(const ScaledSurface& object, const Vec3& middle,
                                    const Vec3& way) {
  const double length_m = way.norm();
  if (length_m < kLongWay_m) return std::nullopt;
  const std::optional<RayHit> hit =
      object.first_hit({middle - way, way / length_m, length_m + kAhead_m});
  if (!hit || hit->from_inside) return std::nullopt;
  return PadPlane{middle, hit->point, hit->normal};
}

/// Lets a plane that was found anew go on from the one before it.
void go_on_from(const PadPlane& before, PadMemory& known) {
  const Vec3 middle = known.plane->middle;
  const Vec3 way = middle - before.middle;
  turn_slowly(before, way.norm(), *known.plane);
  learn_curvature(before, way, *known.plane, known);
}

/// Whether two planes are of sides that may meet in a corner.
bool are_two_sides(const PadPlane& one, const PadPlane& other) {
  return one.normal.dot(other.normal) < kCornerCosine;
}

/// Whether a side stands out of a plane: over an edge it would fall away behind it.
bool stands_out(const PadPlane& side, const PadPlane& plane) {
  return are_two_sides(side, plane) && plane.normal.dot(side.point - plane.point) > kInFront_m;
}

/// Whether a pad that came so far in the frame is in an inside corner between its plane and another
/// side that it saw.
bool is_in_corner(const PadPlane& side, const PadPlane& now, double way_m) {
  return stands_out(side, now) && stands_out(now, side) &&
         (now.middle - side.middle).norm() < kNearCorner_m + way_m;
}

/// Takes in one more side of a corner, if it is another one.
void add_side(const PadPlane& side, OtherSides& sides) {
  if (sides.count == sides.planes.size()) return;
  for (const PadPlane& other : sides.seen()) {
    if (!are_two_sides(side, other)) return;
  }
  sides.planes[sides.count++] = side;
}

/// Finds the sides that a pad keeps out of besides its plane: what it meets, where it comes from,
/// and those that it knew. Gives whether one of the first two is among them.
bool find_corner(const std::optional<PadPlane>& wall, const std::optional<PadPlane>& before,
                 const OtherSides& beside, double way_m, PadMemory& known) {
  if (wall && stands_out(*wall, *known.plane)) add_side(*wall, known.beside);
  if (before && is_in_corner(*before, *known.plane, way_m)) add_side(*before, known.beside);
  const bool is_new = known.beside.count > 0;
  for (const PadPlane& side : beside.seen()) {
    if (is_in_corner(side, *known.plane, way_m)) add_side(side, known.beside);
  }
  return is_new;
}

double away_of(const Vec3& middle, const PadMemory& known) {
  return (middle - known.seen_from).norm();
}

/// The surface point nearest to `from`, no farther than `search_m`, and how clear it is there.
std::optional<SurfacePoint> look(const ScaledSurface& object, const Vec3& from, double search_m,
                                 PadMemory& known) {
  const std::optional<SurfacePoint> nearest = object.closest_point(from, search_m, known.hint);
  known.seen_from = from;
  known.clearance_m = nearest ? nearest->signed_distance : search_m;
  return nearest;
}

/// Whether a pad that was too far still is, as seen from farther out.
bool is_still_far(PadLooks& looks, const Vec3& middle, double reach_m, PadMemory& known) {
  if (known.outward.isZero()) return false;
  if (const FreeBall* const ball = looks.free.around(middle, reach_m + kSharedSlack_m)) {
    known.seen_from = ball->middle;
    known.clearance_m = ball->radius_m;
  } else {
    (void)look(looks.object, middle + kFartherOut_m * known.outward,
               kFartherOut_m + reach_m + kFartherSlack_m, known);
    looks.free.add({known.seen_from, known.clearance_m});
  }
  return left_of(middle, looks.travel_m, known) > reach_m;
}

}  // namespace

Vec3 outward_normal(const SurfacePoint& nearest, const Vec3& from) noexcept {
  if (!(nearest.signed_distance > kNearest_m)) return nearest.normal;
  const Vec3 outward = (from - nearest.point).normalized();
  return mixed(outward, nearest.normal, smoothstep(kEdge, kNoEdge, outward.dot(nearest.normal)));
}

const FreeBall* FreeBalls::around(const Vec3& point, double room_m) const noexcept {
  const FreeBall* roomiest = nullptr;
  for (const FreeBall& ball : balls_) {
    const double left_m = ball.radius_m - (point - ball.middle).norm();
    if (left_m <= room_m) continue;
    room_m = left_m;
    roomiest = &ball;
  }
  return roomiest;
}

double left_of(const Vec3& middle, double travel_m, PadMemory& known) noexcept {
  const double left_m = known.clearance_m - away_of(middle, known);
  known.free_m = left_m + travel_m;
  return left_m;
}

bool find_plane(PadLooks& looks, const FleshPoint& point, const Vec3& middle, double reach_m,
                PadMemory& known) noexcept {
  const ScaledSurface& object = looks.object;
  const double away_m = away_of(middle, known);
  if (known.clearance_m - away_m > reach_m) return false;
  if (known.plane && away_m <= known.same_m) return true;
  std::optional<PadPlane> before = std::exchange(known.plane, std::nullopt);
  const OtherSides beside = std::exchange(known.beside, {});
  if (is_still_far(looks, middle, reach_m, known)) return false;
  const double search_m = reach_m + kFarSlack_m;
  const std::optional<SurfacePoint> nearest = look(object, middle, search_m, known);
  const bool far = left_of(middle, looks.travel_m, known) > reach_m;
  const bool is_side_lost = std::exchange(known.is_side_lost, false) || looks.are_sides_lost;
  known.outward = Vec3::Zero();
  if (nearest && far) known.outward = (middle - nearest->point).normalized();
  if (!nearest || far) return false;
  known.plane = PadPlane{middle, nearest->point, outward_normal(*nearest, middle)};
  if (!before && is_side_lost) before = wall_before(object, looks.palm, middle);
  const std::optional<SurfacePoint> same =
      before ? on_side_of(object, *before, *nearest, middle, search_m, known.hint) : std::nullopt;
  if (same) known.plane = PadPlane{middle, same->point, same->normal};
  const Vec3 way = looks.before ? Vec3(middle - looks.before->position(point)) : Vec3::Zero();
  const std::optional<PadPlane> wall = wall_on_way(object, middle, way);
  if (wall && wall->normal.dot(known.plane->normal) <= kOtherSide) known.plane = wall;
  // In a corner no direction in between keeps out of both sides. A hand found anew comes from none.
  if (!is_side_lost && find_corner(wall, before, beside, way.norm(), known)) {
    known.curvature = 0.0;
    return true;
  }
  if (before) go_on_from(*before, known);
  return true;
}

PadPlane bent_plane(const PadMemory& known, const Vec3& middle) noexcept {
  PadPlane plane = *known.plane;
  const Vec3 way = along_surface(middle - plane.middle, plane.normal);
  plane.point -= 0.5 * known.curvature * way.squaredNorm() * plane.normal;
  plane.normal = (plane.normal + known.curvature * way).normalized();
  return plane;
}

double plane_serves(const PadMemory& known, double gap_m) noexcept {
  const double curvature = std::abs(known.curvature) + 1e-9;
  const double same_m = std::sqrt(2.0 * kBentAway_m / curvature);
  return std::max(std::clamp(same_m, kLeastSame_m, kMostSame_m), kSameOfGap * gap_m);
}

}  // namespace nade
