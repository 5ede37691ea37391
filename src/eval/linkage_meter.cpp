#include "linkage_meter.h"

#include <algorithm>
#include <cmath>

namespace nade {
namespace {

constexpr double kLongestLag_s = 0.25;
/// Variance over mean square below which a velocity counts as constant.
constexpr double kConstant = 1e-6;
/// Correlations closer than this are the same: the smaller lag wins.
constexpr double kSame = 1e-9;

}  // namespace

void LinkageMeter::Sums::add(const Vec3& tracked_velocity, const Vec3& corrected_velocity) {
  count += 1.0;
  product += tracked_velocity.dot(corrected_velocity);
  tracked_square += tracked_velocity.squaredNorm();
  corrected_square += corrected_velocity.squaredNorm();
  tracked += tracked_velocity;
  corrected += corrected_velocity;
}

void LinkageMeter::Sums::merge(const Sums& other) {
  count += other.count;
  product += other.product;
  tracked_square += other.tracked_square;
  corrected_square += other.corrected_square;
  tracked += other.tracked;
  corrected += other.corrected;
}

std::optional<double> LinkageMeter::Sums::correlation() const {
  const double tracked_variance = tracked_square - tracked.squaredNorm() / count;
  const double corrected_variance = corrected_square - corrected.squaredNorm() / count;
  if (!(tracked_variance > kConstant * tracked_square)) return std::nullopt;
  if (!(corrected_variance > kConstant * corrected_square)) return std::nullopt;
  const double covariance = product - tracked.dot(corrected) / count;
  return covariance / std::sqrt(tracked_variance * corrected_variance);
}

void LinkageMeter::add(const PalmStep& step) {
  if (!(step.seconds > 0.0)) return;
  path_m_ += step.tracked_m.norm();
  const Velocities now{step.tracked_m / step.seconds, step.corrected_m / step.seconds};
  newest_ = (newest_ + 1) % past_.size();
  past_[newest_] = now;
  known_ = std::min(known_ + 1, past_.size());
  seconds_.add(step.seconds);
  for (std::size_t back = 0; back < known_; ++back) {
    const Velocities& then = past_[(newest_ + past_.size() - back) % past_.size()];
    sums_[static_cast<std::size_t>(kMaxLag) + back].add(then.tracked, now.corrected);
    if (back == 0) continue;
    sums_[static_cast<std::size_t>(kMaxLag) - back].add(now.tracked, then.corrected);
  }
}

void LinkageMeter::break_off() { known_ = 0; }

void LinkageMeter::merge(const LinkageMeter& other) {
  for (std::size_t i = 0; i < kLagCount; ++i) sums_[i].merge(other.sums_[i]);
  seconds_.merge(other.seconds_);
  path_m_ += other.path_m_;
  break_off();
}

std::optional<double> LinkageMeter::find_lag_frames(double frame_seconds) const {
  const auto range = std::min<std::ptrdiff_t>(
      kMaxLag, static_cast<std::ptrdiff_t>(std::floor(kLongestLag_s / frame_seconds)));
  // A lag that few pairs speak for can look better than it is.
  const double enough = 0.5 * at_lag(0).count;
  std::optional<std::ptrdiff_t> best;
  double highest = 0.0;
  for (std::ptrdiff_t size = 0; size <= range; ++size) {
    for (const std::ptrdiff_t lag : {size, -size}) {
      if (at_lag(lag).count < std::max(3.0, enough)) continue;
      const std::optional<double> r = at_lag(lag).correlation();
      if (!r || *r <= highest + kSame) continue;
      highest = *r;
      best = lag;
    }
  }
  if (!best) return std::nullopt;
  const auto lag = static_cast<double>(*best);
  if (std::abs(*best) == kMaxLag) return lag;
  const std::optional<double> before = at_lag(*best - 1).correlation();
  const std::optional<double> after = at_lag(*best + 1).correlation();
  if (!before || !after) return lag;
  const double curvature = *before - 2.0 * highest + *after;
  if (!(curvature < 0.0)) return lag;
  return lag + std::clamp(0.5 * (*before - *after) / curvature, -0.5, 0.5);
}

Linkage LinkageMeter::finish() const {
  Linkage linkage;
  if (path_m_ < kShortestStroke_m) return linkage;
  const Sums& same = at_lag(0);
  if (same.tracked_square > 0.0) linkage.gain = same.product / same.tracked_square;
  const double scale = std::sqrt(same.tracked_square * same.corrected_square);
  if (scale > 0.0) linkage.r = same.product / scale;
  const std::optional<double> frame_seconds = seconds_.quantile(0.5);
  if (!frame_seconds) return linkage;
  const std::optional<double> frames = find_lag_frames(*frame_seconds);
  if (frames) linkage.lag_ms = *frames * *frame_seconds * 1e3;
  return linkage;
}

}  // namespace nade
