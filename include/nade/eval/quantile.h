#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace nade {

/// Quantiles of a stream of any length in bounded memory: exact up to `kExactCount` values, after
/// that within 0.1 % of the exact one. Count, mean, least and greatest are always exact.
// A histogram of buckets of equal ratio.
// Based on: Masson, Rim, Lee. DDSketch: A Fast and Fully-Mergeable Quantile Sketch with
// Relative-Error Guarantees. 2019.
class QuantileSketch {
 public:
  static constexpr std::size_t kExactCount = 4096;
  static constexpr double kRelativeError = 1e-3;

  /// `value` >= 0; below 1e-6 counts as 0 once the sketch is no longer exact. Negative values and
  /// values that are not finite are left out.
  void add(double value);

  /// As if everything given to `other` had been given to this one.
  void merge(const QuantileSketch& other);

  [[nodiscard]] std::size_t count() const { return count_; }
  /// No value where nothing was added, here and below.
  [[nodiscard]] std::optional<double> max() const;
  [[nodiscard]] std::optional<double> mean() const;
  /// The smallest value that at least a share `q` (0 to 1) of all values does not exceed.
  [[nodiscard]] std::optional<double> quantile(double q) const;

 private:
  void add_to_buckets(double value);

  std::size_t count_ = 0;
  double sum_ = 0.0;
  double min_ = 0.0;
  double max_ = 0.0;
  std::vector<double> exact_;  ///< all values, until there are too many
  std::vector<std::uint64_t> buckets_;
};

}  // namespace nade
