#include "settle_unrest.h"

#include <algorithm>
#include <cmath>

namespace nade {
namespace {

/// Unrest is the mean over about this time.
constexpr double kUnrestTime_s = 0.35;
/// A hand is calm up to this, and restless from that on.
constexpr double kCalm_mpss = 0.1;
constexpr double kRestless_mpss = 0.4;
/// The pulls on a restless hand are so many times as strong.
constexpr double kRestlessPull = 25.0;
/// Fingers are relaxed up to this curl.
constexpr double kRelaxed_rad = 0.9;
/// Curled by so much more, a hand's parts are drawn no stronger than a calm hand's.
constexpr double kCurled_rad = 0.35;
/// Where each frame errs by itself, the change's square is so many times the acceleration's: third
/// differences against second ones.
constexpr double kWhiteChange = 20.0 / 6.0;

/// 0 for a hand that moves smoothly, to 1 for one that trembles or whose tracker errs.
double unrest_share(const Unrest& unrest) {
  if (!(unrest.root_mean > 0.0)) return 0.0;
  const double white_square = std::pow(unrest.change_root_mean, 4) / kWhiteChange;
  return smoothstep(kCalm_mpss, kRestless_mpss, white_square / std::pow(unrest.root_mean, 2));
}

}  // namespace

Unrest no_unrest() noexcept {
  Unrest unrest;
  unrest.velocity.fill(Vec3::Zero());
  unrest.acceleration.fill(Vec3::Zero());
  return unrest;
}

void follow_unrest(const HandPose& last, const HandPose& now, double seconds,
                   Unrest& unrest) noexcept {
  double square = 0.0;
  double change_square = 0.0;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Vec3 velocity = (now.joints[i].position - last.joints[i].position) / seconds;
    const Vec3 acceleration = (velocity - unrest.velocity[i]) / seconds;
    square += acceleration.squaredNorm();
    change_square += (acceleration - unrest.acceleration[i]).squaredNorm();
    unrest.velocity[i] = velocity;
    unrest.acceleration[i] = acceleration;
  }
  const double share = 1.0 - std::exp(-seconds / kUnrestTime_s);
  const auto follow = [share](double sum, double& root_mean) {
    root_mean += share * (std::pow(sum / kJointCount, 0.25) - root_mean);
  };
  if (unrest.frames >= 1) follow(square, unrest.root_mean);
  if (unrest.frames >= 2) follow(change_square, unrest.change_root_mean);
  unrest.frames = std::min(unrest.frames + 1, 2);
}

double curl_of(const HandModel& model) noexcept {
  double sum = 0.0;
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    if (digit_at(d) == Digit::thumb) continue;
    sum += model.chains[d].angles[1].flexion + model.chains[d].angles[2].flexion;
  }
  return sum / (kDigitCount - 1);
}

PullStrength pull_strength(const Unrest& unrest, const Curl& curl, double edge) noexcept {
  const double share = unrest_share(unrest) * (1.0 - edge);
  const double added_rad = curl.now_rad - std::min(curl.at_touch_rad, kRelaxed_rad);
  const double open = 1.0 - smoothstep(0.0, kCurled_rad, added_rad);
  return {std::pow(kRestlessPull, share * open), std::pow(kRestlessPull, share)};
}

}  // namespace nade
