#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

namespace nade::bench {

using Clock = std::chrono::steady_clock;

struct Summary {
  double median_ns = 0.0;
  double p99_ns = 0.0;
};

/// Time of one call, for calls made one after another; the clock's own time taken off.
class Stopwatch {
 public:
  /// So many calls are expected.
  explicit Stopwatch(std::size_t calls) {
    constexpr std::size_t kIdleCalls = 10000;
    samples_.reserve(std::max(calls, kIdleCalls));
    for (std::size_t i = 0; i < kIdleCalls; ++i) measure([] {});
    overhead_ns_ = summary().median_ns;
    samples_.clear();
  }
  template <class Action>
  void measure(Action&& action) {
    const auto start = Clock::now();
    action();
    samples_.push_back(std::chrono::duration<double, std::nano>(Clock::now() - start).count() -
                       overhead_ns_);
  }
  /// Of one call at least.
  [[nodiscard]] Summary summary() {
    std::sort(samples_.begin(), samples_.end());
    return {samples_[samples_.size() / 2], samples_[samples_.size() * 99 / 100]};
  }

 private:
  std::vector<double> samples_;
  double overhead_ns_ = 0.0;
};

}  // namespace nade::bench
