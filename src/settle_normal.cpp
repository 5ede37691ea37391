#include "settle_normal.h"

#include <algorithm>
#include <cmath>

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
/// The same for what is seen from above the hand. Where that is no edge, what lies under the palm
/// counts, unless it is of another side.
constexpr double kEdgeSeen = 0.98;
constexpr double kNoEdgeSeen = 0.997;
/// Cosines between the two: of another side, and surely of the same.
constexpr double kUnderOther = 0.7;
constexpr double kUnderSame = 0.9;
/// Nearer than this a direction off the surface says nothing.
constexpr double kNearest_m = 1e-4;

/// The direction off the surface to a point outside.
Vec3 direction_off(const SurfacePoint& nearest, const Vec3& from) {
  if (!(nearest.signed_distance > kNearest_m)) return nearest.normal;
  return (from - nearest.point).normalized();
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
  const auto nearest = object.closest_point(above, kFarthest_m, memory.under_hand);
  if (!under || !nearest) return push;
  const double smooth =
      smoothstep(kEdgeSeen, kNoEdgeSeen, direction_off(*nearest, above).dot(nearest->normal));
  Vec3 seen = outward_normal(*nearest, above);
  const double same = smoothstep(kUnderOther, kUnderSame, seen.dot(under->normal));
  seen = mixed(seen, under->normal, smooth * same);
  const Vec3 normal = mixed(push, seen, smoothstep(kOtherSide, kSameSide, seen.dot(push)));
  if (memory.normal.isZero()) return normal;
  const double most_rad = motion_m / kSharpest_m + kTurnAtRest_radps * seconds;
  const double angle_rad = std::acos(std::clamp(normal.dot(memory.normal), -1.0, 1.0));
  if (angle_rad <= most_rad) return normal;
  return turn_toward(memory.normal, normal, most_rad / angle_rad) * memory.normal;
}

}  // namespace nade
