#include "settle_lift.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "nade/geometry.h"
#include "ramps.h"

namespace nade {
namespace {

/// Cosine of the surface's normal with the back of the hand, or with the palm, up to which the hand
/// presses with its side, and from which surely not.
constexpr double kSideways = 0.3;
constexpr double kFlat = 0.7;
/// Cosines with the way up of a side's normal that is steep, and that is not.
constexpr double kSteep = 0.3;
constexpr double kNotSteep = 0.7;
/// Skin touches nearer than this, more or less.
constexpr double kTouches_m = 0.006;
/// A side holds a digit back whose skin is drawn so far before where it is tracked, and surely does
/// so far. Less counts for skin that the press has lifted: it came aside by that.
constexpr double kHeld_m = 0.004;
constexpr double kSurelyHeld_m = 0.024;
constexpr double kAsideOfLift = 0.5;
/// Nearly twice as hard as a part is drawn to the surface.
constexpr double kLift = 150.0;

/// A digit's skin that is held back farthest.
struct Held {
  double by_m = 0.0;
  const FleshPoint* point = nullptr;
};

}  // namespace

void lift_over(const PosedHand& posed, const TouchSearch& search,
               const std::vector<ContactRow>& rows, Springs& springs) noexcept {
  // The push would not do for what is up: it turns to what holds the hand back.
  const Vec3 back = search.tracked.linear[index_of(Joint::palm)].col(1).normalized();
  const double along = back.dot(search.frame.col(2));
  const Vec3 up = std::copysign(1.0, along) * back;
  const double flat = smoothstep(kSideways, kFlat, std::abs(along));
  if (flat == 0.0) return;
  std::array<Held, kDigitCount> held;
  for (const ContactRow& row : rows) {
    if (row.kind != RowKind::keep_out || !row.digit || row.gap_m >= kTouches_m) continue;
    const Vec3 normal = search.frame * row.wrist.head<3>();
    const double steep = smoothstep(kNotSteep, kSteep, std::abs(normal.dot(up)));
    if (steep == 0.0) continue;
    const Vec3 off = posed.flesh.position(*row.point) - search.tracked.position(*row.point);
    const double before_m = off.dot(along_surface(normal, up).normalized());
    const double by_m = flat * steep * smoothstep(kTouches_m, 0.0, row.gap_m) *
                        (before_m - kAsideOfLift * std::max(0.0, off.dot(up)));
    Held& most = held[index_of(*row.digit)];
    if (by_m > most.by_m) most = {by_m, row.point};
  }
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    if (held[d].by_m <= kHeld_m) continue;
    const double lift = kLift * smoothstep(kHeld_m, kSurelyHeld_m, held[d].by_m);
    const ContactRow motion = motion_along(posed, *held[d].point, up, search.frame);
    springs.force.head<6>() += lift * motion.wrist;
    springs.force.segment<4>(first_freedom(d)) += lift * motion.bend;
  }
}

}  // namespace nade
