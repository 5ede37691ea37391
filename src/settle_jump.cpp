#include "settle_jump.h"

#include "nade/correction.h"

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
constexpr double kSoon_s = 0.1;
constexpr double kThere_m = 0.04;

bool has_jumped(const HandPose& tracked, double seconds, const SettleMemory& memory) {
  const auto change_mps = [&](Joint joint) {
    const Vec3 way = tracked[joint].position - (*memory.last.tracked)[joint].position;
    return Vec3(way / seconds - velocity_before(memory, index_of(joint))).norm();
  };
  const double most_mps = most_change(seconds);
  for (const Joint corner : {Joint::wrist, Joint::index_proximal, Joint::little_proximal}) {
    if (change_mps(corner) > most_mps) return true;
  }
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    if (change_mps(joints_of(digit_at(d)).tip) > kTipsMore * most_mps) return true;
  }
  return false;
}

}  // namespace

Vec3 velocity_before(const SettleMemory& memory, std::size_t joint) noexcept {
  return memory.pace[joint] - memory.drift[joint];
}

double most_change(double seconds) noexcept {
  return kMostAcceleration * seconds + kTrackersError_m / seconds;
}

bool follow_jumps(const HandPose& tracked, double seconds, SettleMemory& memory) noexcept {
  std::optional<FrameBeforeJump>& before = memory.before_jump;
  if (before && (before->ago_s += seconds) > kSoon_s) before.reset();
  if (!has_jumped(tracked, seconds, memory)) return seconds > kFarApart_s;
  if (before && largest_motion(before->tracked, tracked) < kThere_m) {
    memory.last.correction = before->correction;
    memory.carried = before->carried;
    before.reset();
  } else if (!before) {
    before = {*memory.last.tracked, memory.last.correction, memory.carried, seconds};
  }
  return true;
}

}  // namespace nade
