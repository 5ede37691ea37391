#include "nade/study/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "nade/assert.h"

// Based on: Hyndman, Fan. Sample Quantiles in Statistical Packages. 1996.
// Based on: Tukey. Exploratory Data Analysis. 1977.
// Based on: Holm. A Simple Sequentially Rejective Multiple Test Procedure. 1979.

namespace nade::study {

double quantile(std::span<const double> values, double share) {
  NADE_ASSERT(!values.empty());
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - std::floor(place)) * (sorted[above] - sorted[below]);
}

BoxSummary box_summary(std::span<const double> values) {
  BoxSummary box{quantile(values, 0.5), quantile(values, 0.25), quantile(values, 0.75), 0.0, 0.0};
  const double reach = 1.5 * (box.upper_quartile - box.lower_quartile);
  box.lower_whisker = box.lower_quartile;
  box.upper_whisker = box.upper_quartile;
  for (const double value : values) {
    if (value >= box.lower_quartile - reach) box.lower_whisker = std::min(box.lower_whisker, value);
    if (value <= box.upper_quartile + reach) box.upper_whisker = std::max(box.upper_whisker, value);
  }
  return box;
}

std::vector<double> holm(std::span<const double> p_values) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });
  std::vector<double> adjusted(p_values.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto left = static_cast<double>(order.size() - i);
    largest = std::max(largest, std::min(1.0, left * p_values[order[i]]));
    adjusted[order[i]] = largest;
  }
  return adjusted;
}

}  // namespace nade::study
