#include "deformation.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "contact_finder.h"
#include "ramps.h"

namespace nade {
namespace {

/// Where the surface is watched: under these joints.
constexpr std::array<Joint, kSurfaceWatches> kWatched{
    Joint::palm,       Joint::wrist,    Joint::thumb_tip, Joint::index_tip,
    Joint::middle_tip, Joint::ring_tip, Joint::little_tip};
/// A joint so near rests on the surface, and one so far is not touched by what it does.
constexpr double kRests_m = 0.03;
constexpr double kBeyond_m = 0.06;
/// An animation may have fewer frames than the hand: one that deformed no longer ago still does.
constexpr double kDeforming_s = 0.25;
/// What was watched is gone if the surface's normal turned so far: the cosine.
constexpr double kSameSurface = 0.5;
/// What sinks faster leaves the hand behind; it may have been taken away.
constexpr double kFastestSinking_mps = 0.5;
/// A turn weighs as much as a shift by what it moves so far from the palm.
constexpr double kTurnArm_m = 0.1;
/// What the surface leaves open, as how it goes along itself, is as little as can be.
constexpr double kLeftOpen = 0.01;

/// A hand whose palm is deeper than this in what deformed was swallowed.
constexpr double kSwallowed_m = 0.04;

using SurfaceMotion = Eigen::Matrix<double, 6, 1>;  // shift, and turn times kTurnArm_m

/// How the watched surface moved, about the drawn palm.
SurfaceMotion motion_under_hand(const ScaledSurface& object, double seconds, ProxyState& state) {
  const HandPose& drawn = state.last->drawn;
  Eigen::Matrix<double, 6, 6> stiffness = kLeftOpen * Eigen::Matrix<double, 6, 6>::Identity();
  SurfaceMotion force = SurfaceMotion::Zero();
  for (std::size_t i = 0; i < kSurfaceWatches; ++i) {
    SurfaceWatch& watch = state.watches[i];
    if (!watch.before) continue;
    const Vec3& joint = drawn[kWatched[i]].position;
    const auto now = object.closest_point(joint, kBeyond_m, watch.hint);
    if (!now || now->normal.dot(watch.before->normal) < kSameSurface) continue;
    const Vec3 normal = (watch.before->normal + now->normal).normalized();
    const Vec3 lever = joint - drawn[Joint::palm].position;
    SurfaceMotion row;
    row << normal, lever.cross(normal) / kTurnArm_m;
    const double nearer_m = std::min(now->signed_distance, watch.before->signed_distance);
    const double weight = smoothstep(kBeyond_m, kRests_m, nearer_m);
    const double rise_m = std::max(watch.before->signed_distance - now->signed_distance,
                                   -kFastestSinking_mps * seconds);
    stiffness += weight * row * row.transpose();
    force += weight * rise_m * row;
  }
  return stiffness.ldlt().solve(force);
}

}  // namespace

void ride_along(const ScaledSurface& object, double seconds, ProxyState& state) noexcept {
  const SurfaceMotion motion = motion_under_hand(object, seconds, state);
  const Vec3 middle = state.last->drawn[Joint::palm].position;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    Vec3& drawn = state.last->drawn.joints[i].position;
    const Vec3 way = motion.head<3>() + motion.tail<3>().cross(drawn - middle) / kTurnArm_m;
    drawn += way;
    state.last->tracked.joints[i].position += way;
  }
}

bool is_under_hand(const NearChange& change, const ProxyState& state) noexcept {
  const auto& joints = state.last->drawn.joints;
  return std::any_of(joints.begin(), joints.end(), [&](const Pose& joint) {
    return change.before.at_least(joint.position) < kBeyond_m ||
           change.now.at_least(joint.position) < kBeyond_m;
  });
}

bool is_swallowed(const ScaledSurface& object, const ProxyState& state) noexcept {
  const Vec3& palm = state.last->drawn[Joint::palm].position;
  SurfaceHint hint;
  const auto nearest = object.closest_point(palm, kDeepest_m, hint);
  return nearest && nearest->signed_distance < -kSwallowed_m;
}

void watch_surface(const ScaledSurface& object, bool deformed, double seconds,
                   ProxyState& state) noexcept {
  state.undeformed_s = deformed ? 0.0 : state.undeformed_s + seconds;
  for (std::size_t i = 0; i < kSurfaceWatches; ++i) {
    SurfaceWatch& watch = state.watches[i];
    watch.before.reset();
    if (state.undeformed_s > kDeforming_s) continue;
    const Vec3& joint = state.last->drawn[kWatched[i]].position;
    watch.before = object.closest_point(joint, kBeyond_m, watch.hint);
  }
}

}  // namespace nade
