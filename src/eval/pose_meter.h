#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "nade/eval/quantile.h"
#include "nade/hand_mesh.h"
#include "nade/surface.h"

namespace nade {

/// How far the drawn hand is from the tracked one, and how its digits lie to each other.
struct PoseDifference {
  std::optional<double> along_p95_mm;
  std::optional<double> free_max_mm;
  std::optional<double> turn_median_deg;
  std::optional<double> turn_p95_deg;
  std::optional<double> thumb_open_max_deg;
  std::optional<double> overlap_p99_mm;
};

/// One hand in a frame.
struct PoseFrame {
  std::int64_t time_ns = 0;
  const HandPose* tracked = nullptr;
  const HandPose* corrected = nullptr;
  double lowest_tracked_m = 0.0;  ///< signed distance of its deepest skin, or a lower bound
  bool pressing = false;
};

class PoseMeter {
 public:
  PoseMeter(const HandMesh& mesh, double hand_scale);
  void add(const PoseFrame& frame, const Object& object);
  /// The next hand does not go on from the last one.
  void break_off() { free_since_ns_.reset(); }
  void merge(const PoseMeter& other);
  [[nodiscard]] PoseDifference finish() const;

 private:
  void take_pressed(const PoseFrame& frame, const Object& object);
  void take_free(const PoseFrame& frame);
  void take_thumb(const PoseFrame& frame);
  [[nodiscard]] double overlap_m(const HandPose& hand) const;

  /// Of the phalanx that ends at each joint: from the bone's middle to the nearest skin, metres of
  /// the tracked hand; 0 where none ends.
  std::array<double, kJointCount> radius_m_{};
  SurfaceHint hint_;
  std::optional<std::int64_t> free_since_ns_;
  QuantileSketch along_mm_;
  QuantileSketch turn_deg_;
  QuantileSketch overlap_mm_;
  std::optional<double> free_max_mm_;
  std::optional<double> thumb_open_max_deg_;
};

}  // namespace nade
