#include "settle_jump.h"

#include <algorithm>

#include "nade/correction.h"
#include "settle_unrest.h"

namespace nade {
namespace {

/// No hand accelerates more, m/s^2; and a tracker is wont to err by so much.
constexpr double kMostAcceleration = 150.0;
constexpr double kTrackersError_m = 0.005;
/// At the tips of the digits it may be so many times that.
constexpr double kTipsMore = 1.5;
/// Frames farther apart do not say how the hand went in between.
constexpr double kFarApart_s = 0.045;
/// A jump back comes so soon, to no farther from where the hand was than this.
constexpr double kSoon_s = 0.3;
constexpr double kThere_m = 0.04;

/// A tracked joint's in the last frame, m/s.
Vec3 velocity_before(const SettleMemory& memory, std::size_t joint) {
  return memory.pace[joint] - memory.drift[joint];
}

/// And by how much it is another now.
Vec3 change_of_velocity(const HandPose& tracked, std::size_t joint, double seconds,
                        const SettleMemory& memory) {
  const Vec3& before = memory.last.tracked->joints[joint].position;
  return (tracked.joints[joint].position - before) / seconds - velocity_before(memory, joint);
}

double most_change(double seconds) {
  return kMostAcceleration * seconds + kTrackersError_m / seconds;
}

bool has_jumped(const HandPose& tracked, double seconds, const SettleMemory& memory) {
  const auto changes_more = [&](Joint joint, double than_mps) {
    return change_of_velocity(tracked, index_of(joint), seconds, memory).norm() > than_mps;
  };
  const double most_mps = most_change(seconds);
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
    const double away_m = largest_motion(*before.frame.tracked, tracked);
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

bool follow_jumps(const HandPose& tracked, double seconds, SettleMemory& memory) noexcept {
  for (FrameBeforeJump& before : memory.before_jumps) before.ago_s += seconds;
  if (!has_jumped(tracked, seconds, memory)) return seconds > kFarApart_s;
  break_motion(memory.unrest);
  if (const FrameBeforeJump* const before = gone_back_to(tracked, memory.before_jumps)) {
    memory.last = before->frame;
    memory.contact = before->contact;
    forget_planes(memory);
    memory.before_jumps = {};
  } else {
    oldest_of(memory.before_jumps) = {memory.last, memory.contact, seconds};
  }
  return true;
}

Vec3 velocity_after_jump(const HandPose& tracked, std::size_t joint, double seconds,
                         const SettleMemory& memory) noexcept {
  const Vec3 change = change_of_velocity(tracked, joint, seconds, memory);
  return velocity_before(memory, joint) + shortened(change, most_change(seconds));
}

}  // namespace nade
