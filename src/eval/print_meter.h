#pragma once

#include <optional>
#include <span>
#include <vector>

#include "nade/eval/quantile.h"
#include "nade/skin.h"
#include "skin_probe.h"

namespace nade {

/// How the skin that is pressed lies on the object.
struct Print {
  std::optional<double> share;
  std::optional<double> hover_mm;
  std::optional<double> heel_share;
  std::optional<double> excess_max_mm;
  std::optional<double> excess_mean_mm;
};

/// A hand's skin in a frame: signed distances by vertex, at least those of skin that may lie in
/// the object.
struct PrintFrame {
  std::span<const double> tracked_m;
  std::span<const double> corrected_m;  ///< and of all palmar skin whose tracked is pressed
  bool pressing = false;                ///< the tracked hand, anywhere
};

/// Gathers the handprint, and how far the flesh is pushed in beyond its depth.
class PrintMeter {
 public:
  explicit PrintMeter(SkinMap skin);
  [[nodiscard]] const SkinMap& skin() const { return skin_; }
  void add(const PrintFrame& frame);
  void merge(const PrintMeter& other);
  [[nodiscard]] Print finish() const;

 private:
  void take_print(const PrintFrame& frame);

  SkinMap skin_;
  double heel_m2_ = 0.0;  ///< of all the heel's skin
  QuantileSketch share_;
  QuantileSketch hover_mm_;
  QuantileSketch heel_share_;
  QuantileSketch excess_mm_;  ///< over pressing frames
  std::optional<double> excess_max_mm_;
};

}  // namespace nade
