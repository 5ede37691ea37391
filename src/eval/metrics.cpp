#include "nade/eval/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bend_meter.h"
#include "linkage_meter.h"
#include "motion_meter.h"
#include "nade/assert.h"
#include "nade/eval/quantile.h"
#include "pose_meter.h"
#include "print_meter.h"
#include "skin_probe.h"

namespace nade {
namespace {

/// Motion is not measured over a longer pause than this.
constexpr std::int64_t kLongestStep_ns = 200'000'000;

/// The hands of a frame, kept for the next.
struct PastFrame {
  std::int64_t time_ns = 0;
  Vec3 palm_tracked = Vec3::Zero();
  Vec3 palm_corrected = Vec3::Zero();
  bool palm_pressed = false;
};

bool is_pressed(const SkinReading& tracked, Part part) {
  return tracked.patch_lowest[index_of(part)] < -kPressing_m;
}

}  // namespace

struct MetricsMeter::Impl {
  Impl(const HandMesh& mesh, const MetricsOptions& options)
      : side(mesh.side),
        tracked_probe(mesh, options.hand_scale),
        corrected_probe(mesh, options.hand_scale),
        print(measure_skin(mesh)),
        pose(mesh, options.hand_scale) {}

  [[nodiscard]] double take_skin(const SkinReading& corrected);
  [[nodiscard]] std::optional<double> take_gaps(const SkinReading& tracked,
                                                const SkinReading& corrected, bool curling);
  void take_print(const PoseFrame& frame, const Object& object);
  void take_linkage(const PastFrame& now, const Object& object);
  void break_off();

  Handedness side;
  SkinProbe tracked_probe;
  SkinProbe corrected_probe;
  SurfaceHint palm_hint;
  std::optional<PastFrame> past;

  std::size_t frames = 0;
  std::size_t pressing_frames = 0;
  std::size_t touching_frames = 0;  ///< of the pressing ones
  QuantileSketch penetration_mm;
  QuantileSketch part_gap_mm;
  LinkageMeter linkage;
  MotionMeter motion;
  BendMeter bend;
  PrintMeter print;
  PoseMeter pose;
};

double MetricsMeter::Impl::take_skin(const SkinReading& corrected) {
  ++pressing_frames;
  const double deepest_mm = 1e3 * std::max(0.0, -corrected.lowest);
  penetration_mm.add(deepest_mm);
  if (corrected.touches) ++touching_frames;
  return deepest_mm;
}

std::optional<double> MetricsMeter::Impl::take_gaps(const SkinReading& tracked,
                                                    const SkinReading& corrected, bool curling) {
  std::optional<double> widest_mm;
  for (std::size_t i = 0; i < kPartCount; ++i) {
    // A palm that rises with the curl of the fingers is meant to.
    if (curling && part_at(i) == Part::palm) continue;
    if (!is_pressed(tracked, part_at(i))) continue;
    const double gap_mm = 1e3 * std::max(0.0, corrected.patch_lowest[i]);
    part_gap_mm.add(gap_mm);
    widest_mm = std::max(widest_mm.value_or(0.0), gap_mm);
  }
  return widest_mm;
}

void MetricsMeter::Impl::take_print(const PoseFrame& frame, const Object& object) {
  PrintFrame read;
  read.pressing = frame.pressing;
  read.corrected_m = corrected_probe.read_below(*frame.corrected, object, 0.0);
  if (frame.pressing) {
    read.tracked_m = tracked_probe.read_below(*frame.tracked, object, -kPressing_m);
    for (std::size_t i = 0; i < read.tracked_m.size(); ++i) {
      const bool pressed = read.tracked_m[i] < -kPressing_m;
      if (pressed && print.skin().is_palmar(i)) corrected_probe.complete(i, object);
    }
  }
  print.add(read);
}

void MetricsMeter::Impl::take_linkage(const PastFrame& now, const Object& object) {
  const bool goes_on = past && past->palm_pressed && now.palm_pressed;
  const auto surface = object.closest_point(now.palm_tracked, kNotMeasured, palm_hint);
  if (!goes_on || !surface) {
    linkage.break_off();
    return;
  }
  PalmStep step;
  step.seconds = 1e-9 * static_cast<double>(now.time_ns - past->time_ns);
  step.tracked_m = along_surface(now.palm_tracked - past->palm_tracked, surface->normal);
  step.corrected_m = along_surface(now.palm_corrected - past->palm_corrected, surface->normal);
  linkage.add(step);
}

void MetricsMeter::Impl::break_off() {
  past.reset();
  linkage.break_off();
  motion.break_off();
  bend.break_off();
  pose.break_off();
  tracked_probe.break_off();
  corrected_probe.break_off();
}

MetricsMeter::MetricsMeter(const HandMesh& mesh, const MetricsOptions& options)
    : impl_(std::make_unique<Impl>(mesh, options)) {}
MetricsMeter::MetricsMeter(MetricsMeter&&) noexcept = default;
MetricsMeter& MetricsMeter::operator=(MetricsMeter&&) noexcept = default;
MetricsMeter::~MetricsMeter() = default;

void MetricsMeter::add_gap() { impl_->break_off(); }

FrameReading MetricsMeter::add(std::int64_t time_ns, const HandPose& tracked,
                               const HandPose& corrected, const Object& object) {
  NADE_ASSERT(tracked.side == impl_->side && corrected.side == impl_->side);
  Impl& meter = *impl_;
  if (!is_usable(tracked) || !is_usable(corrected)) {
    add_gap();
    return {};
  }
  const bool goes_on = meter.past && time_ns > meter.past->time_ns &&
                       time_ns - meter.past->time_ns <= kLongestStep_ns;
  if (!goes_on) meter.break_off();
  ++meter.frames;
  FrameReading reading;
  const SkinReading tracked_skin = meter.tracked_probe.read(tracked, object);
  const SkinReading corrected_skin = meter.corrected_probe.read(corrected, object);
  const bool pressing = tracked_skin.lowest < -kPressing_m;
  const auto pop_m =
      meter.motion.add({1e-9 * static_cast<double>(time_ns), &tracked, &corrected, pressing});
  if (pop_m) reading.pop_mm = 1e3 * *pop_m;
  const PoseFrame pose{time_ns, &tracked, &corrected, tracked_skin.lowest, pressing};
  meter.pose.add(pose, object);
  meter.take_print(pose, object);
  const BendMeter::FrameResult bend =
      meter.bend.add(tracked, corrected, pressing ? Pressing::yes : Pressing::no);
  reading.bend_added_deg = bend.added_median_deg;
  if (pressing) {
    reading.penetration_mm = meter.take_skin(corrected_skin);
    reading.part_gap_mm = meter.take_gaps(tracked_skin, corrected_skin, bend.curling);
  }
  const PastFrame now{time_ns, tracked[Joint::palm].position, corrected[Joint::palm].position,
                      is_pressed(tracked_skin, Part::palm)};
  meter.take_linkage(now, object);
  meter.past = now;
  return reading;
}

void MetricsMeter::merge(const MetricsMeter& other) {
  const Impl& from = *other.impl_;
  impl_->frames += from.frames;
  impl_->pressing_frames += from.pressing_frames;
  impl_->touching_frames += from.touching_frames;
  impl_->penetration_mm.merge(from.penetration_mm);
  impl_->part_gap_mm.merge(from.part_gap_mm);
  impl_->linkage.merge(from.linkage);
  impl_->motion.merge(from.motion);
  impl_->bend.merge(from.bend);
  impl_->print.merge(from.print);
  impl_->pose.merge(from.pose);
  impl_->break_off();
}

Metrics MetricsMeter::finish() const {
  const Impl& meter = *impl_;
  Metrics metrics;
  metrics.frames = meter.frames;
  metrics.pressing_frames = meter.pressing_frames;
  metrics.part_samples = meter.part_gap_mm.count();
  metrics.penetration_max_mm = meter.penetration_mm.max();
  metrics.penetration_p99_mm = meter.penetration_mm.quantile(0.99);
  metrics.penetration_mean_mm = meter.penetration_mm.mean();
  if (meter.pressing_frames > 0) {
    metrics.contact_ratio =
        static_cast<double>(meter.touching_frames) / static_cast<double>(meter.pressing_frames);
  }
  metrics.part_gap_mean_mm = meter.part_gap_mm.mean();
  metrics.part_gap_p95_mm = meter.part_gap_mm.quantile(0.95);
  const Linkage linkage = meter.linkage.finish();
  metrics.linkage_gain = linkage.gain;
  metrics.linkage_r = linkage.r;
  metrics.linkage_lag_ms = linkage.lag_ms;
  const Motion motion = meter.motion.finish();
  metrics.amplification_p999 = motion.amplification_p999;
  metrics.amplification_max = motion.amplification_max;
  metrics.pop_max_mm = motion.pop_max_mm;
  metrics.jitter_ratio = motion.jitter_ratio;
  metrics.jolt_p999_mm = motion.jolt_p999_mm;
  metrics.tremble_mm = motion.tremble_mm;
  metrics.own_jolt_p999_mm = motion.own_jolt_p999_mm;
  metrics.own_tremble_mm = motion.own_tremble_mm;
  const Bend bend = meter.bend.finish();
  metrics.curling_frames = bend.curling_frames;
  metrics.bend_added_median_deg = bend.added_median_deg;
  metrics.bend_added_p95_deg = bend.added_p95_deg;
  metrics.limit_violation_max_deg = bend.limit_violation_max_deg;
  metrics.curl_kept = bend.curl_kept;
  const Print print = meter.print.finish();
  metrics.print_share = print.share;
  metrics.hover_mm = print.hover_mm;
  metrics.heel_share = print.heel_share;
  metrics.excess_max_mm = print.excess_max_mm;
  metrics.excess_mean_mm = print.excess_mean_mm;
  const PoseDifference pose = meter.pose.finish();
  metrics.along_p95_mm = pose.along_p95_mm;
  metrics.free_max_mm = pose.free_max_mm;
  metrics.turn_median_deg = pose.turn_median_deg;
  metrics.turn_p95_deg = pose.turn_p95_deg;
  metrics.thumb_open_max_deg = pose.thumb_open_max_deg;
  metrics.overlap_p99_mm = pose.overlap_p99_mm;
  return metrics;
}

}  // namespace nade
