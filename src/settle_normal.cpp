#include "settle_normal.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ramps.h"

namespace nade {
namespace {

/// The surface is seen from so far above the palm: from there, over an edge, the way out turns over
/// about as much of the hand's way.
constexpr double kAbove_m = 0.045;
/// Cosine of the back of the hand with the push from which on it surely is above; below minus that
/// the hand presses with its back, and its palm is above.
constexpr double kSurelyAbove = 0.55582;
/// Nothing is looked for farther away.
constexpr double kFarthest_m = 0.3;
/// Cosines between push and normal: from the other side of a thin wall, and surely from the same.
constexpr double kOtherSide = 0.051017;
constexpr double kSameSide = 0.28063;
/// The normal turns as on a ball of this size at the most, and so fast at rest.
constexpr double kSharpest_m = 0.026359;
constexpr double kTurnAtRest_radps = 0.5;
/// Cosines between a surface's normal and the direction off it: at an edge, and surely not.
constexpr double kEdge = 0.95;
constexpr double kNoEdge = 0.995;
/// Over how large a radius the surface turns there, a second look shows from so far to the side.
/// Over less than this it is an edge, bevelled or not; where it surely is none, what lies under the
/// palm counts, unless it is of another side.
constexpr double kAside_m = 0.01;
constexpr double kEdgeRadius_m = 0.02;
constexpr double kNoEdgeRadius_m = 0.045;
/// Cosines between what lies under the palm and what is seen from above: of another side, and
/// surely of the same.
constexpr double kUnderOther = 0.7;
constexpr double kUnderSame = 0.9;
/// Nearer than this a direction off the surface says nothing.
constexpr double kNearest_m = 1e-4;
constexpr double kSmallestAngle_rad = 1e-6;

/// The direction off the surface to a point outside.
Vec3 direction_off(const SurfacePoint& nearest, const Vec3& from) {
  if (!(nearest.signed_distance > kNearest_m)) return nearest.normal;
  return (from - nearest.point).normalized();
}

/// A surface point and the way out from it.
struct Seen {
  Vec3 point = Vec3::Zero();
  Vec3 out = Vec3::UnitY();
};

std::optional<Seen> look_from(const ScaledSurface& object, const Vec3& from, SurfaceHint& hint) {
  const std::optional<SurfacePoint> nearest = object.closest_point(from, kFarthest_m, hint);
  if (!nearest) return std::nullopt;
  return Seen{nearest->point, outward_normal(*nearest, from)};
}

/// The radius over which the surface turns from one point to the other; 0 on a sharp edge.
double radius_between(const Seen& from, const Seen& to) {
  const double angle_rad = std::acos(std::clamp(from.out.dot(to.out), -1.0, 1.0));
  return (to.point - from.point).norm() / std::max(angle_rad, kSmallestAngle_rad);
}

}  // namespace

Vec3 outward_normal(const SurfacePoint& nearest, const Vec3& from) noexcept {
  const Vec3 outward = direction_off(nearest, from);
  return mixed(outward, nearest.normal, smoothstep(kEdge, kNoEdge, outward.dot(nearest.normal)));
}

Vec3 normal_under_palm(const ScaledSurface& object, const Pose& palm, const Vec3& push,
                       double motion_m, double seconds, SettleMemory& memory) noexcept {
  if (push.isZero()) return push;
  const auto under = object.closest_point(palm.position, kFarthest_m, memory.under_palm);
  const Vec3 back = palm.rotation * Vec3::UnitY();
  const double up = 2.0 * smoothstep(-kSurelyAbove, kSurelyAbove, back.dot(push)) - 1.0;
  const Vec3 above = palm.position + up * kAbove_m * back;
  const std::optional<Seen> seen = look_from(object, above, memory.under_hand);
  if (!under || !seen) return push;
  const Vec3 aside = along_surface(seen->out - under->normal, seen->out).normalized();
  const std::optional<Seen> beyond = look_from(object, above + kAside_m * aside, memory.under_hand);
  const double smooth =
      beyond ? smoothstep(kEdgeRadius_m, kNoEdgeRadius_m, radius_between(*seen, *beyond)) : 0.0;
  const double same = smoothstep(kUnderOther, kUnderSame, seen->out.dot(under->normal));
  const Vec3 out = mixed(seen->out, under->normal, smooth * same);
  const Vec3 normal = mixed(push, out, smoothstep(kOtherSide, kSameSide, out.dot(push)));
  if (memory.contact.normal.isZero()) return normal;
  const double most_rad = motion_m / kSharpest_m + kTurnAtRest_radps * seconds;
  const double angle_rad = std::acos(std::clamp(normal.dot(memory.contact.normal), -1.0, 1.0));
  if (angle_rad <= most_rad) return normal;
  return turn_toward(memory.contact.normal, normal, most_rad / angle_rad) * memory.contact.normal;
}

}  // namespace nade
