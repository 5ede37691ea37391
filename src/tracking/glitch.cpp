#include "glitch.h"

#include <algorithm>

#include "nade/correction.h"

namespace nade {
namespace {

// Anatomy: no hand accelerates more, m/s^2; at the tips of the digits it may be so many times that.
constexpr double kMostAcceleration = 150.0;
constexpr double kTipsMore = 1.5;
// Trackers: they are wont to err by so much; they jump back so soon, to no farther than this from
// where the hand was; and of a jump's velocity, at most this counts.
constexpr double kTrackersError_m = 0.005;
constexpr double kSoon_s = 0.3;
constexpr double kThere_m = 0.04;
constexpr double kMostOfJump_mps = 1.0;

bool has_jumped(const HandPose& last, const HandPose& tracked, double seconds,
                const JointVectors& velocity) {
  const double most_mps = kMostAcceleration * seconds + kTrackersError_m / seconds;
  const auto changes_more = [&](Joint joint, double than_mps) {
    const Vec3 way = tracked[joint].position - last[joint].position;
    return (way / seconds - velocity[index_of(joint)]).norm() > than_mps;
  };
  for (const Joint corner : {Joint::wrist, Joint::index_proximal, Joint::little_proximal}) {
    if (changes_more(corner, most_mps)) return true;
  }
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    if (changes_more(joints_of(digit_at(d)).tip, kTipsMore * most_mps)) return true;
  }
  return false;
}

}  // namespace

SeenJump follow_jumps(const HandPose& last, const HandPose& tracked, double seconds,
                      TrackedMotion& motion) noexcept {
  auto& frames = motion.jumps_from;
  for (BeforeJump& before : frames) before.ago_s += seconds;
  if (!has_jumped(last, tracked, seconds, motion.velocity)) return {};
  SeenJump seen{Jump::away, 0};
  double nearest_m = kThere_m;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].ago_s > kSoon_s) continue;
    const double away_m = largest_motion(frames[i].tracked, tracked);
    if (away_m >= nearest_m) continue;
    nearest_m = away_m;
    seen = {Jump::back, i};
  }
  if (seen.jump == Jump::back) {
    frames = {};
    return seen;
  }
  const auto oldest = std::max_element(
      frames.begin(), frames.end(), [](const auto& a, const auto& b) { return a.ago_s < b.ago_s; });
  *oldest = {last, seconds};
  seen.slot = static_cast<std::size_t>(oldest - frames.begin());
  return seen;
}

void follow_velocity(const HandPose& last, const HandPose& tracked, double seconds, bool jumped,
                     TrackedMotion& motion) noexcept {
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Vec3 way = tracked.joints[i].position - last.joints[i].position;
    const Vec3 change = way / seconds - motion.velocity[i];
    motion.velocity[i] += jumped ? shortened(change, kMostOfJump_mps) : change;
  }
}

}  // namespace nade
