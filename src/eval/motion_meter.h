#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

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
  std::optional<double> own_jolt_p999_mm;
  std::optional<double> own_tremble_mm;
};

/// Both hands in a frame.
struct MotionFrame {
  double seconds = 0.0;  ///< since any fixed time
  const HandPose* tracked = nullptr;
  const HandPose* corrected = nullptr;
  bool pressing = false;  ///< the tracked hand, the object
};

/// Compares how both hands move from frame to frame, over all 26 joints.
class MotionMeter {
 public:
  /// Gives how far the corrected hand popped in this step, metres; no value in the first frame.
  std::optional<double> add(const MotionFrame& frame);
  /// The next hand does not go on from the last one.
  void break_off();
  void merge(const MotionMeter& other);
  [[nodiscard]] Motion finish() const;

 private:
  using Positions = std::array<Vec3, kJointCount>;
  struct Frame {
    double seconds;
    bool pressing;
    Positions tracked;
    Positions corrected;
  };
  double take_step(const Frame& now, const Frame& before);
  /// Second differences, of frames at 90 Hz.
  class Jolts {
   public:
    void add(const Positions& bend_m, double scale, bool pressing);
    void merge(const Jolts& other);
    [[nodiscard]] std::optional<double> jolt_p999_mm() const { return most_mm_.quantile(0.999); }
    [[nodiscard]] std::optional<double> tremble_mm() const;

   private:
    QuantileSketch most_mm_;  ///< over the joints of a frame
    double square_m2_ = 0.0;  ///< summed over joints and pressing frames
    double count_ = 0.0;
  };
  void take_bend(const Frame& now, const Frame& before, const Frame& earlier);

  std::array<Frame, 2> past_{};  ///< the last frame, then the one before
  std::size_t known_ = 0;
  QuantileSketch amplification_;
  std::optional<double> pop_max_m_;
  double tracked_square_ = 0.0;  ///< of second differences, summed
  double corrected_square_ = 0.0;
  Jolts added_;  ///< of the drawn hand less the tracked one
  Jolts own_;    ///< of the tracked hand
};

}  // namespace nade
