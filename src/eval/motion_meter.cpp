#include "motion_meter.h"

#include <algorithm>
#include <cmath>

namespace nade {
namespace {

/// A tracked hand that moves less in a frame counts as if it moved so far.
constexpr double kSlowest_m = 0.0002;
/// A corrected joint may move this much faster before it counts as a pop.
constexpr double kPopFactor = 3.0;
/// The rate at which second differences are told: they grow with the square of the time between
/// frames.
constexpr double kComparedRate = 90.0;

}  // namespace

std::optional<double> MotionMeter::add(const MotionFrame& frame) {
  Frame now{frame.seconds, frame.pressing, {}, {}};
  for (std::size_t i = 0; i < kJointCount; ++i) {
    now.tracked[i] = frame.tracked->joints[i].position;
    now.corrected[i] = frame.corrected->joints[i].position;
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
  amplification_.add(corrected_m / std::max(tracked_m, kSlowest_m));
  const double pop_m = std::max(0.0, corrected_m - kPopFactor * tracked_m);
  pop_max_m_ = std::max(pop_max_m_.value_or(0.0), pop_m);
  return pop_m;
}

void MotionMeter::take_bend(const Frame& now, const Frame& before, const Frame& earlier) {
  Positions added;
  Positions own;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    own[i] = now.tracked[i] - 2.0 * before.tracked[i] + earlier.tracked[i];
    const Vec3 drawn = now.corrected[i] - 2.0 * before.corrected[i] + earlier.corrected[i];
    added[i] = drawn - own[i];
    tracked_square_ += own[i].squaredNorm();
    corrected_square_ += drawn.squaredNorm();
  }
  const double step_s = 0.5 * (now.seconds - earlier.seconds);
  const double scale = 1.0 / (kComparedRate * kComparedRate * step_s * step_s);
  added_.add(added, scale, now.pressing);
  own_.add(own, scale, now.pressing);
}

void MotionMeter::Jolts::add(const Positions& bend_m, double scale, bool pressing) {
  double most_m = 0.0;
  for (const Vec3& bend : bend_m) {
    most_m = std::max(most_m, scale * bend.norm());
    if (pressing) square_m2_ += scale * scale * bend.squaredNorm();
  }
  most_mm_.add(1e3 * most_m);
  if (pressing) count_ += static_cast<double>(kJointCount);
}

void MotionMeter::Jolts::merge(const Jolts& other) {
  most_mm_.merge(other.most_mm_);
  square_m2_ += other.square_m2_;
  count_ += other.count_;
}

std::optional<double> MotionMeter::Jolts::tremble_mm() const {
  if (count_ == 0.0) return std::nullopt;
  return 1e3 * std::sqrt(square_m2_ / count_);
}

void MotionMeter::break_off() { known_ = 0; }

void MotionMeter::merge(const MotionMeter& other) {
  amplification_.merge(other.amplification_);
  if (other.pop_max_m_) pop_max_m_ = std::max(pop_max_m_.value_or(0.0), *other.pop_max_m_);
  tracked_square_ += other.tracked_square_;
  corrected_square_ += other.corrected_square_;
  added_.merge(other.added_);
  own_.merge(other.own_);
  break_off();
}

Motion MotionMeter::finish() const {
  Motion motion;
  motion.amplification_p999 = amplification_.quantile(0.999);
  motion.amplification_max = amplification_.max();
  if (pop_max_m_) motion.pop_max_mm = 1e3 * *pop_max_m_;
  if (tracked_square_ > 0.0) motion.jitter_ratio = std::sqrt(corrected_square_ / tracked_square_);
  motion.jolt_p999_mm = added_.jolt_p999_mm();
  motion.tremble_mm = added_.tremble_mm();
  motion.own_jolt_p999_mm = own_.jolt_p999_mm();
  motion.own_tremble_mm = own_.tremble_mm();
  return motion;
}

}  // namespace nade
