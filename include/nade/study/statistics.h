#pragma once

#include <span>
#include <vector>

namespace nade::study {

/// The quantile at `share` (0 to 1), linear between order statistics: R's type 7, its default.
/// `values` in any order, not empty.
[[nodiscard]] double quantile(std::span<const double> values, double share);

/// What a box and its whiskers show.
struct BoxSummary {
  double median = 0.0;
  double lower_quartile = 0.0;
  double upper_quartile = 0.0;
  /// The farthest values within one and a half box lengths of the box.
  double lower_whisker = 0.0;
  double upper_whisker = 0.0;
};

/// `values` in any order, not empty.
[[nodiscard]] BoxSummary box_summary(std::span<const double> values);

/// p-values adjusted for how many there are, in the order given; they hold the family-wise error.
[[nodiscard]] std::vector<double> holm(std::span<const double> p_values);

}  // namespace nade::study
