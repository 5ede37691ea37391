#include "motion_meter.h"

#include <algorithm>
#include <cmath>

namespace nade {
namespace {

/// A hand that goes less far in a frame counts as if it went so far.
constexpr double kLeastWay_m = 0.0002;
/// The rate at which second differences are compared.
constexpr double kFrame_s = 1.0 / 90.0;
/// A corrected joint may move this much faster before it counts as a pop.
constexpr double kPopFactor = 3.0;

}  // namespace

std::optional<double> MotionMeter::add(std::int64_t time_ns, const HandPose& tracked,
                                       const HandPose& corrected, Pressing pressing) {
  Frame now;
  now.time_ns = time_ns;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    now.tracked[i] = tracked.joints[i].position;
    now.corrected[i] = corrected.joints[i].position;
  }
  std::optional<double> pop_m;
  if (known_ >= 1) pop_m = take_step(now, past_[0]);
  if (known_ >= 2) take_bend(now, past_[0], past_[1], pressing);
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
  amplification_.add(corrected_m / std::max(tracked_m, kLeastWay_m));
  const double pop_m = std::max(0.0, corrected_m - kPopFactor * tracked_m);
  pop_max_m_ = std::max(pop_max_m_.value_or(0.0), pop_m);
  return pop_m;
}

void MotionMeter::take_bend(const Frame& now, const Frame& before, const Frame& earlier,
                            Pressing pressing) {
  const double frame_s = 0.5e-9 * static_cast<double>(now.time_ns - earlier.time_ns);
  const double to_90_hz = 1e3 * (kFrame_s / frame_s) * (kFrame_s / frame_s);
  double added_most_mm = 0.0;
  double own_most_mm = 0.0;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Vec3 tracked = now.tracked[i] - 2.0 * before.tracked[i] + earlier.tracked[i];
    const Vec3 corrected = now.corrected[i] - 2.0 * before.corrected[i] + earlier.corrected[i];
    tracked_square_ += tracked.squaredNorm();
    corrected_square_ += corrected.squaredNorm();
    const double added_mm = to_90_hz * (corrected - tracked).norm();
    const double own_mm = to_90_hz * tracked.norm();
    added_most_mm = std::max(added_most_mm, added_mm);
    own_most_mm = std::max(own_most_mm, own_mm);
    if (pressing == Pressing::no) continue;
    added_.square_mm2 += added_mm * added_mm;
    own_.square_mm2 += own_mm * own_mm;
    ++added_.samples;
    ++own_.samples;
  }
  added_.jolt_mm.add(added_most_mm);
  own_.jolt_mm.add(own_most_mm);
}

void MotionMeter::Shaking::merge(const Shaking& other) {
  jolt_mm.merge(other.jolt_mm);
  square_mm2 += other.square_mm2;
  samples += other.samples;
}

std::optional<double> MotionMeter::Shaking::tremble_mm() const {
  if (samples == 0) return std::nullopt;
  return std::sqrt(square_mm2 / static_cast<double>(samples));
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
  motion.jolt_p999_mm = added_.jolt_mm.quantile(0.999);
  motion.tremble_mm = added_.tremble_mm();
  motion.own_jolt_p999_mm = own_.jolt_mm.quantile(0.999);
  motion.own_tremble_mm = own_.tremble_mm();
  return motion;
}

}  // namespace nade
