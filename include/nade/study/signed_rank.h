#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace nade::study {

/// What becomes of pairs without a difference.
enum class ZeroDifferences {
  dropped,  ///< left out before ranking, as Wilcoxon has it and R's wilcox.test does
  pratt,    ///< ranked with the others, their ranks then left out, as Pratt has it
};

/// Wilcoxon's signed-rank test of paired answers, two-sided.
struct SignedRankTest {
  std::size_t pairs = 0;  ///< all of them
  std::size_t zeros = 0;  ///< of these, without a difference
  double w_plus = 0.0;    ///< sum of the ranks of the positive differences, midranks under ties
  double w_minus = 0.0;
  /// From the permutation distribution of these very ranks, ties and all; 1 where every difference
  /// is 0. No value beyond `kExactPairs` differences.
  std::optional<double> p_exact;
  /// Normal approximation with R's continuity correction, and without. No value where every
  /// difference is 0.
  std::optional<double> p_corrected;
  std::optional<double> p_normal;
  /// Matched-pairs rank-biserial correlation (W+ - W-) / (W+ + W-), -1 to 1; 0 where every
  /// difference is 0.
  double rank_biserial = 0.0;
};

/// Up to so many differences the exact distribution is worked out.
inline constexpr std::size_t kExactPairs = 500;

/// `differences` are finite; equal ones are ties only if they are exactly equal.
[[nodiscard]] SignedRankTest signed_rank(std::span<const double> differences,
                                         ZeroDifferences zeros);

struct BootstrapOptions {
  std::size_t resamples = 10'000;  ///< > 0
  std::uint64_t seed = 1;
  double confidence = 0.95;  ///< above 0, below 1
};

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// Percentile bootstrap interval of the rank-biserial correlation (zeros dropped): whole pairs are
/// drawn anew with replacement. The same on every machine. No value without differences.
[[nodiscard]] std::optional<Interval> rank_biserial_interval(std::span<const double> differences,
                                                             const BootstrapOptions& options = {});

}  // namespace nade::study
