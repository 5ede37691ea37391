#include "state.h"

#include "contact_finder.h"

namespace nade {
namespace {

Correction turned(const Quat& by, Correction correction) {
  correction.palm.shift = by * correction.palm.shift;
  correction.palm.turn = by * correction.palm.turn * by.conjugate();
  return correction;
}

/// Another object: what is known of the hand goes on there, what is known of the surface does not.
void go_on_at(const Object& object, const Pose& from_last, ProxyState& state) {
  const Quat& by = from_last.rotation;
  SettledFrame& last = *state.last;
  last.tracked = moved(last.tracked, from_last);
  last.drawn = moved(last.drawn, from_last);
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
  forget_surface(state);
  state.scale = object.placement().scale;
  state.shape = object.surface().shape();
}

}  // namespace

ProxyState::ProxyState(const HandFlesh& flesh) {
  pads.resize(flesh.pads.size());
  terms.reserve(kMostTerms);
  room.reserve(kMostTerms);
  forget_frame(*this);  // Eigen's vectors begin with whatever was there
}

std::optional<ShownBefore> go_on(const SeenHand& seen, const Object& object,
                                 ProxyState& state) noexcept {
  if (!seen.goes_on) state.last.reset();
  if (!seen.way_m) return std::nullopt;
  const ShownBefore before{turned(seen.from_last.rotation, state.shown), *seen.way_m};
  if (seen.at_another) go_on_at(object, seen.from_last, state);
  return before;
}

bool has_jumped(const HandPose& tracked, double seconds, ProxyState& state) noexcept {
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
    pad.plane.reset();
    pad.beside = {};
    pad.clearance_m = pad.free_m = 0.0;
    pad.out_until_m = PadMemory{}.out_until_m;
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
