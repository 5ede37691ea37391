#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "nade/hand_mesh.h"
#include "nade/surface.h"

namespace nade {

/// How well a corrected hand does against its tracked one. The members bear the names of the
/// metrics; docs/metrics.md says what each means. No value where there was nothing to
/// measure (no pressing frame, no motion).
struct Metrics {
  std::size_t frames = 0;           ///< in which the hand was tracked
  std::size_t pressing_frames = 0;  ///< tracked skin more than 2 mm deep anywhere
  std::size_t part_samples = 0;     ///< parts pressed, over all frames
  std::size_t curling_frames = 0;   ///< the person curls 15 degrees more than at first touch

  std::optional<double> penetration_max_mm;
  std::optional<double> penetration_p99_mm;
  std::optional<double> penetration_mean_mm;
  std::optional<double> contact_ratio;
  std::optional<double> part_gap_mean_mm;
  std::optional<double> part_gap_p95_mm;
  std::optional<double> linkage_gain;
  std::optional<double> linkage_r;
  std::optional<double> linkage_lag_ms;  ///< positive: the corrected hand comes later
  std::optional<double> amplification_p999;
  std::optional<double> amplification_max;
  std::optional<double> pop_max_mm;
  std::optional<double> jitter_ratio;
  std::optional<double> bend_added_median_deg;
  std::optional<double> bend_added_p95_deg;
  std::optional<double> limit_violation_max_deg;
  std::optional<double> curl_kept;

  // What the eye sees.
  std::optional<double> print_share;
  std::optional<double> hover_mm;
  std::optional<double> heel_share;
  std::optional<double> excess_max_mm;
  std::optional<double> excess_mean_mm;
  std::optional<double> along_p95_mm;
  std::optional<double> free_max_mm;
  std::optional<double> turn_median_deg;
  std::optional<double> turn_p95_deg;
  std::optional<double> thumb_open_max_deg;
  std::optional<double> overlap_p99_mm;
  std::optional<double> jolt_p999_mm;
  std::optional<double> tremble_mm;
  std::optional<double> own_jolt_p999_mm;
  std::optional<double> own_tremble_mm;
};

/// Between what a value has to lie; no bounds: anywhere.
struct MetricBounds {
  std::optional<double> at_least;
  std::optional<double> at_most;
  [[nodiscard]] bool any() const { return at_least || at_most; }
};

/// What a target's bounds are counted from.
enum class TargetOrigin : std::uint8_t {
  zero,
  tracked,  ///< what the tracked hand does by itself
  paper,    ///< what the paper's method makes of the same hand
};

/// What a metric has to reach, and in how many cases.
struct MetricTarget {
  MetricBounds bounds;
  std::optional<double> share;  ///< of the cases, 0 to 1; where so much is asked
  TargetOrigin from = TargetOrigin::zero;
  /// Of `TargetOrigin::tracked`: the bounds lie above so many times this metric.
  std::optional<double> Metrics::*own = nullptr;
  double own_times = 1.0;
};

/// One metric, for tables and files.
struct MetricInfo {
  const char* key;   ///< the member's name
  const char* unit;  ///< "mm", "deg", "ms", or "" for a plain number
  std::optional<double> Metrics::*value;
  MetricTarget target;
};

/// Every metric, in the order in which they are reported.
[[nodiscard]] std::span<const MetricInfo> metric_table();

/// A target's bounds in one recording, of which `metrics` are the method's and `paper` the paper's
/// method's value of the same metric. None where what they are counted from is not known.
[[nodiscard]] MetricBounds bounds_in(const MetricTarget& target, const Metrics& metrics,
                                     std::optional<double> paper = std::nullopt);

/// Whether a value lies within bounds; no value where there are none.
[[nodiscard]] std::optional<bool> meets(const MetricBounds& bounds, double value);

/// "at least 0.99", "0.93 to 1.07", "at most 3 + own", "at least the paper's"; empty without one.
[[nodiscard]] std::string words_of(const MetricTarget& target);

struct MetricsOptions {
  /// The recording's length from wrist to middle knuckle over the mesh's: one number for a whole
  /// recording, the median of `hand_scale`. > 0.
  double hand_scale = 1.0;
};

/// What one frame alone shows, for a display that follows a hand. No value where there was nothing
/// to measure.
struct FrameReading {
  std::optional<double> penetration_mm;  ///< of the deepest corrected skin, while pressing
  std::optional<double> part_gap_mm;     ///< the widest, of the parts pressed
  std::optional<double> bend_added_deg;  ///< median over the finger joints, while pressing
  std::optional<double> pop_mm;
};

/// Measures one hand of a recording, a frame at a time, in memory that does not grow.
class MetricsMeter {
 public:
  /// `mesh` is the drawn hand, of the side that is measured; it must outlive the meter.
  explicit MetricsMeter(const HandMesh& mesh, const MetricsOptions& options = {});
  MetricsMeter(MetricsMeter&&) noexcept;
  MetricsMeter& operator=(MetricsMeter&&) noexcept;
  ~MetricsMeter();

  /// The hand in the next frame, as tracked and as corrected; times increase. A pose that is not
  /// `is_usable` counts as `add_gap`, and so does a pause of more than 200 ms before this frame.
  /// The object may move between frames.
  FrameReading add(std::int64_t time_ns, const HandPose& tracked, const HandPose& corrected,
                   const Object& object);

  /// The next frame has no such hand: no motion is measured across it.
  void add_gap();

  /// Takes in what another meter saw, as for the report over both hands. Only results are
  /// merged: neither's next frame goes on from the other's last.
  void merge(const MetricsMeter& other);

  [[nodiscard]] Metrics finish() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nade
