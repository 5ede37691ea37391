#pragma once

#include <array>
#include <optional>

#include "nade/eval/quantile.h"
#include "nade/hand_mesh.h"

namespace nade {

/// How digits lie to each other.
struct DigitsApart {
  std::optional<double> thumb_open_max_deg;
  std::optional<double> overlap_p99_mm;
};

/// The angle between the thumb's and the index's metacarpal in the palm's plane, radians.
[[nodiscard]] double thumb_opening(const HandPose& hand) noexcept;

/// Compares how the digits of both hands lie to each other.
class DigitMeter {
 public:
  /// Phalanges are capsules as thick as the skin is near to their middle in the bind pose.
  DigitMeter(const HandMesh& mesh, double scale);

  void add(const HandPose& tracked, const HandPose& corrected);
  void merge(const DigitMeter& other);
  [[nodiscard]] DigitsApart finish() const;

 private:
  static constexpr std::size_t kPhalanges = 14;
  struct Phalanx {
    Digit digit = Digit::thumb;
    std::size_t joint = 0;  ///< the next joint ends it
    double radius_m = 0.0;
  };
  /// Of capsules of two digits, the deepest, at least 0.
  [[nodiscard]] double overlap_m(const HandPose& hand) const;

  std::array<Phalanx, kPhalanges> phalanges_{};
  std::optional<double> thumb_open_max_;
  QuantileSketch overlap_mm_;
};

}  // namespace nade
