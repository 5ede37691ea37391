#pragma once

#include <cstddef>
#include <optional>

#include "nade/eval/quantile.h"
#include "nade/skeleton.h"

namespace nade {

/// What a correction does to the joints' angles.
struct Bend {
  std::optional<double> added_median_deg;
  std::optional<double> added_p95_deg;
  std::optional<double> limit_violation_max_deg;
  std::optional<double> curl_kept;
  std::size_t curling_frames = 0;
};

/// Whether the tracked skin presses the object in a frame.
enum class Pressing : std::uint8_t { no, yes };

/// Compares the joint angles of both hands.
class BendMeter {
 public:
  struct FrameResult {
    bool curling = false;  ///< the person curls the fingers, beyond how they lay at first touch
    std::optional<double> added_median_deg;  ///< over the joints, while pressing
  };
  FrameResult add(const HandPose& tracked, const HandPose& corrected, Pressing pressing);
  /// The next hand does not go on from the last one.
  void break_off();
  void merge(const BendMeter& other);
  [[nodiscard]] Bend finish() const;

 private:
  /// Flexion of PIP plus DIP, the mean of the four fingers, radians.
  struct Curls {
    double tracked = 0.0;
    double corrected = 0.0;
  };
  double take_bend_added(const HandPose& tracked, const HandPose& corrected);
  void take_limits(const HandAngles& tracked, const HandAngles& corrected);
  bool take_curl(const Curls& now);

  QuantileSketch added_deg_;
  std::optional<double> violation_max_;
  std::optional<Curls> first_touch_;  ///< while pressing
  Curls curl_sum_;                    ///< beyond first touch, over curling frames
  std::size_t curling_frames_ = 0;
};

}  // namespace nade
