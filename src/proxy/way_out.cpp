#include "way_out.h"

#include <algorithm>

namespace nade {
namespace {

constexpr double kPalmThickness_m = 0.02;
/// What of a hand found anew is deeper in the object than this did not come from its other side: of
/// one whose normal is so far from the palm's side's (cosine).
constexpr double kDeepInside_m = 0.008;
constexpr double kOpposite = -0.5;
/// What is got out may have more of the hand in the object.
constexpr int kLooksInside = 4;

/// How far a shifted hand is still to go along a direction until what is deep inside is out.
double way_out(const ContactSearch& search, const Vec3& shift, const Vec3& out) {
  double farthest_m = 0.0;
  for (const FleshPad& pad : search.flesh.pads) {
    const Vec3 middle = search.tracked.position(pad.middle) + shift;
    SurfaceHint hint;
    const auto nearest = search.object.closest_point(middle, kDeepest_m, hint);
    if (!nearest || nearest->signed_distance > -kDeepInside_m) continue;
    if (nearest->normal.dot(out) > kOpposite) continue;
    const auto exit = search.object.first_hit({middle, out, kDeepest_m});
    if (exit) farthest_m = std::max(farthest_m, exit->distance);
  }
  return farthest_m;
}

}  // namespace

Vec3 shift_outside(const ContactSearch& search, const Vec3& palm) noexcept {
  Vec3 shift = Vec3::Zero();
  SurfaceHint hint;
  const auto nearest = search.object.closest_point(palm, kDeepest_m, hint);
  if (!nearest) return shift;
  const Vec3 out = outward_normal(*nearest, palm);
  if (nearest->signed_distance <= 0.0) {
    shift = nearest->point - palm + search.scale * kPalmThickness_m * out;
  }
  for (int look = 0; look < kLooksInside; ++look) {
    const double left_m = way_out(search, shift, out);
    if (left_m == 0.0) break;
    shift += left_m * out;
  }
  return shift;
}

}  // namespace nade
