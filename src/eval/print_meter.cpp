#include "print_meter.h"

#include <algorithm>
#include <utility>

namespace nade {
namespace {

/// Skin this near to where it may lie is part of the handprint.
constexpr double kPrint_m = 0.0015;
/// Less pressed skin than this leaves no print to judge.
constexpr double kSmallestPrint = 10e-4;
constexpr double kHeelPressed = 0.5;

/// Of the pressed skin.
struct Areas {
  double pressed_m2 = 0.0;
  double touching_m2 = 0.0;

  void add(double area_m2, double off_m) {
    pressed_m2 += area_m2;
    if (off_m < kPrint_m) touching_m2 += area_m2;
  }
};

/// How far skin is from where it may lie: on the surface, or in it as deep as its flesh gives.
/// Deeper skin would draw no print either: what is seen there is the object.
double off_by(double corrected_m, double flesh_depth_m) {
  return std::max({0.0, corrected_m, -corrected_m - flesh_depth_m});
}

}  // namespace

PrintMeter::PrintMeter(SkinMap skin) : skin_(std::move(skin)) {
  for (std::size_t i = 0; i < skin_.region.size(); ++i) {
    if (skin_.region[i] == SkinRegion::heel) heel_m2_ += skin_.area_m2[i];
  }
}

void PrintMeter::add(const PrintFrame& frame) {
  double excess_m = 0.0;
  for (std::size_t i = 0; i < frame.corrected_m.size(); ++i) {
    excess_m = std::max(excess_m, -frame.corrected_m[i] - skin_.flesh_depth_m[i]);
  }
  excess_max_mm_ = std::max(excess_max_mm_.value_or(0.0), 1e3 * excess_m);
  if (!frame.pressing) return;
  excess_mm_.add(1e3 * excess_m);
  take_print(frame);
}

void PrintMeter::take_print(const PrintFrame& frame) {
  Areas palmar;
  Areas heel;
  double off_m3 = 0.0;
  for (std::size_t i = 0; i < frame.tracked_m.size(); ++i) {
    if (!skin_.is_palmar(i) || frame.tracked_m[i] >= -kPressing_m) continue;
    const double off_m = off_by(frame.corrected_m[i], skin_.flesh_depth_m[i]);
    palmar.add(skin_.area_m2[i], off_m);
    off_m3 += skin_.area_m2[i] * off_m;
    if (skin_.region[i] == SkinRegion::heel) heel.add(skin_.area_m2[i], off_m);
  }
  if (palmar.pressed_m2 >= kSmallestPrint) {
    share_.add(palmar.touching_m2 / palmar.pressed_m2);
    hover_mm_.add(1e3 * off_m3 / palmar.pressed_m2);
  }
  if (heel.pressed_m2 > 0.0 && heel.pressed_m2 >= kHeelPressed * heel_m2_) {
    heel_share_.add(heel.touching_m2 / heel.pressed_m2);
  }
}

void PrintMeter::merge(const PrintMeter& other) {
  share_.merge(other.share_);
  hover_mm_.merge(other.hover_mm_);
  heel_share_.merge(other.heel_share_);
  excess_mm_.merge(other.excess_mm_);
  if (other.excess_max_mm_) {
    excess_max_mm_ = std::max(excess_max_mm_.value_or(0.0), *other.excess_max_mm_);
  }
}

Print PrintMeter::finish() const {
  return {share_.mean(), hover_mm_.mean(), heel_share_.mean(), excess_max_mm_, excess_mm_.mean()};
}

}  // namespace nade
