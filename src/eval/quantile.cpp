#include "nade/eval/quantile.h"

#include <algorithm>
#include <cmath>

namespace nade {
namespace {

constexpr double kSmallest = 1e-6;
constexpr double kLargest = 1e12;

/// Logarithm of the ratio of a bucket's upper to its lower bound.
const double kLogRatio =
    std::log((1.0 + QuantileSketch::kRelativeError) / (1.0 - QuantileSketch::kRelativeError));
const std::size_t kBucketCount =
    2 + static_cast<std::size_t>(std::log(kLargest / kSmallest) / kLogRatio);

/// Bucket 0 is for what counts as zero.
std::size_t bucket_of(double value) {
  if (value < kSmallest) return 0;
  const auto bucket =
      1 + static_cast<std::size_t>(std::log(std::min(value, kLargest) / kSmallest) / kLogRatio);
  return std::min(bucket, kBucketCount - 1);
}

/// The value whose relative distance to both bounds of a bucket is the same.
double middle_of(std::size_t bucket) {
  if (bucket == 0) return 0.0;
  const double lower = kSmallest * std::exp(static_cast<double>(bucket - 1) * kLogRatio);
  return lower * (1.0 + QuantileSketch::kRelativeError);
}

}  // namespace

void QuantileSketch::add_to_buckets(double value) {
  if (buckets_.empty()) buckets_.resize(kBucketCount);
  ++buckets_[bucket_of(value)];
}

void QuantileSketch::add(double value) {
  if (!std::isfinite(value) || value < 0.0) return;
  min_ = count_ == 0 ? value : std::min(min_, value);
  max_ = count_ == 0 ? value : std::max(max_, value);
  sum_ += value;
  ++count_;
  if (buckets_.empty() && exact_.size() < kExactCount) {
    exact_.push_back(value);
    return;
  }
  for (const double earlier : exact_) add_to_buckets(earlier);
  exact_.clear();
  add_to_buckets(value);
}

void QuantileSketch::merge(const QuantileSketch& other) {
  if (other.buckets_.empty()) {
    for (const double value : other.exact_) add(value);
    return;
  }
  for (const double earlier : exact_) add_to_buckets(earlier);
  exact_.clear();
  buckets_.resize(kBucketCount);
  for (std::size_t i = 0; i < kBucketCount; ++i) buckets_[i] += other.buckets_[i];
  min_ = count_ == 0 ? other.min_ : std::min(min_, other.min_);
  max_ = count_ == 0 ? other.max_ : std::max(max_, other.max_);
  sum_ += other.sum_;
  count_ += other.count_;
}

std::optional<double> QuantileSketch::max() const {
  if (count_ == 0) return std::nullopt;
  return max_;
}

std::optional<double> QuantileSketch::mean() const {
  if (count_ == 0) return std::nullopt;
  return sum_ / static_cast<double>(count_);
}

std::optional<double> QuantileSketch::quantile(double q) const {
  if (count_ == 0) return std::nullopt;
  // A hair below, so that 0.99 of 100 values is the 99th and not, by rounding, the 100th.
  const double wanted = std::clamp(q, 0.0, 1.0) * static_cast<double>(count_) * (1.0 - 1e-12);
  const auto rank = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(wanted)));
  if (buckets_.empty()) {
    std::vector<double> sorted = exact_;
    const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(rank - 1);
    std::nth_element(sorted.begin(), at, sorted.end());
    return *at;
  }
  std::uint64_t seen = 0;
  std::size_t bucket = 0;
  for (; bucket + 1 < kBucketCount; ++bucket) {
    seen += buckets_[bucket];
    if (seen >= rank) break;
  }
  return std::clamp(middle_of(bucket), min_, max_);
}

}  // namespace nade
