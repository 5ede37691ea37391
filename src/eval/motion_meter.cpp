#include "motion_meter.h"

#include <algorithm>
#include <cmath>

namespace nade {
namespace {

/// Slower hands than this in a frame tell nothing of amplification.
constexpr double kSlowest_m = 0.0002;
/// A corrected joint may move this much faster before it counts as a pop.
constexpr double kPopFactor = 3.0;

}  // namespace

std::optional<double> MotionMeter::add(const HandPose& tracked, const HandPose& corrected) {
  Frame now;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    now.tracked[i] = tracked.joints[i].position;
    now.corrected[i] = corrected.joints[i].position;
  }
  std::optional<double> pop_m;
  if (known_ >= 1) pop_m = take_step(now, past_[0]);
  if (known_ >= 2) take_bend(now, past_[0], past_[1]);
  past_[1] = past_[0];
  past_[0] = now;
  known_ = std::min<std::size_t>(known_ + 1, 2);
  return pop_m;
}

double MotionMeter::take_step(const Frame& now, const Frame& before) {
  double tracked_m = 0.0;
  double corrected_m = 0.0;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    tracked_m = std::max(tracked_m, (now.tracked[i] - before.tracked[i]).norm());
    corrected_m = std::max(corrected_m, (now.corrected[i] - before.corrected[i]).norm());
  }
  if (tracked_m >= kSlowest_m) amplification_.add(corrected_m / tracked_m);
  const double pop_m = std::max(0.0, corrected_m - kPopFactor * tracked_m);
  pop_max_m_ = std::max(pop_max_m_.value_or(0.0), pop_m);
  return pop_m;
}

void MotionMeter::take_bend(const Frame& now, const Frame& before, const Frame& earlier) {
  for (std::size_t i = 0; i < kJointCount; ++i) {
    tracked_square_ +=
        (now.tracked[i] - 2.0 * before.tracked[i] + earlier.tracked[i]).squaredNorm();
    corrected_square_ +=
        (now.corrected[i] - 2.0 * before.corrected[i] + earlier.corrected[i]).squaredNorm();
  }
}

void MotionMeter::break_off() { known_ = 0; }

void MotionMeter::merge(const MotionMeter& other) {
  amplification_.merge(other.amplification_);
  if (other.pop_max_m_) pop_max_m_ = std::max(pop_max_m_.value_or(0.0), *other.pop_max_m_);
  tracked_square_ += other.tracked_square_;
  corrected_square_ += other.corrected_square_;
  break_off();
}

Motion MotionMeter::finish() const {
  Motion motion;
  motion.amplification_p999 = amplification_.quantile(0.999);
  motion.amplification_max = amplification_.max();
  if (pop_max_m_) motion.pop_max_mm = 1e3 * *pop_max_m_;
  if (tracked_square_ > 0.0) motion.jitter_ratio = std::sqrt(corrected_square_ / tracked_square_);
  return motion;
}

}  // namespace nade
