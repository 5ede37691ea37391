#include "nade/study/signed_rank.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "nade/assert.h"
#include "nade/study/statistics.h"

// Based on: Wilcoxon. Individual Comparisons by Ranking Methods. 1945.
// Based on: Pratt. Remarks on Zeros and Ties in the Wilcoxon Signed Rank Procedures. 1959.
// Based on: Streitberg, Roehmel. Exact Distributions for Permutation and Rank Tests. 1986.
// Based on: Kerby. The Simple Difference Formula. 2014.
// Based on: Efron, Tibshirani. An Introduction to the Bootstrap. 1993.

namespace nade::study {
namespace {

/// Midranks are halves of whole numbers, so twice a rank is kept.
struct SignedRanks {
  std::vector<std::size_t> twice;  ///< of the differences that are not 0
  std::size_t twice_plus = 0;      ///< sum over the positive ones
  std::size_t twice_all = 0;
  std::size_t zeros = 0;
  double tie_excess = 0.0;  ///< sum of t^3 - t over the groups of t tied differences, zeros aside
};

SignedRanks signed_ranks(std::span<const double> differences, ZeroDifferences treatment) {
  std::vector<double> sorted(differences.begin(), differences.end());
  std::sort(sorted.begin(), sorted.end(),
            [](double a, double b) { return std::abs(a) < std::abs(b); });
  SignedRanks ranks;
  while (ranks.zeros < sorted.size() && sorted[ranks.zeros] == 0.0) ++ranks.zeros;
  const std::size_t ranked_before = treatment == ZeroDifferences::pratt ? ranks.zeros : 0;
  const std::size_t left_out = ranks.zeros - ranked_before;
  for (std::size_t from = ranks.zeros; from < sorted.size();) {
    std::size_t to = from;
    while (to < sorted.size() && std::abs(sorted[to]) == std::abs(sorted[from])) ++to;
    // Ranks from + 1 to `to`, less what was left out: twice their mean is first plus last.
    const std::size_t twice = from + 1 + to - 2 * left_out;
    for (std::size_t i = from; i < to; ++i) {
      ranks.twice.push_back(twice);
      ranks.twice_all += twice;
      if (sorted[i] > 0.0) ranks.twice_plus += twice;
    }
    const auto tied = static_cast<double>(to - from);
    ranks.tie_excess += tied * tied * tied - tied;
    from = to;
  }
  return ranks;
}

/// Every sign is + or - with the same chance: adds the ranks one by one to the distribution of
/// their sum.
double exact_p(const SignedRanks& ranks) {
  std::vector<double> chance(ranks.twice_all + 1, 0.0);
  chance[0] = 1.0;
  std::size_t reached = 0;
  for (const std::size_t rank : ranks.twice) {
    reached += rank;
    for (std::size_t sum = reached + 1; sum-- > 0;) {
      chance[sum] = 0.5 * (chance[sum] + (sum >= rank ? chance[sum - rank] : 0.0));
    }
  }
  const std::size_t nearer_end = std::min(ranks.twice_plus, ranks.twice_all - ranks.twice_plus);
  const double tail = std::accumulate(
      chance.begin(), chance.begin() + static_cast<std::ptrdiff_t>(nearer_end + 1), 0.0);
  return std::min(1.0, 2.0 * tail);
}

/// Variance of W+, less what ties and Pratt's zeros take away.
double variance(const SignedRanks& ranks, ZeroDifferences treatment) {
  const auto squares = [](double n) { return n * (n + 1.0) * (2.0 * n + 1.0); };
  const auto zeros = static_cast<double>(ranks.zeros);
  const auto used = static_cast<double>(ranks.twice.size());
  const double full =
      treatment == ZeroDifferences::pratt ? squares(used + zeros) - squares(zeros) : squares(used);
  return full / 24.0 - ranks.tie_excess / 48.0;
}

double two_sided_p(double z) { return std::erfc(std::abs(z) / std::numbers::sqrt2); }

double rank_biserial(const SignedRanks& ranks) {
  if (ranks.twice_all == 0) return 0.0;
  const auto all = static_cast<double>(ranks.twice_all);
  return (2.0 * static_cast<double>(ranks.twice_plus) - all) / all;
}

/// A number below `count`, the same on every machine, which the library's own do not promise.
std::size_t draw(std::mt19937_64& random, std::size_t count) {
  return static_cast<std::size_t>((random() >> 32U) * count >> 32U);
}

}  // namespace

SignedRankTest signed_rank(std::span<const double> differences, ZeroDifferences zeros) {
  const SignedRanks ranks = signed_ranks(differences, zeros);
  SignedRankTest test;
  test.pairs = differences.size();
  test.zeros = ranks.zeros;
  test.w_plus = 0.5 * static_cast<double>(ranks.twice_plus);
  test.w_minus = 0.5 * static_cast<double>(ranks.twice_all - ranks.twice_plus);
  test.rank_biserial = rank_biserial(ranks);
  if (ranks.twice.size() <= kExactPairs) test.p_exact = exact_p(ranks);
  if (ranks.twice.empty()) return test;
  const double deviation = std::sqrt(variance(ranks, zeros));
  const double excess = 0.5 * (test.w_plus - test.w_minus);
  test.p_normal = two_sided_p(excess / deviation);
  // R moves by a half towards the mean, and past it where less than a half is left.
  const double corrected = excess == 0.0 ? 0.0 : std::abs(excess) - 0.5;
  test.p_corrected = two_sided_p(corrected / deviation);
  return test;
}

std::optional<Interval> rank_biserial_interval(std::span<const double> differences,
                                               const BootstrapOptions& options) {
  NADE_ASSERT(options.resamples > 0);
  if (differences.empty()) return std::nullopt;
  std::mt19937_64 random(options.seed);
  std::vector<double> drawn(differences.size());
  std::vector<double> correlations(options.resamples);
  for (double& correlation : correlations) {
    for (double& difference : drawn) difference = differences[draw(random, differences.size())];
    correlation = rank_biserial(signed_ranks(drawn, ZeroDifferences::dropped));
  }
  const double tail = 0.5 * (1.0 - options.confidence);
  return Interval{quantile(correlations, tail), quantile(correlations, 1.0 - tail)};
}

}  // namespace nade::study
