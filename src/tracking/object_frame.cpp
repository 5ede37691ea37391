#include "object_frame.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nade {
namespace {

/// Metres, and parts of a quaternion: far above what rounding does to a hand some metres from the
/// origin, and far below what can be seen.
constexpr double kGrid = 1.0 / (1 << 24);

Pose on_grid(const Pose& pose) {
  Pose result;
  for (int axis = 0; axis < 3; ++axis) result.position[axis] = rounded(pose.position[axis]);
  for (int part = 0; part < 4; ++part) {
    result.rotation.coeffs()[part] = rounded(pose.rotation.coeffs()[part]);
  }
  result.rotation.normalize();
  return result;
}

/// How far it has come in the world since the last frame, from where it was or from where it would
/// have gone on to, as in a car; none if it was not seen then, or jumped.
std::optional<double> way_of(const HandPose& tracked, double seconds, ProxyState& state) {
  const Vec3 went_before = std::exchange(state.went, Vec3::Zero());
  if (!state.last || seconds > kMissing_s) return std::nullopt;
  HandPose last = moved(state.last->tracked, state.place);
  state.went = tracked[Joint::palm].position - last[Joint::palm].position;
  const double from_there_m = largest_motion(last, tracked);
  for (Pose& joint : last.joints) joint.position += went_before;
  const double way_m = std::min(from_there_m, largest_motion(last, tracked));
  return way_m <= kTeleport_m ? std::optional(way_m) : std::nullopt;
}

Correction turned(const Quat& turn, Correction correction) {
  correction.palm.shift = turn * correction.palm.shift;
  correction.palm.turn = turn * correction.palm.turn * turn.conjugate();
  return correction;
}

/// Another object, to whose frame `to` leads: what is known of the hand goes on there, what is
/// known of the surface does not.
void go_on_at(const Object& object, const Pose& to, ProxyState& state) {
  const Quat& turn = to.rotation;
  SettledFrame& last = *state.last;
  last.tracked = moved(last.tracked, to);
  last.drawn = moved(last.drawn, to);
  last.correction = turned(turn, last.correction);
  SurfaceTouch& touch = state.touch;
  for (Vec3* const vector : {&touch.normal, &touch.lag, &touch.drawn_lag}) {
    *vector = turn * *vector;
  }
  for (JointVectors* const vectors : {&state.tracked_velocity, &state.offset_velocity}) {
    for (Vec3& vector : *vectors) vector = turn * vector;
  }
  for (const Eigen::Index first : {0, 3}) {
    state.returning.from.segment<3>(first) = turn * Vec3(state.returning.from.segment<3>(first));
  }
  state.before_jumps = {};
  forget_surface(state);
  state.scale = object.placement().scale;
  state.shape = object.surface().shape();
}

}  // namespace

bool is_nowhere(const Object& object, const HandPose& tracked) noexcept {
  const Placement& placement = object.placement();
  return placement.scale == 0.0 || !is_usable(moved(tracked, placement.pose.inverse()));
}

double rounded(double scale) noexcept { return kGrid * std::nearbyint(scale / kGrid); }

SeenHand see_hand(const HandPose& tracked, const Object& object, double seconds,
                  ProxyState& state) noexcept {
  SeenHand seen;
  const Pose& now = object.placement().pose;
  const std::optional<double> way_m = way_of(tracked, seconds, state);
  const bool is_another = state.object != object.identity();
  if (is_another && !way_m) state.last.reset();
  if (!state.last) state.home = now;
  const Pose place = on_grid(state.home.inverse() * now);
  const Pose before = std::exchange(state.place, state.home * place);
  const Pose to = state.place.inverse() * before;
  if (way_m) seen.before = ShownBefore{turned(to.rotation, state.shown), *way_m};
  seen.at_another = is_another && way_m;
  if (seen.at_another) go_on_at(object, to, state);
  HandPose from_home = moved(tracked, state.home.inverse());
  for (Pose& joint : from_home.joints) joint = on_grid(joint);
  seen.tracked = moved(from_home, place.inverse());
  return seen;
}

ProxyResult brought_back(const Pose& object, const HandPose& tracked, ProxyResult result) noexcept {
  result.hand = result.corrected ? moved(result.hand, object) : tracked;
  for (std::optional<PartContact>& contact : result.contacts) {
    if (!contact) continue;
    for (Vec3* point : {&contact->ray_origin, &contact->surface_point, &contact->target}) {
      *point = object.apply(*point);
    }
    for (Vec3* way : {&contact->ray_direction, &contact->normal, &contact->skin_direction}) {
      *way = object.rotation * *way;
    }
  }
  return result;
}

}  // namespace nade
