#include "contact_finder.h"

#include <algorithm>
#include <cmath>

#include "ramps.h"

namespace nade {
namespace {

/// As stiff as a surface is, 1/m^2.
constexpr double kSurfaceStiffness = 1.2e7;
/// Skin stretches by no more than this when the hand is posed, and goes no farther than a joint.
constexpr double kStretch = 1.3;
/// While all palmar skin is higher than this, nothing is drawn to the surface.
constexpr double kNotPressed_m = -0.003;
/// Adhesion begins with a patch that is half as far out of the surface as it is in where it is
/// whole, and fades over this way before its reach.
constexpr double kFromShare = -0.5;
constexpr double kFade_m = 0.01;
/// Skin is looked for that comes down in the next frames: so far off, and by the hand's speed.
constexpr double kComing_m = 0.002;
constexpr double kComing_s = 0.03;
/// How firmly skin is braked, s/m^2.
constexpr double kLandingDamping = 500.0;
/// A landing term is needed from this share of the most that a frame may bring skin down.
constexpr double kLandingShare = 0.5;

// What holds a pad back from where the person has it by this share of `step_up_m`, and surely by
// all of it, is stepped over: its side counts as sloping up to so steep a ramp, where it is steep
// and no higher than so many times that way.
constexpr double kHeldShare = 0.25;
constexpr double kRamp = 1.0;   // rise over run
constexpr double kSteep = 0.3;  // cosines of the side's normal with the way up
constexpr double kNotSteep = 0.7;
constexpr double kHighestStep = 2.0;
constexpr double kBefore_m = 0.003;  // room is looked for from so far before the side
constexpr double kRoom_m = 0.02;

/// By joint: the number of the bone that it carries, in `kBones`.
constexpr std::array<std::size_t, kJointCount> kBoneOf = [] {
  std::array<std::size_t, kJointCount> result{};
  for (std::size_t bone = 0; bone < kBones.size(); ++bone) {
    const std::size_t joint = index_of(kBones[bone]);
    result[joint] = bone;
    // What a tip carries is of the phalanx before it.
    for (std::size_t d = 0; d < kDigitCount; ++d) {
      const std::size_t tip = index_of(joints_of(digit_at(d)).tip);
      if (joint + 1 == tip) result[tip] = bone;
    }
  }
  return result;
}();

bool is_palm(SkinRegion region) {
  return region == SkinRegion::heel || region == SkinRegion::hollow ||
         region == SkinRegion::knuckles;
}

/// Adds how far the hand has gone against the object since the last look.
void count_travel(const HandPose& hand, ProxyState& state) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Vec3& origin = hand.joints[i].position;
    farthest = std::max(farthest, (origin - state.joints[i]).squaredNorm());
    state.joints[i] = origin;
  }
  state.travel_m += kStretch * std::sqrt(farthest);
}

/// A side that a pad meets, and how much of a ramp it is, 0 to 1.
struct Side {
  PadPlane plane;
  double ramp = 0.0;
  Vec3 normal = Vec3::UnitY();  ///< of the ramp
};

/// A pad's skin that is nearest to its plane.
struct Lowest {
  double gap_m = std::numeric_limits<double>::infinity();
  std::uint32_t skin = 0;
};

class Finder {
 public:
  Finder(const ContactSearch& search, const PosedHand& posed, ProxyState& state)
      : search_(search), posed_(posed), state_(state) {}

  FoundContacts run() {
    state_.terms.clear();
    count_travel(posed_.hand, state_);
    PadLooks looks{search_.object,
                   search_.before ? &*search_.before : nullptr,
                   posed_.hand[Joint::palm].position,
                   search_.planes_lost,
                   state_.travel_m,
                   {}};
    const ProxyTuning& tuning = search_.tuning;
    pressed_ = smoothstep(kNotPressed_m, tuning.pressed_m, search_.deepest_m);
    const double frame_m = search_.speed_mps * search_.seconds;
    // A way of k (k + 1) / 2 is gone in k frames by what one takes off.
    braking_m_ = frame_m * frame_m / (2.0 * tuning.landing_m);
    skin_reach_m_ = std::max(search_.reach_m,
                             std::min(tuning.landing_m, kComing_m + kComing_s * search_.speed_mps));
    for (std::size_t i = 0; i < state_.pads.size(); ++i) look_at(i, looks);
    return found_;
  }

 private:
  void look_at(std::size_t index, PadLooks& looks) {
    const FleshPad& pad = search_.flesh.pads[index];
    PadMemory& known = state_.pads[index];
    const double palmar_m = !pad.palmar      ? 0.0
                            : pressed_ > 0.0 ? search_.tuning.adhesion_reach_m
                                             : kFade_m;
    const double reach_m =
        kStretch * search_.scale * pad.radius_m + std::max(skin_reach_m_, palmar_m);
    if (known.free_m - state_.travel_m > reach_m) return;
    const Vec3 middle = posed_.flesh.position(pad.middle);
    if (left_of(middle, state_.travel_m, known) > reach_m) return;
    if (!find_plane(looks, pad.middle, middle, reach_m, known)) return;
    const PadPlane plane = bent_plane(known, middle);
    const double room_m =
        plane.normal.dot(middle - plane.point) - kStretch * search_.scale * pad.radius_m;
    if (room_m > skin_reach_m_ && !pad.part) {
      known.same_m = plane_serves(known, room_m);
      if (pad.palmar) draw_near(*pad.palmar, plane, 1.0);
      return;
    }
    const Side nearest = side_at(pad, middle, plane);
    const Lowest lowest = keep_out(pad, nearest);
    for (const PadPlane& side : known.beside.seen()) {
      (void)keep_out(pad, side_at(pad, middle, side));
    }
    known.same_m = plane_serves(known, lowest.gap_m);
    brake(lowest, plane);
    if (pad.palmar) draw_near(*pad.palmar, plane, 1.0 - nearest.ramp);
    if (pad.part) touch_part(*pad.part, lowest, plane);
    if (lowest.gap_m < kTouches_m + search_.reach_m) touch_bone(pad, lowest, plane, known.hint);
    const double slack_m = lowest.gap_m - skin_reach_m_;
    if (!pad.palmar && slack_m > 0.0) {
      known.free_m = std::max(known.free_m, reach_m + slack_m + state_.travel_m);
    }
  }

  /// Whether the object holds a pad back that could step over it.
  [[nodiscard]] Side side_at(const FleshPad& pad, const Vec3& middle, const PadPlane& plane) const {
    Side side{plane, 0.0, plane.normal};
    const Vec3& up = search_.up;
    const double steep = smoothstep(kNotSteep, kSteep, std::abs(plane.normal.dot(up)));
    if (steep == 0.0) return side;
    const Vec3 back = along_surface(plane.normal, up).normalized();
    const double held_m = back.dot(middle - search_.tracked.position(pad.middle));
    if (held_m <= kHeldShare * search_.tuning.step_up_m) return side;
    const Vec3 above = middle + kHighestStep * held_m * up + kBefore_m * back;
    if (search_.object.first_hit({above, -back, kRoom_m})) return side;
    side.ramp =
        steep * smoothstep(kHeldShare * search_.tuning.step_up_m, search_.tuning.step_up_m, held_m);
    side.normal = (plane.normal + side.ramp / kRamp * up).normalized();
    return side;
  }

  ContactTerm* add(ContactKind kind, const FleshPoint& point, const Vec3& normal, double gap_m) {
    if (state_.terms.size() == state_.terms.capacity()) return nullptr;
    ContactTerm& term = state_.terms.emplace_back();
    term.kind = kind;
    term.row = motion_along(posed_, point, normal);
    term.row.gap_m = gap_m;
    return &term;
  }

  [[nodiscard]] double gap_of(const FleshPoint& point, const PadPlane& plane) const {
    return plane.normal.dot(posed_.flesh.position(point) - plane.point);
  }

  Lowest keep_out(const FleshPad& pad, const Side& side) {
    Lowest lowest;
    const double slope = side.normal.dot(side.plane.normal);
    for (std::uint32_t k = pad.first; k < pad.first + pad.count; ++k) {
      const FleshPoint& point = search_.flesh.skin[k];
      const double gap_m = gap_of(point, side.plane);
      if (gap_m < lowest.gap_m) lowest = {gap_m, k};
      const double given_m = search_.flesh.depth_m[k] + search_.sink_m;
      if (gap_m + given_m > search_.reach_m) continue;
      if (ContactTerm* const term = add(ContactKind::flesh, point, side.normal, slope * gap_m)) {
        term->stiffness = kSurfaceStiffness;
        term->edge_m = -given_m;
      }
    }
    return lowest;
  }

  /// A damper on a pad's lowest skin, so that it can stop evenly.
  void brake(const Lowest& lowest, const PadPlane& plane) {
    if (!search_.before || lowest.gap_m < -2.0 * search_.reach_m) return;
    const FleshPoint& point = search_.flesh.skin[lowest.skin];
    const double before_m = plane.normal.dot(search_.before->position(point) - plane.point);
    if (before_m <= 0.0 || before_m >= search_.tuning.landing_m) return;
    const double most_m =
        0.5 * (std::sqrt(braking_m_ * (braking_m_ + 8.0 * before_m)) - braking_m_);
    if (before_m - lowest.gap_m <= kLandingShare * most_m) return;
    if (ContactTerm* const term = add(ContactKind::landing, point, plane.normal, lowest.gap_m)) {
      term->stiffness = kLandingDamping / search_.seconds;
      term->edge_m = before_m - most_m;
    }
  }

  /// `weight`: 0 to 1.
  void draw_near(const PalmarPatch& patch, const PadPlane& plane, double weight) {
    const ProxyTuning& tuning = search_.tuning;
    const double gap_m = gap_of(patch.middle, plane) + search_.sink_m;
    const double depth_m = plane.normal.dot(plane.point - search_.tracked.position(patch.middle));
    const double near =
        smoothstep(-tuning.adhesion_reach_m, kFade_m - tuning.adhesion_reach_m, -gap_m);
    found_.deepest_m = std::max(found_.deepest_m, depth_m);
    if (is_palm(patch.region)) {
      found_.palm.depth_m = std::max(found_.palm.depth_m, depth_m);
      found_.palm.normal += near * patch.area_m2 * plane.normal;
    }
    const double share =
        weight * pressed_ * near *
        smoothstep(kFromShare * tuning.adhesion_full_m, tuning.adhesion_full_m, depth_m);
    if (share == 0.0) return;
    const double stiffness = share * tuning.adhesion * patch.area_m2;
    found_.pull += stiffness * plane.normal;
    if (gap_m < -search_.reach_m) return;  // lies in the flesh whatever the step
    if (gap_m > tuning.adhesion_height_m + search_.reach_m) {
      add_even_pull(motion_along(posed_, patch.middle, plane.normal),
                    stiffness * tuning.adhesion_height_m);
      return;
    }
    if (ContactTerm* const term = add(ContactKind::adhesion, patch.middle, plane.normal, gap_m)) {
      term->stiffness = stiffness;
      term->edge_m = tuning.adhesion_height_m;
    }
  }

  void add_even_pull(const ContactRow& row, double force) {
    found_.even_pull.head<6>() -= force * row.wrist;
    if (!row.digit) return;
    found_.even_pull.segment<4>(first_freedom(index_of(*row.digit))) -= force * row.bend;
  }

  void touch_part(Part part, const Lowest& lowest, const PadPlane& plane) {
    PartTouch& touch = found_.parts[index_of(part)];
    const FleshPoint& point = search_.flesh.skin[lowest.skin];
    touch.depth_m =
        std::max(touch.depth_m, plane.normal.dot(plane.point - search_.tracked.position(point)));
    if (lowest.gap_m >= touch.gap_m) return;
    touch.gap_m = lowest.gap_m;
    touch.point = &point;
    touch.plane = plane;
  }

  void touch_bone(const FleshPad& pad, const Lowest& lowest, const PadPlane& plane,
                  const SurfaceHint& hint) {
    BoneTouch& touch = found_.bones[kBoneOf[pad.middle.joints[0]]];
    const FleshPoint& point = search_.flesh.skin[lowest.skin];
    const double depth_m = plane.normal.dot(plane.point - search_.tracked.position(point));
    touch.depth_m = std::max(touch.depth_m, depth_m);
    if (touch.point != nullptr && lowest.gap_m >= touch.gap_m) return;
    touch.gap_m = lowest.gap_m;
    touch.point = &point;
    touch.plane = plane;
    touch.hint = hint;
  }

  const ContactSearch& search_;
  const PosedHand& posed_;
  ProxyState& state_;
  double pressed_ = 0.0;       ///< how surely the person presses, 0 to 1
  double braking_m_ = 0.0;     ///< what a frame may take off the way of skin that lands
  double skin_reach_m_ = 0.0;  ///< skin nearer than this matters
  FoundContacts found_;
};

}  // namespace

FoundContacts find_contacts(const ContactSearch& search, const PosedHand& posed,
                            ProxyState& state) noexcept {
  return Finder(search, posed, state).run();
}

}  // namespace nade
