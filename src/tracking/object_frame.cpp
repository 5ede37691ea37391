#include "object_frame.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "nade/correction.h"

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
/// have gone on to, as in a car.
std::optional<double> way_of(const HandPose& tracked, double seconds, const HandPose* last,
                             ObjectFrame& frame) {
  const Vec3 went_before = std::exchange(frame.went, Vec3::Zero());
  if (last == nullptr || seconds > kMissing_s) return std::nullopt;
  HandPose before = moved(*last, frame.place);
  frame.went = tracked[Joint::palm].position - before[Joint::palm].position;
  const double from_there_m = largest_motion(before, tracked);
  for (Pose& joint : before.joints) joint.position += went_before;
  const double way_m = std::min(from_there_m, largest_motion(before, tracked));
  return way_m <= kTeleport_m ? std::optional(way_m) : std::nullopt;
}

}  // namespace

bool is_nowhere(const Object& object, const HandPose& tracked) noexcept {
  const Placement& placement = object.placement();
  return placement.scale == 0.0 || !is_usable(moved(tracked, placement.pose.inverse()));
}

double rounded(double scale) noexcept { return kGrid * std::nearbyint(scale / kGrid); }

SeenHand see_hand(const HandPose& tracked, const Object& object, double seconds,
                  const HandPose* last, const Pose* object_before, ObjectFrame& frame) noexcept {
  SeenHand seen;
  const Pose& now = object.placement().pose;
  seen.way_m = way_of(tracked, seconds, last, frame);
  const bool is_another = std::exchange(frame.object, object.identity()) != object.identity();
  seen.goes_on = last != nullptr && (seen.way_m || !is_another);
  seen.at_another = is_another && seen.way_m;
  if (!seen.goes_on) frame.home = now;
  const Pose place = on_grid(frame.home.inverse() * now);
  const Pose before = std::exchange(frame.place, frame.home * place);
  seen.from_last = frame.place.inverse() * before;
  seen.from_other = seen.from_last;
  if (object_before != nullptr) {
    const Pose was = frame.home * on_grid(frame.home.inverse() * *object_before);
    seen.from_other = was.inverse() * before;
  }
  HandPose from_home = moved(tracked, frame.home.inverse());
  for (Pose& joint : from_home.joints) joint = on_grid(joint);
  seen.tracked = moved(from_home, place.inverse());
  return seen;
}

}  // namespace nade
