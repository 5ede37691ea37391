#include "nade/eval/quantile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace nade {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Values over nine orders of magnitude, and zeros.
std::vector<double> wild_values(std::size_t count) {
  std::mt19937 random(3);
  std::normal_distribution<double> exponent(0.0, 3.0);
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(i % 50 == 0 ? 0.0 : std::exp(exponent(random)));
  }
  return values;
}

double exact_quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(values.size())));
  return values[std::max<std::size_t>(rank, 1) - 1];
}

TEST(Quantile, NothingAdded) {
  const QuantileSketch sketch;
  EXPECT_EQ(sketch.count(), 0U);
  EXPECT_FALSE(sketch.max());
  EXPECT_FALSE(sketch.mean());
  EXPECT_FALSE(sketch.quantile(0.5));
}

TEST(Quantile, ExactForFewValues) {
  QuantileSketch sketch;
  for (int i = 100; i > 0; --i) sketch.add(i);
  EXPECT_EQ(sketch.quantile(0.0), 1.0);
  EXPECT_EQ(sketch.quantile(0.5), 50.0);
  EXPECT_EQ(sketch.quantile(0.95), 95.0);
  EXPECT_EQ(sketch.quantile(0.99), 99.0);
  EXPECT_EQ(sketch.quantile(1.0), 100.0);
  EXPECT_EQ(sketch.max(), 100.0);
  EXPECT_EQ(sketch.mean(), 50.5);
}

TEST(Quantile, ManyValuesWithinATenthOfAPercent) {
  const std::vector<double> values = wild_values(100'000);
  QuantileSketch sketch;
  for (const double value : values) sketch.add(value);
  EXPECT_EQ(sketch.count(), values.size());
  EXPECT_EQ(sketch.quantile(0.01), 0.0);
  for (const double q : {0.1, 0.5, 0.9, 0.95, 0.99, 0.999, 1.0}) {
    const double exact = exact_quantile(values, q);
    EXPECT_NEAR(*sketch.quantile(q), exact, 1.0001 * QuantileSketch::kRelativeError * exact) << q;
  }
}

TEST(Quantile, MergedAsIfAddedToOne) {
  const std::vector<double> values = wild_values(30'000);
  for (const std::size_t split : {std::size_t{0}, std::size_t{100}, std::size_t{15'000},
                                  std::size_t{29'900}, values.size()}) {
    QuantileSketch first;
    QuantileSketch second;
    QuantileSketch all;
    for (std::size_t i = 0; i < values.size(); ++i) {
      (i < split ? first : second).add(values[i]);
      all.add(values[i]);
    }
    first.merge(second);
    EXPECT_EQ(first.count(), all.count());
    EXPECT_EQ(first.max(), all.max());
    EXPECT_NEAR(*first.mean(), *all.mean(), 1e-9 * *all.mean());
    EXPECT_EQ(first.quantile(0.5), all.quantile(0.5));
    EXPECT_EQ(first.quantile(0.99), all.quantile(0.99));
  }
}

TEST(Quantile, ValuesThatAreNoneAreLeftOut) {
  QuantileSketch sketch;
  sketch.add(kNan);
  sketch.add(std::numeric_limits<double>::infinity());
  sketch.add(-1.0);
  sketch.add(2.0);
  EXPECT_EQ(sketch.count(), 1U);
  EXPECT_EQ(sketch.quantile(0.5), 2.0);
}

TEST(Quantile, HugeAndTinyValuesStayInRange) {
  QuantileSketch sketch;
  for (int i = 0; i < 10'000; ++i) sketch.add(i % 2 == 0 ? 1e-300 : 1e300);
  EXPECT_EQ(sketch.quantile(0.25), 1e-300);
  EXPECT_GE(*sketch.quantile(0.75), 1e11);
}

}  // namespace
}  // namespace nade
