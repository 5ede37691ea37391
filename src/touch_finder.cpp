#include "touch_finder.h"

#include <algorithm>
#include <cmath>

#include "pad_plane.h"
#include "ramps.h"

namespace nade {
namespace {

/// The skin is kept this far out.
constexpr double kMargin_m = 0.0002;

// What the person pressed in, or will so soon, is drawn to the surface until it is this near, from
// as far as `kPullReach_m`, with a pull that comes in time.
constexpr double kSoon_s = 0.0635;
constexpr double kMostSoon_m = 0.00999;
constexpr double kPullRest_m = 0.00028;
constexpr double kPullFade_m = 0.0059458;
constexpr double kPullTime_s = 0.07522;

/// How a pull grows with the tracked skin's depth, as it soon will be.
struct PullGrowth {
  double start_m;
  double full_m;
  double stiffness;
};
constexpr PullGrowth kPartPull{-0.0062146, 0.017795, 51130.0};
/// A thumb that lies beside the rest of the hand has a long way to come.
constexpr PullGrowth kThumbPull{kPartPull.start_m, 0.009, 8e4};
/// The palm takes the whole hand with it.
constexpr PullGrowth kPalmPull{kPartPull.start_m, kPartPull.full_m, 1.5033e5};
/// While any skin is pressed in, what is nearest to the surface is kept within reach of a touch: a
/// hand that leaves does not take off before the person's own does.
constexpr PullGrowth kTouchPull{0.0, 0.0126, 2.846e5};
constexpr double kHighestTouch_m = 0.0012;
/// Where that is farther off than this, as on a hand that slides over an edge, it is drawn besides
/// by so many times a calm hand's pull.
constexpr double kAstray_m = 0.0007;
constexpr double kAstrayPull = 3.9;

// Skin lands on a cushion and leaves it by the same way: at rest so thick, and thicker by the way
// that it goes in so long. It never goes quite flat.
constexpr double kThinnest_m = 0.00042105;
constexpr double kThickest_m = 0.0116;
constexpr double kLandingTime_s = 0.0885;
constexpr double kFlat_m = 0.00019355;
/// Under skin that has landed it may grow by so many times what that is drawn above the tracked.
constexpr double kGrowthOfLift = 1.6498;
/// All of the hand's cushions together lift its lowest skin no higher than the deepest tracked skin
/// would lie on its own; other skin higher, by so many times what it is higher.
constexpr double kHigherThanNearest = 1.15;
/// Drawn skin that comes down by itself brakes no less than this, as stiff as a damper.
constexpr double kBraking_mpss = 1.5427;
constexpr double kBrakeDamping = 18583.0;
/// What lands after the skin that is nearest to the surface may take a way longer by what the hand
/// goes in so long, and so many times as long at the most.
constexpr double kLater_s = 0.0116;
constexpr double kLongestWay = 2.0;
/// What could come no nearer than this to where it brakes needs no row, by `row_reach_m`.
constexpr double kRowReachOfBrake = 0.4997;

/// Of a part, skin that is higher by more than this than what else of it was looked at does not
/// matter.
constexpr double kAboutNearest_m = 0.004;
/// Skin stretches by no more than this when the hand is posed, and goes no farther than a joint.
constexpr double kStretch = 1.3;

/// Adds how far the hand has gone against the object since the last look.
void count_travel(const PosedFlesh& flesh, SettleMemory& memory) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Vec3 origin = flesh.origin(i);
    farthest = std::max(farthest, (origin - memory.joints[i]).squaredNorm());
    memory.joints[i] = origin;
  }
  memory.travel_m += kStretch * std::sqrt(farthest);
}

/// How thick a cushion skin needs that goes to the surface or from it at this speed.
double cushion_thickness(double speed_mps) {
  return std::min(kThickest_m, kThinnest_m + kLandingTime_s * speed_mps);
}

/// The most of a velocity or a way that can be toward a surface: along the push, or any in the air.
double landing_part(const TouchSearch& search, const Vec3& motion) {
  return search.push.isZero() ? motion.norm() : std::abs(search.push.dot(motion));
}

/// What skin lands on, under one pad.
struct Cushion {
  double thickness_m = 0.0;
  double lift_m = 0.0;      ///< of the drawn pad over the tracked one
  double approach_m = 0.0;  ///< of the drawn pad, since the last frame
  double nearest_m = 0.0;   ///< of all drawn skin to the surface, in the last frame
  double deepest_m = 0.0;   ///< of all tracked skin, in the last frame

  /// How far skin is held off the surface that is tracked at such a height above it. From the
  /// cushion's thickness above the surface to as far below it is brought to rest at an even
  /// deceleration. Higher up that fades: skin may be drawn lower than it is tracked.
  [[nodiscard]] double at(double height_m) const {
    const double way_m = height_m + thickness_m;
    if (way_m <= 0.0) return 0.0;
    if (way_m > 2.0 * thickness_m) return std::max(0.0, 2.0 * thickness_m - 0.5 * way_m);
    return way_m * way_m / (4.0 * thickness_m);
  }

  /// The same for drawn skin that would be `gap_m` away from the surface, with so much room above
  /// it. Skin that is drawn no higher than it is tracked has landed already: under it the cushion
  /// does not grow. Nor does a cushion lift a hand off that rests on other skin.
  [[nodiscard]] double under(double gap_m, double room_m) const {
    const double before_m = room_m + approach_m;
    const double grown_m = before_m + kThinnest_m + kGrowthOfLift * std::max(0.0, lift_m);
    const double higher_m = kHigherThanNearest * std::max(0.0, before_m - nearest_m);
    const double most_m = std::min(grown_m, at(-deepest_m) + higher_m);
    return std::clamp(at(gap_m - lift_m), kFlat_m, std::max(kFlat_m, most_m));
  }
};

/// How fast the person moves a point against the object, m/s.
Vec3 velocity_of(const TouchSearch& search, const FleshPoint& point) {
  Vec3 velocity = Vec3::Zero();
  for (std::size_t k = 0; k < point.joints.size() && point.weights[k] > 0.0; ++k) {
    velocity += point.weights[k] * search.velocity[point.joints[k]];
  }
  return velocity;
}

/// A pad that may be near the surface.
struct NearPad {
  const FleshPad& pad;
  Vec3 middle = Vec3::Zero();    ///< drawn
  Vec3 way = Vec3::Zero();       ///< drawn, since the last frame
  Vec3 velocity = Vec3::Zero();  ///< tracked
  double landing_mps = 0.0;
};

/// As thick as the person moves the pad fast along the normal. Over an edge the normal turns, but
/// the hand does not land: there the way that the object pushes counts.
Cushion cushion_under(const TouchSearch& search, const NearPad& near, const Vec3& normal) {
  const double speed_mps = std::min(std::abs(normal.dot(near.velocity)), near.landing_mps);
  const Vec3 lift = near.middle - search.tracked.position(near.pad.middle);
  return {cushion_thickness(speed_mps), normal.dot(lift), -normal.dot(near.way), search.nearest_m,
          search.deepest_m};
}

/// How drawn skin that comes down by itself is brought to rest, at an even deceleration.
class Landing {
 public:
  explicit Landing(const TouchSearch& search) : search_(search) {
    if (!search.before) return;
    const double later_m = search.push.isZero() ? 0.0 : kLater_s * search.speed_mps;
    longest_ = std::min(kLongestWay, 1.0 + later_m / kThickest_m);
    cushioned_m_ =
        slowing(search.speed_mps * search.speed_mps / (2.0 * cushion_thickness(search.speed_mps)));
  }

  /// Skin that was higher than this above the surface, and would come this much nearer in the
  /// frame, needs no row.
  [[nodiscard]] double highest(double approach_m) const {
    const double step_m = approach_m + kRowReachOfBrake * search_.row_reach_m;
    if (longest_ == 0.0 || step_m <= 0.0) return 0.0;
    const double slowing_m = slowing_on(longest_);
    return std::min(longest_ * kThickest_m, step_m * (step_m + slowing_m) / (2.0 * slowing_m));
  }

  /// How near to the surface skin may come that was so high: so near that it can still be brought
  /// to rest on it in whole frames. A way of a k (k + 1) / 2 is gone in k of them.
  [[nodiscard]] double brake_at(double before_m) const {
    const double way = way_from(before_m);
    if (before_m >= way * kThickest_m) return 0.0;
    const double slowing_m = slowing_on(way);
    const double step_m = 0.5 * (std::sqrt(slowing_m * (slowing_m + 8.0 * before_m)) - slowing_m);
    return std::max(0.0, before_m - step_m);
  }

 private:
  /// Times the cushion's thickness. What is nearest to the surface has to touch it in time; the
  /// rest of a hand that touches may land more softly.
  [[nodiscard]] double way_from(double before_m) const {
    return longest_ - (longest_ - 1.0) * std::clamp(search_.nearest_m / before_m, 0.0, 1.0);
  }
  [[nodiscard]] double slowing(double deceleration_mpss) const {
    return deceleration_mpss * search_.seconds * search_.seconds;
  }
  [[nodiscard]] double slowing_on(double way) const {
    return std::max(slowing(kBraking_mpss), cushioned_m_ / way);
  }

  const TouchSearch& search_;
  double longest_ = 0.0;      ///< way; 0 on a hand found anew, which comes from nowhere
  double cushioned_m_ = 0.0;  ///< what a frame slows skin down that lands on its cushion alone
};

/// Skin needs no row that is farther from the surface than this, goes to it as fast as `speed_mps`
/// when tracked, and came no more than `approach_m` nearer when drawn.
double reach_of_rows(const TouchSearch& search, const Landing& landing, double speed_mps,
                     double approach_m) {
  return std::max({search.row_reach_m, cushion_thickness(speed_mps), landing.highest(approach_m)});
}

/// How far skin may still go to where it is held out.
double room_above(const TouchSearch& search, double gap_m) {
  return gap_m + search.sink_m - kMargin_m;
}

/// Takes one more point into a patch.
void join(const PatchTouch& touch, PatchTouch& patch) {
  const double depth_m = std::max(patch.depth_m, touch.depth_m);
  if (touch.gap_m < patch.gap_m) patch = touch;
  patch.depth_m = depth_m;
}

/// Of what is kept out; null if there are as many as can be.
ContactRow* add_row(const TouchSearch& search, const PosedHand& posed, const PatchTouch& touch,
                    std::vector<ContactRow>& rows) {
  if (rows.size() == kMostSkinRows) return nullptr;
  ContactRow& row =
      rows.emplace_back(motion_along(posed, *touch.point, touch.normal, search.frame));
  row.gap_m = room_above(search, touch.gap_m);
  row.cushion_m = touch.cushion_m;
  row.curvature = touch.curvature;
  return &row;
}

/// Takes in a pad's skin over one plane: rows for what is near, of which the lowest brakes, and
/// what its part needs to know. Gives the lowest skin's height.
double add_skin(const TouchSearch& search, const Landing& landing, const NearPad& near,
                const PadPlane& plane, double curvature, const PosedHand& posed,
                PatchTouches& patches, std::vector<ContactRow>& rows) {
  const Vec3& normal = plane.normal;
  const Cushion cushion = cushion_under(search, near, normal);
  const FleshPad& pad = near.pad;
  PatchTouch lowest;
  ContactRow* braking = nullptr;
  for (std::size_t k = pad.first; k < pad.first + pad.count; ++k) {
    const FleshPoint& point = search.flesh.skin[k];
    const double gap_m = normal.dot(posed.flesh.position(point) - plane.point);
    const double cushion_m = cushion.under(gap_m, room_above(search, gap_m));
    PatchTouch touch{gap_m,    cushion.lift_m - gap_m, &point, plane.point, normal, curvature,
                     cushion_m};
    join(touch, patches[kNearestSkin]);
    if (pad.part) {
      touch.depth_m = normal.dot(plane.point - search.tracked.position(point));
      join(touch, patches[index_of(*pad.part)]);
    }
    const bool near_surface = gap_m <= search.row_reach_m + cushion_m;
    ContactRow* const row = near_surface ? add_row(search, posed, touch, rows) : nullptr;
    if (gap_m >= lowest.gap_m) continue;
    lowest = touch;
    braking = row;
  }
  const double before_m = room_above(search, lowest.gap_m) + cushion.approach_m;
  if (before_m <= 0.0 || before_m >= landing.highest(cushion.approach_m)) return lowest.gap_m;
  if (!braking) braking = add_row(search, posed, lowest, rows);
  if (!braking) return lowest.gap_m;
  braking->brake_m = landing.brake_at(before_m);
  braking->stiffness = braking->brake_m > 0.0 ? kBrakeDamping / search.seconds : 0.0;
  return lowest.gap_m;
}

/// Over all that stands in for the surface near a pad.
double add_pad(const TouchSearch& search, const Landing& landing, const NearPad& near,
               const PadMemory& known, const PosedHand& posed, PatchTouches& patches,
               std::vector<ContactRow>& rows) {
  const auto add = [&](const PadPlane& plane, double curvature) {
    return add_skin(search, landing, near, plane, curvature, posed, patches, rows);
  };
  double lowest_m = add(bent_plane(known, near.middle), known.curvature);
  for (const PadPlane& side : known.beside.seen()) lowest_m = std::min(lowest_m, add(side, 0.0));
  return lowest_m;
}

/// How strong a pull is, as `ContactState::pulls` has it: it comes in time, and goes at once.
double pull_strength(const TouchSearch& search, const PatchTouch& patch, const PullGrowth& growth,
                     std::size_t pull) {
  const double before = search.pulls_before[pull];
  const double sinking_mps = -patch.normal.dot(velocity_of(search, *patch.point));
  const double soon_m = patch.depth_m + std::clamp(kSoon_s * sinking_mps, 0.0, kMostSoon_m);
  const double strength = search.strengths[pull] *
                          smoothstep(growth.start_m, growth.full_m, soon_m) *
                          smoothstep(-kPullReach_m, kPullFade_m - kPullReach_m, -patch.gap_m);
  if (strength <= before) return strength;
  return before + followed(search.seconds, kPullTime_s) * (strength - before);
}

/// How far drawn skin is from the surface itself. At an edge or a tip that is farther than from the
/// plane that keeps out all of its pad.
double away_from_surface(const TouchSearch& search, const PosedHand& posed, const PatchTouch& patch,
                         SurfaceHint& hint) {
  const Vec3 skin = posed.flesh.position(*patch.point);
  const auto nearest = search.object.closest_point(skin, kPullReach_m, hint);
  return nearest ? std::max(patch.gap_m, nearest->signed_distance) : patch.gap_m;
}

const PullGrowth& growth_of(std::size_t pull) {
  if (pull == kNearestSkin) return kTouchPull;
  if (part_at(pull) == Part::palm) return kPalmPull;
  return part_at(pull) == Part::thumb ? kThumbPull : kPartPull;
}

void add_pulls(const TouchSearch& search, const PosedHand& posed, const PatchTouches& patches,
               SettleMemory& memory) {
  for (std::size_t i = 0; i < kPulls; ++i) {
    const PatchTouch& patch = patches[i];
    const bool nearest = i == kNearestSkin;
    const PullGrowth& growth = growth_of(i);
    const bool pulled = (search.pulls || nearest) && patch.point;
    memory.contact.pulls[i] = pulled ? pull_strength(search, patch, growth, i) : 0.0;
    if (memory.contact.pulls[i] == 0.0) continue;
    ContactRow& row =
        memory.rows.emplace_back(motion_along(posed, *patch.point, patch.normal, search.frame));
    row.kind = RowKind::draw_near;
    const double held_m = nearest ? std::min(patch.cushion_m, kHighestTouch_m) : patch.cushion_m;
    const double away_m =
        nearest ? away_from_surface(search, posed, patch, memory.under_nearest) : patch.gap_m;
    row.gap_m = away_m + search.sink_m - kPullRest_m - held_m;
    row.curvature = patch.curvature;
    row.stiffness = memory.contact.pulls[i] * growth.stiffness;
    if (!nearest || row.gap_m <= kAstray_m) continue;
    ContactRow& astray = memory.rows.emplace_back(row);
    astray.gap_m -= kAstray_m;
    astray.stiffness *= kAstrayPull / search.strengths[i];
  }
}

/// The most that any skin came nearer since the last frame.
double farthest_way(const TouchSearch& search, const PosedHand& posed) {
  double farthest_m = 0.0;
  for (std::size_t i = 0; i < kJointCount && search.before; ++i) {
    const Vec3 way = posed.flesh.origin(i) - search.before->origin(i);
    farthest_m = std::max(farthest_m, landing_part(search, way));
  }
  return kStretch * farthest_m;
}

}  // namespace

PatchTouches find_touches(const TouchSearch& search, const PosedHand& posed,
                          SettleMemory& memory) noexcept {
  memory.rows.clear();
  count_travel(posed.flesh, memory);
  PatchTouches patches;
  double fastest_mps = 0.0;
  for (const Vec3& velocity : search.velocity) {
    fastest_mps = std::max(fastest_mps, landing_part(search, velocity));
  }
  const Landing landing(search);
  const double farthest_m =
      reach_of_rows(search, landing, fastest_mps, farthest_way(search, posed));
  PadLooks looks{search.object, std::nullopt, memory.travel_m, {}};
  if (!search.before) looks.palm = posed.hand[Joint::palm].position;
  for (std::size_t i = 0; i < search.flesh.pads.size(); ++i) {
    const FleshPad& pad = search.flesh.pads[i];
    // Of a part, only what is about the nearest to the surface matters.
    const double pull_m =
        pad.part ? std::min(kPullReach_m, patches[index_of(*pad.part)].gap_m + kAboutNearest_m)
                 : 0.0;
    const double radius_m = kStretch * search.scale * pad.radius_m;
    PadMemory& known = memory.pads[i];
    const double farthest_reach_m = radius_m + std::max(farthest_m, pull_m);
    if (known.free_m - memory.travel_m > farthest_reach_m) continue;
    NearPad near{pad, posed.flesh.position(pad.middle)};
    if (left_of(near.middle, memory.travel_m, known) > farthest_reach_m) continue;
    near.velocity = velocity_of(search, pad.middle);
    near.landing_mps = landing_part(search, near.velocity);
    if (search.before) near.way = near.middle - search.before->position(pad.middle);
    const double near_m =
        reach_of_rows(search, landing, near.landing_mps, landing_part(search, near.way));
    const double reach_m = radius_m + std::max(near_m, pull_m);
    if (!find_plane(looks, near.middle, near.way, reach_m, known)) continue;
    const double lowest_m = add_pad(search, landing, near, known, posed, patches, memory.rows);
    known.same_m = plane_serves(known, lowest_m);
    // One that faces away is not looked at again until it could have come what its skin lacks.
    if (pad.part || lowest_m <= near_m) continue;
    known.free_m = std::max(known.free_m, farthest_reach_m + lowest_m - near_m + memory.travel_m);
  }
  add_pulls(search, posed, patches, memory);
  return patches;
}

}  // namespace nade
