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

/// What presses a digit against a side pushes it down as well, the harder the farther the hand goes
/// on. So it climbs whatever is no higher above its skin than so many times what that is held back
/// by: surely where it is held back by so much, and the side is so steep.
constexpr double kHighestClimb = 2.0;
constexpr double kSurelyClimbs_m = 0.012;
constexpr double kClimbsFrom = 0.35;
constexpr double kSurelyClimbs = 0.05;
/// In this time as far as it is held back by, or nearly as fast as the hand goes: so much is asked
/// for anew in each of the frame's rounds. (Asked for once a frame, and faster, fingers still
/// fold.)
constexpr double kClimbTime_s = 0.1;
constexpr double kClimbAtRest_mps = 0.03;
constexpr double kClimbOfSpeed = 0.7;
/// A third of the surface's.
constexpr double kClimbStiffness = 3.6e6;
/// No less firmly is the hand held back then.
constexpr double kFirmness = 27.0;
/// Above what is climbed there is room, so far on from where the skin is.
constexpr double kBefore_m = 0.003;
constexpr double kRoom_m = 0.02;

/// A digit's skin that is held back farthest.
struct Held {
  double by_m = 0.0;
  const FleshPoint* point = nullptr;
  Vec3 back = Vec3::Zero();  ///< unit, off the side and along the hand
  double climbs = 0.0;       ///< the share of a climb that the side's steepness is worth
};

/// Whether what holds a digit back is low enough to be climbed.
bool is_low(const PosedHand& posed, const TouchSearch& search, const Held& held, const Vec3& up) {
  const Vec3 above = posed.flesh.position(*held.point) + kHighestClimb * held.by_m * up;
  return !search.object.first_hit({above + kBefore_m * held.back, -held.back, kRoom_m});
}

/// `motion` is the held skin's, up.
void climb(const TouchSearch& search, Digit digit, const Held& held, const ContactRow& motion,
           std::vector<ContactRow>& rows) {
  const double share = held.climbs * smoothstep(kHeld_m, kSurelyClimbs_m, held.by_m);
  for (ContactRow& row : rows) {
    if (row.kind == RowKind::draw_near && row.digit == digit) row.stiffness *= 1.0 - share;
  }
  const double rate_mps =
      std::min(held.by_m / kClimbTime_s, kClimbAtRest_mps + kClimbOfSpeed * search.speed_mps);
  ContactRow& row = rows.emplace_back(motion);
  row.kind = RowKind::climb;
  row.gap_m = -share * rate_mps * search.seconds;  // no lower in any case
  row.stiffness = kClimbStiffness;
}

}  // namespace

void lift_over(const PosedHand& posed, const TouchSearch& search, std::vector<ContactRow>& rows,
               Springs& springs) noexcept {
  // The push would not do for what is up: it turns to what holds the hand back.
  const Vec3 back = search.tracked.carry[index_of(Joint::palm)].col(1).head<3>().normalized();
  const double along = back.dot(search.frame.col(2));
  const Vec3 up = std::copysign(1.0, along) * back;
  const double flat = smoothstep(kSideways, kFlat, std::abs(along));
  if (flat == 0.0) return;
  std::array<Held, kDigitCount> held;
  for (const ContactRow& row : rows) {
    if (row.kind != RowKind::keep_out || !row.digit || row.gap_m >= kTouches_m) continue;
    const Vec3 normal = search.frame * row.wrist.head<3>();
    const double level = std::abs(normal.dot(up));
    const double steep = smoothstep(kNotSteep, kSteep, level);
    if (steep == 0.0) continue;
    const Vec3 off = posed.flesh.position(*row.point) - search.tracked.position(*row.point);
    const Vec3 off_side = along_surface(normal, up).normalized();
    const double before_m = off.dot(off_side);
    const double by_m = flat * steep * smoothstep(kTouches_m, 0.0, row.gap_m) *
                        (before_m - kAsideOfLift * std::max(0.0, off.dot(up)));
    Held& most = held[index_of(*row.digit)];
    if (by_m <= most.by_m) continue;
    most = {by_m, row.point, off_side, flat * smoothstep(kClimbsFrom, kSurelyClimbs, level)};
  }
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    if (held[d].by_m <= kHeld_m) continue;
    const double lift = kLift * smoothstep(kHeld_m, kSurelyHeld_m, held[d].by_m);
    const ContactRow motion = motion_along(posed, *held[d].point, up, search.frame);
    springs.force.head<6>() += lift * motion.wrist;
    springs.force.segment<4>(first_freedom(d)) += lift * motion.bend;
    if (is_low(posed, search, held[d], up)) climb(search, digit_at(d), held[d], motion, rows);
  }
}

double firmness_of_climb(std::span<const ContactRow> rows) noexcept {
  const auto climbs = [](const ContactRow& row) { return row.kind == RowKind::climb; };
  return std::any_of(rows.begin(), rows.end(), climbs) ? kFirmness : 0.0;
}

}  // namespace nade
