#include "nade/study/signed_rank.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "nade/study/statistics.h"

namespace nade::study {
namespace {

using Json = nlohmann::json;

/// Half a unit of the last digit that is printed.
double printed_precision(const Json& number) {
  const std::string text = number.dump();
  const std::size_t point = text.find('.');
  const std::size_t decimals = point == std::string::npos ? 0 : text.size() - point - 1;
  return std::min(5e-7, 0.51 * std::pow(10.0, -static_cast<double>(decimals)));
}

void expect_printed(const Json& expected, const char* key, const std::optional<double>& found) {
  if (!expected.contains(key)) return;
  ASSERT_TRUE(found) << key;
  EXPECT_NEAR(*found, expected[key].get<double>(), printed_precision(expected[key])) << key;
}

void expect_case(const Json& expected, std::span<const double> differences, ZeroDifferences zeros) {
  const SignedRankTest test = signed_rank(differences, zeros);
  if (expected.contains("n")) {
    EXPECT_EQ(test.pairs - test.zeros, expected["n"].get<std::size_t>());
  }
  expect_printed(expected, "w_plus", test.w_plus);
  expect_printed(expected, "p_exact", test.p_exact);
  expect_printed(expected, "p_cc", test.p_corrected);
  expect_printed(expected, "p_normal", test.p_normal);
  expect_printed(expected, "rank_biserial", test.rank_biserial);
}

std::vector<double> differences_of(const Json& from) {
  if (from.contains("d")) return from["d"].get<std::vector<double>>();
  const auto x = from["x"].get<std::vector<double>>();
  const auto y = from["y"].get<std::vector<double>>();
  std::vector<double> differences;
  for (std::size_t i = 0; i < x.size(); ++i) differences.push_back(x[i] - y.at(i));
  return differences;
}

TEST(SignedRank, StoredCasesToPrintedDigits) {
  std::ifstream file(NADE_TEST_SHARED_DATA "/stats/wilcoxon.json");
  if (!file) GTEST_SKIP() << "no " NADE_TEST_SHARED_DATA "/stats/wilcoxon.json";
  const Json stored = Json::parse(file);
  ASSERT_FALSE(stored["cases"].empty());
  for (const Json& entry : stored["cases"]) {
    SCOPED_TRACE(entry["name"].get<std::string>());
    const std::vector<double> differences = differences_of(entry);
    if (entry.contains("zeros_dropped")) {
      expect_case(entry["zeros_dropped"], differences, ZeroDifferences::dropped);
    }
    if (entry.contains("zeros_pratt")) {
      expect_case(entry["zeros_pratt"], differences, ZeroDifferences::pratt);
    }
  }
  const auto p = stored["holm"]["p"].get<std::vector<double>>();
  const auto adjusted = stored["holm"]["adjusted"].get<std::vector<double>>();
  const std::vector<double> found = holm(p);
  ASSERT_EQ(found.size(), adjusted.size());
  for (std::size_t i = 0; i < p.size(); ++i) EXPECT_NEAR(found[i], adjusted[i], 1e-12);
}

// Bortz, Lienert, Boehnke. Verteilungsfreie Methoden in der Biostatistik. 2008.
TEST(SignedRank, TiesAndZeros) {
  const std::vector<double> differences{-4, -1, -1, -1, -2, 0, 0, 1, 0, -2, 4, -1, -1, 0, 0};
  const SignedRankTest dropped = signed_rank(differences, ZeroDifferences::dropped);
  EXPECT_EQ(dropped.pairs, 15U);
  EXPECT_EQ(dropped.zeros, 5U);
  EXPECT_EQ(dropped.w_plus, 13.0);
  EXPECT_EQ(dropped.w_minus, 42.0);
  EXPECT_EQ(dropped.p_exact, 0.13671875);
  const SignedRankTest pratt = signed_rank(differences, ZeroDifferences::pratt);
  EXPECT_EQ(pratt.w_plus, 23.0);
  EXPECT_EQ(pratt.p_exact, 0.09765625);
}

// Darwin's maize in Fisher. The Design of Experiments. 1935.
TEST(SignedRank, DarwinsMaize) {
  const std::vector<double> differences{6, 8, 14, 16, 23, 24, 28, 29, 41, -48, 49, 56, 60, -67, 75};
  const SignedRankTest test = signed_rank(differences, ZeroDifferences::dropped);
  EXPECT_EQ(test.w_plus, 96.0);
  EXPECT_EQ(test.p_exact, 0.041259765625);
  EXPECT_NEAR(*test.p_corrected, 0.04377232, 5e-9);
  EXPECT_NEAR(test.rank_biserial, 0.6, 1e-12);
}

// Hollander, Wolfe. Nonparametric Statistical Methods. 1973; the example of R's wilcox.test.
TEST(SignedRank, DepressionScale) {
  const std::array before{1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30};
  const std::array after{0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29};
  std::vector<double> differences;
  for (std::size_t i = 0; i < before.size(); ++i) differences.push_back(before[i] - after[i]);
  const SignedRankTest test = signed_rank(differences, ZeroDifferences::dropped);
  EXPECT_EQ(test.w_plus, 40.0);
  EXPECT_EQ(test.p_exact, 0.0390625);
}

/// Every assignment of signs, one by one.
double brute_force_p(const std::vector<double>& differences, ZeroDifferences zeros) {
  const SignedRankTest observed = signed_rank(differences, zeros);
  const double distance = std::abs(observed.w_plus - observed.w_minus);
  std::size_t as_far = 0;
  const std::size_t assignments = std::size_t{1} << differences.size();
  for (std::size_t signs = 0; signs < assignments; ++signs) {
    std::vector<double> flipped = differences;
    for (std::size_t i = 0; i < flipped.size(); ++i) {
      if ((signs >> i & 1U) != 0U) flipped[i] = -flipped[i];
    }
    const SignedRankTest other = signed_rank(flipped, zeros);
    if (std::abs(other.w_plus - other.w_minus) >= distance) ++as_far;
  }
  return static_cast<double>(as_far) / static_cast<double>(assignments);
}

TEST(SignedRank, ExactIsEveryAssignmentOfSigns) {
  std::mt19937 random(11);
  for (int round = 0; round < 40; ++round) {
    std::vector<double> differences(1 + static_cast<std::size_t>(round) % 9);
    for (double& difference : differences) difference = static_cast<double>(random() % 9U) - 4.0;
    for (const ZeroDifferences zeros : {ZeroDifferences::dropped, ZeroDifferences::pratt}) {
      EXPECT_NEAR(*signed_rank(differences, zeros).p_exact, brute_force_p(differences, zeros),
                  1e-12)
          << "round " << round;
    }
  }
}

TEST(SignedRank, NoDifferenceAnywhere) {
  for (const std::vector<double>& differences : {std::vector<double>{}, {0.0, -0.0, 0.0}}) {
    for (const ZeroDifferences zeros : {ZeroDifferences::dropped, ZeroDifferences::pratt}) {
      const SignedRankTest test = signed_rank(differences, zeros);
      EXPECT_EQ(test.zeros, differences.size());
      EXPECT_EQ(test.p_exact, 1.0);
      EXPECT_FALSE(test.p_corrected);
      EXPECT_FALSE(test.p_normal);
      EXPECT_EQ(test.rank_biserial, 0.0);
    }
  }
  EXPECT_FALSE(rank_biserial_interval({}));
}

TEST(SignedRank, ManyPairsHaveTheApproximationOnly) {
  std::vector<double> differences(kExactPairs, 1.0);
  EXPECT_TRUE(signed_rank(differences, ZeroDifferences::dropped).p_exact);
  differences.push_back(1.0);
  const SignedRankTest test = signed_rank(differences, ZeroDifferences::dropped);
  EXPECT_FALSE(test.p_exact);
  EXPECT_LT(*test.p_corrected, 1e-6);
}

TEST(SignedRank, IntervalHoldsTheEffectAndIsTheSameEveryTime) {
  const std::vector<double> differences{6, 8, 14, 16, 23, 24, 28, 29, 41, -48, 49, 56, 60, -67, 75};
  const auto interval = rank_biserial_interval(differences);
  ASSERT_TRUE(interval);
  EXPECT_LT(interval->low, 0.6);
  EXPECT_GT(interval->high, 0.6);
  const auto again = rank_biserial_interval(differences);
  EXPECT_EQ(again->low, interval->low);
  EXPECT_EQ(again->high, interval->high);
  const auto narrower = rank_biserial_interval(differences, {.confidence = 0.5});
  EXPECT_GT(narrower->low, interval->low);
  EXPECT_LT(narrower->high, interval->high);
}

TEST(SignedRank, IntervalOfAgreementHasNoWidth) {
  const auto interval = rank_biserial_interval(std::vector<double>{1, 2, 2, 3, 5});
  ASSERT_TRUE(interval);
  EXPECT_EQ(interval->low, 1.0);
  EXPECT_EQ(interval->high, 1.0);
}

// R 4.2.2: quantile(c(7, 1, 3, 2), type = 7).
TEST(StudyStatistics, QuartilesAreTypeSeven) {
  const std::vector<double> values{7, 1, 3, 2};
  EXPECT_EQ(quantile(values, 0.0), 1.0);
  EXPECT_EQ(quantile(values, 0.25), 1.75);
  EXPECT_EQ(quantile(values, 0.5), 2.5);
  EXPECT_EQ(quantile(values, 0.75), 4.0);
  EXPECT_EQ(quantile(values, 1.0), 7.0);
  EXPECT_EQ(quantile(std::vector<double>{4.5}, 0.75), 4.5);
}

TEST(StudyStatistics, WhiskersStopAtTheLastValueWithinReach) {
  const BoxSummary box = box_summary(std::vector<double>{1, 4, 4, 5, 5, 5, 6, 6, 7});
  EXPECT_EQ(box.median, 5.0);
  EXPECT_EQ(box.lower_quartile, 4.0);
  EXPECT_EQ(box.upper_quartile, 6.0);
  EXPECT_EQ(box.lower_whisker, 1.0);
  EXPECT_EQ(box.upper_whisker, 7.0);
  EXPECT_EQ(box_summary(std::vector<double>{1, 5, 5, 5, 5, 6}).lower_whisker, 5.0);
}

TEST(StudyStatistics, HolmKeepsTheOrderGivenAndNeverFalls) {
  const std::vector<double> adjusted = holm(std::vector<double>{0.04, 0.01, 0.03, 0.9});
  EXPECT_NEAR(adjusted[0], 0.09, 1e-12);
  EXPECT_NEAR(adjusted[1], 0.04, 1e-12);
  EXPECT_NEAR(adjusted[2], 0.09, 1e-12);
  EXPECT_NEAR(adjusted[3], 0.9, 1e-12);
  EXPECT_TRUE(holm({}).empty());
  EXPECT_EQ(holm(std::vector<double>{0.7, 0.8}), (std::vector<double>{1.0, 1.0}));
}

}  // namespace
}  // namespace nade::study
