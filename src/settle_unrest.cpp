#include "settle_unrest.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ramps.h"

namespace nade {
namespace {

/// Unrest is the mean over about this time.
constexpr double kUnrestTime_s = 0.35;
/// So many samples tell how the acceleration changes.
constexpr int kEnoughSamples = 4;
/// Samples are taken no closer than this, and belong to one motion if they are no farther apart.
constexpr double kClosest_s = 0.002;
constexpr double kFarthest_s = 0.05;
/// A hand is calm up to this, and restless from that on; at 90 samples a second.
constexpr double kCalm_mpss = 0.05;
constexpr double kRestless_mpss = 0.25;
/// No frame counts less, or more.
constexpr double kShortestFrame_s = 0.001;
constexpr double kLongestFrame_s = 0.05;
/// Where by the frames' times a hand is so much more restless than if they were even, they are not
/// as they say; but one that comes so many times as late came after a lost one.
constexpr double kCalmerShare = 0.5;
constexpr double kLost = 2.5;
/// Whose joints accelerate by less is at rest.
constexpr double kStill_mpss = 1e-6;
/// A hand that is seen for the first time counts as half restless so long, or until it is known.
constexpr double kUnknown_s = 0.05;
constexpr double kUnknownShare = 0.5;
/// The pulls on a restless hand are so many times as strong.
constexpr double kRestlessPull = 36.1;
/// A calm thumb is drawn more strongly than a finger, a restless one is not.
constexpr double kRestlessThumbPull = 23.1;
/// Fingers are relaxed up to this curl.
constexpr double kRelaxed_rad = 0.9;
/// Curled by so much more, a finger is drawn no more strongly than a calm hand's.
constexpr double kCurled_rad = 0.65;
/// Where each frame errs by itself, the change's square is so many times the acceleration's: third
/// differences against second ones.
constexpr double kWhiteChange = 20.0 / 6.0;

/// j^3/a^2, docs/method.md.
double unrest_of(const Acceleration& by_clock) {
  const double acceleration = by_clock.root_mean * by_clock.root_mean;
  if (!(acceleration > kStill_mpss)) return 0.0;
  const double change = by_clock.change_root_mean * by_clock.change_root_mean;
  const double white = change / std::sqrt(kWhiteChange);
  const double newness = white / acceleration;
  return newness * newness * white;
}

/// By one of the clocks, from where the hand is calmer.
double unrest_mpss(const Unrest& unrest, Acceleration SeenMotion::*clock) {
  return std::min(unrest_of(unrest.from_home.*clock), unrest_of(unrest.from_object.*clock));
}

/// 0 for a hand that moves smoothly, to 1 for one that trembles or whose tracker errs.
double unrest_share(const Unrest& unrest) {
  const bool known =
      unrest.samples >= kEnoughSamples || unrest.from_home.by_times.change_root_mean > 0.0;
  if (!known && unrest.age_s <= kUnknown_s) return kUnknownShare;
  return smoothstep(kCalm_mpss, kRestless_mpss,
                    std::min(unrest_mpss(unrest, &SeenMotion::by_times),
                             unrest_mpss(unrest, &SeenMotion::by_samples)));
}

/// Takes a share of a value into a mean that begins with the first.
void follow_mean(double value, double share, double& mean) {
  mean = mean == 0.0 ? value : mean + share * (value - mean);
}

/// Takes in a sample of a motion that there are `samples` of already: what the joints went since
/// the last, so long ago by a clock whose unit takes `unit_s`.
void follow_acceleration(const JointVectors& ways, double elapsed, double unit_s, int samples,
                         double share, Acceleration& by_clock) {
  double square = 0.0;
  double change_square = 0.0;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Vec3 velocity = ways[i] / elapsed;
    const Vec3 acceleration = (velocity - by_clock.velocity[i]) / elapsed;
    square += acceleration.squaredNorm();
    change_square += (acceleration - by_clock.latest[i]).squaredNorm();
    by_clock.velocity[i] = velocity;
    by_clock.latest[i] = acceleration;
  }
  const auto root = [&](double sum) { return std::pow(sum / kJointCount, 0.25) / unit_s; };
  if (samples >= 2) follow_mean(root(square), share, by_clock.root_mean);
  if (samples >= 3) follow_mean(root(change_square), share, by_clock.change_root_mean);
}

bool has_moved(const HandPose& hand, const JointVectors& joints) {
  for (std::size_t i = 0; i < kJointCount; ++i) {
    if (hand.joints[i].position != joints[i]) return true;
  }
  return false;
}

/// Takes in a sample as seen from one place; of the first of a motion, only where it is.
void follow_motion(const HandPose& hand, double elapsed_s, double share, const Unrest& unrest,
                   SeenMotion& seen) {
  JointVectors ways;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    ways[i] = hand.joints[i].position - seen.joints[i];
    seen.joints[i] = hand.joints[i].position;
  }
  if (unrest.samples == 0) return;
  follow_acceleration(ways, elapsed_s, 1.0, unrest.samples, share, seen.by_times);
  follow_acceleration(ways, 1.0, unrest.apart_s, unrest.samples, share, seen.by_samples);
}

/// 1 for a finger that is open, 0 for one that is curled.
double openness(double curl_rad, double at_touch_rad) {
  const double added_rad = curl_rad - std::min(at_touch_rad, kRelaxed_rad);
  return 1.0 - smoothstep(0.0, kCurled_rad, added_rad);
}

}  // namespace

Unrest no_unrest() noexcept {
  Unrest unrest;
  for (SeenMotion* const seen : {&unrest.from_home, &unrest.from_object}) {
    seen->joints.fill(Vec3::Zero());
    for (Acceleration* const by_clock : {&seen->by_times, &seen->by_samples}) {
      by_clock->velocity.fill(Vec3::Zero());
      by_clock->latest.fill(Vec3::Zero());
    }
  }
  return unrest;
}

double frame_seconds(double seconds, const Unrest& unrest) noexcept {
  const bool is_calmer = unrest_mpss(unrest, &SeenMotion::by_samples) <
                         kCalmerShare * unrest_mpss(unrest, &SeenMotion::by_times);
  const bool is_even = is_calmer && seconds < kLost * unrest.frame_s;
  return std::clamp(is_even ? unrest.frame_s : seconds, kShortestFrame_s, kLongestFrame_s);
}

void break_motion(Unrest& unrest) noexcept { unrest.samples = 0; }

void follow_unrest(const HandPose& from_home, const HandPose& from_object, double seconds,
                   Unrest& unrest) noexcept {
  unrest.elapsed_s += seconds;
  unrest.age_s += seconds;
  if (seconds <= kFarthest_s) {
    follow_mean(seconds, followed(seconds, kUnrestTime_s), unrest.frame_s);
  }
  const bool repeats = !has_moved(from_home, unrest.from_home.joints) ||
                       !has_moved(from_object, unrest.from_object.joints);
  if (unrest.samples > 0 && (repeats || unrest.elapsed_s < kClosest_s)) return;
  if (unrest.elapsed_s > kFarthest_s) break_motion(unrest);
  const double elapsed_s = std::exchange(unrest.elapsed_s, 0.0);
  const double share = followed(elapsed_s, kUnrestTime_s);
  if (unrest.samples > 0) follow_mean(elapsed_s, share, unrest.apart_s);
  follow_motion(from_home, elapsed_s, share, unrest, unrest.from_home);
  follow_motion(from_object, elapsed_s, share, unrest, unrest.from_object);
  unrest.samples = std::min(unrest.samples + 1, kEnoughSamples);
}

FingerCurls curls_of(const HandModel& model) noexcept {
  FingerCurls curls{};
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    if (digit_at(d) == Digit::thumb) continue;
    curls[d] = curl_of(model.chains[d].angles);
  }
  return curls;
}

PullStrengths pull_strengths(const Unrest& unrest, const FingerCurls& curls,
                             const FingerCurls& at_touch) noexcept {
  const double share = unrest_share(unrest);
  PullStrengths strengths;
  strengths[kNearestSkin] = std::pow(kRestlessPull, share);
  strengths[index_of(Part::thumb)] = std::pow(kRestlessThumbPull, share);
  double open_fingers = 0.0;
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    if (digit_at(d) == Digit::thumb) continue;
    const double open = openness(curls[d], at_touch[d]);
    open_fingers += open;
    strengths[index_of(part_of(digit_at(d)))] = std::pow(kRestlessPull, share * open);
  }
  // What draws the palm down would open the fingers that hold it up.
  constexpr double kFingers = kDigitCount - 1;
  strengths[index_of(Part::palm)] = std::pow(kRestlessPull, share * open_fingers / kFingers);
  return strengths;
}

}  // namespace nade
