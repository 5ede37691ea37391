#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "bend_meter.h"
#include "nade/eval/quantile.h"
#include "nade/hand.h"

namespace nade {

/// How much faster and rougher the corrected joints move than the tracked ones.
struct Motion {
  std::optional<double> amplification_p999;
  std::optional<double> amplification_max;
  std::optional<double> pop_max_mm;
  std::optional<double> jitter_ratio;
  std::optional<double> jolt_p999_mm;
  std::optional<double> tremble_mm;
  std::optional<double> own_jolt_p999_mm;  ///< of the tracked hand by itself
  std::optional<double> own_tremble_mm;
};

/// Compares how both hands move from frame to frame, over all 26 joints.
class MotionMeter {
 public:
  /// Gives how far the corrected hand popped in this step, metres; no value in the first frame.
  std::optional<double> add(std::int64_t time_ns, const HandPose& tracked,
                            const HandPose& corrected, Pressing pressing);
  /// The next hand does not go on from the last one.
  void break_off();
  void merge(const MotionMeter& other);
  [[nodiscard]] Motion finish() const;

 private:
  using Positions = std::array<Vec3, kJointCount>;
  struct Frame {
    std::int64_t time_ns = 0;
    Positions tracked;
    Positions corrected;
  };
  double take_step(const Frame& now, const Frame& before);
  void take_bend(const Frame& now, const Frame& before, const Frame& earlier, Pressing pressing);

  std::array<Frame, 2> past_{};  ///< the last frame, then the one before
  std::size_t known_ = 0;
  QuantileSketch amplification_;
  std::optional<double> pop_max_m_;
  double tracked_square_ = 0.0;  ///< of second differences, summed
  double corrected_square_ = 0.0;
  /// Of second differences as they would be at 90 Hz.
  struct Shaking {
    QuantileSketch jolt_mm;   ///< the joints' largest, each frame
    double square_mm2 = 0.0;  ///< summed over joints and pressing frames
    std::size_t samples = 0;  ///< that it is of
    void merge(const Shaking& other);
    [[nodiscard]] std::optional<double> tremble_mm() const;
  };
  Shaking added_;  ///< by the correction
  Shaking own_;    ///< of the tracked hand
};

}  // namespace nade
