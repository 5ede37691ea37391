#include "glitch.h"

#include <algorithm>

#include "nade/correction.h"

namespace nade {
namespace {

/// No hand accelerates more, m/s^2; and a tracker is wont to err by so much.
constexpr double kMostAcceleration = 150.0;
constexpr double kTrackersError_m = 0.005;
/// At the tips of the digits it may be so many times that.
constexpr double kTipsMore = 1.5;
/// A jump back comes so soon, to no farther from where the hand was than this.
constexpr double kSoon_s = 0.3;
constexpr double kThere_m = 0.04;

bool has_jumped(const HandPose& tracked, double seconds, const ProxyState& state) {
  const double most_mps = kMostAcceleration * seconds + kTrackersError_m / seconds;
  const auto changes_more = [&](Joint joint, double than_mps) {
    const Vec3 way = tracked[joint].position - state.last->tracked[joint].position;
    return (way / seconds - state.tracked_velocity[index_of(joint)]).norm() > than_mps;
  };
  for (const Joint corner : {Joint::wrist, Joint::index_proximal, Joint::little_proximal}) {
    if (changes_more(corner, most_mps)) return true;
  }
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    if (changes_more(joints_of(digit_at(d)).tip, kTipsMore * most_mps)) return true;
  }
  return false;
}

/// The frame before a jump to which the hand has jumped back, if any: the nearest.
const FrameBeforeJump* gone_back_to(const HandPose& tracked, const FramesBeforeJumps& frames) {
  const FrameBeforeJump* nearest = nullptr;
  double nearest_m = kThere_m;
  for (const FrameBeforeJump& before : frames) {
    if (before.ago_s > kSoon_s) continue;
    const double away_m = largest_motion(before.frame.tracked, tracked);
    if (away_m >= nearest_m) continue;
    nearest_m = away_m;
    nearest = &before;
  }
  return nearest;
}

FrameBeforeJump& oldest_of(FramesBeforeJumps& frames) {
  return *std::max_element(frames.begin(), frames.end(),
                           [](const auto& a, const auto& b) { return a.ago_s < b.ago_s; });
}

}  // namespace

bool follow_jumps(const HandPose& tracked, double seconds, ProxyState& state) noexcept {
  for (FrameBeforeJump& before : state.before_jumps) before.ago_s += seconds;
  if (!has_jumped(tracked, seconds, state)) return false;
  if (const FrameBeforeJump* const before = gone_back_to(tracked, state.before_jumps)) {
    state.last = before->frame;
    state.touch = before->touch;
    state.mode = before->mode;
    forget_planes(state);
    state.before_jumps = {};
  } else {
    oldest_of(state.before_jumps) = {*state.last, state.touch, state.mode, seconds};
  }
  return true;
}

}  // namespace nade
