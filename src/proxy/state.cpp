#include "state.h"

#include <algorithm>
#include <cmath>

#include "contact_finder.h"

namespace nade {
namespace {

Correction turned(const Quat& by, Correction correction) {
  correction.palm.shift = by * correction.palm.shift;
  correction.palm.turn = by * correction.palm.turn * by.conjugate();
  return correction;
}

/// A pad in an inside corner may be so far from its sides.
constexpr double kCorner_m = 0.03;

/// Another object: what is known of the hand goes on there.
void take_hand_over(const Pose& from_other, ProxyState& state) {
  const Quat& by = from_other.rotation;
  SettledFrame& last = *state.last;
  last.tracked = moved(last.tracked, from_other);
  last.drawn = moved(last.drawn, from_other);
  last.correction = turned(by, last.correction);
  SurfaceTouch& touch = state.touch;
  for (Vec3* const vector : {&touch.normal, &touch.lag, &touch.drawn_lag}) *vector = by * *vector;
  for (JointVectors* const vectors : {&state.motion.velocity, &state.offset_velocity}) {
    for (Vec3& vector : *vectors) vector = by * vector;
  }
  for (const Eigen::Index first : {0, 3}) {
    state.returning.from.segment<3>(first) = by * Vec3(state.returning.from.segment<3>(first));
  }
  state.motion.jumps_from = {};
}

PadPlane seen_from(const Pose& there, const PadPlane& plane) {
  return {there.apply(plane.middle), there.apply(plane.point), there.rotation * plane.normal};
}

/// And so does what is known of the surface: what was near is the same.
void take_surface_over(const Pose& from_other, ProxyState& state) {
  for (PadMemory& pad : state.pads) {
    if (pad.plane) pad.plane = seen_from(from_other, *pad.plane);
    for (PadPlane& side : pad.beside.planes) side = seen_from(from_other, side);
    pad.seen_from = from_other.apply(pad.seen_from);
    pad.outward = from_other.rotation * pad.outward;
  }
  for (Vec3& joint : state.joints) joint = from_other.apply(joint);
  for (SurfaceWatch& watch : state.watches) {
    if (!watch.before) continue;
    watch.before->point = from_other.apply(watch.before->point);
    watch.before->normal = from_other.rotation * watch.before->normal;
  }
}

void forget_plane(PadMemory& pad) {
  pad.plane.reset();
  pad.beside = {};
  pad.clearance_m = pad.free_m = 0.0;
}

}  // namespace

ProxyState::ProxyState(const HandFlesh& flesh) {
  pads.resize(flesh.pads.size());
  terms.reserve(kMostTerms);
  room.reserve(kMostTerms);
  forget_frame(*this);  // Eigen's vectors begin with whatever was there
}

std::optional<ShownBefore> go_on(const SeenHand& seen, const Object& object,
                                 const std::optional<CarrierBefore>& carrier,
                                 ProxyState& state) noexcept {
  if (!seen.goes_on) state.last.reset();
  if (!seen.way_m) return std::nullopt;
  const ShownBefore before{turned(seen.from_last.rotation, state.shown), *seen.way_m};
  if (!seen.at_another) return before;
  take_hand_over(seen.from_other, state);
  if (carrier) {
    take_surface_over(seen.from_other, state);
    state.scale = carrier->placement.scale;
    state.shape = carrier->shape;
  } else {
    forget_surface(state);
    state.scale = object.placement().scale;
    state.shape = object.surface().shape();
  }
  return before;
}

bool follow_jump(const HandPose& tracked, double seconds, ProxyState& state) noexcept {
  const SeenJump seen = follow_jumps(state.last->tracked, tracked, seconds, state.motion);
  FrameBeforeJump& before = state.before_jumps[seen.slot];
  if (seen.jump == Jump::away) before = {*state.last, state.touch, state.mode};
  if (seen.jump == Jump::back) {
    state.last = before.frame;
    state.touch = before.touch;
    state.mode = before.mode;
    forget_planes(state);
  }
  return seen.jump != Jump::none;
}

void forget_planes(ProxyState& state) noexcept {
  for (PadMemory& pad : state.pads) {
    forget_plane(pad);
    pad.out_until_m = PadMemory{}.out_until_m;
  }
}

void forget_near(const NearChange& change, double hand_radius_m, ProxyState& state) noexcept {
  // Nothing of the tracked hand is nearer to it than this.
  const double out_m = change.now.is_there ? change.now.from_m - hand_radius_m
                                           : std::numeric_limits<double>::infinity();
  for (PadMemory& pad : state.pads) {
    pad.out_until_m = std::min(pad.out_until_m, state.way_m + out_m);
    const double now_m = change.now.at_least(pad.seen_from);
    if (!pad.plane) {
      if (now_m >= pad.clearance_m) continue;
      pad.clearance_m = now_m;
      pad.free_m = 0.0;
      continue;
    }
    // As long as its plane serves, that is of the nearest surface.
    const double corner_m = pad.beside.count > 0 ? kCorner_m : 0.0;
    const double needed_m = std::abs(pad.clearance_m) + 2.0 * pad.same_m + corner_m;
    if (std::min(now_m, change.before.at_least(pad.seen_from)) > needed_m) continue;
    const PadPlane plane = *pad.plane;
    forget_plane(pad);
    pad.same_m = -1.0;
    // Another's still says which side of that the pad is on.
    pad.is_side_lost = NearObjects::place_of(pad.hint) == change.place;
    if (!pad.is_side_lost) pad.plane = plane;
  }
}

void forget_surface(ProxyState& state) noexcept {
  state.last_inside = 0;
  state.joints.fill(Vec3::Zero());
  state.travel_m = state.way_m = state.clear_s = state.stuck_s = 0.0;
  state.undeformed_s = std::numeric_limits<double>::infinity();
  state.watches.fill({});
  state.pads.assign(state.pads.size(), {});
}

void forget_frame(ProxyState& state) noexcept {
  state.last.reset();
  state.touch = {};
  state.returning = {};
  state.motion.velocity.fill(Vec3::Zero());
  state.offset_velocity.fill(Vec3::Zero());
  forget_surface(state);
}

}  // namespace nade
