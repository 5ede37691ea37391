#include "frame_costs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nade::xr {
namespace {

constexpr std::size_t kRoom = 1U << 16U;
constexpr std::size_t kWarmUp = 30;

FrameCosts::Sum sum_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t last = values.size() - 1;
  const auto at = [&](double share) {
    return 1e3 * values[static_cast<std::size_t>(std::lround(share * static_cast<double>(last)))];
  };
  return {at(0.5), at(0.99)};
}

}  // namespace

FrameCosts::FrameCosts() : costs_(kRoom) {}

void FrameCosts::add(const FrameCost& cost) noexcept {
  last_correction_us_ = 1e6 * cost.correct_s;
  if (seen_++ < kWarmUp) return;
  costs_[counted_ % kRoom] = cost;
  ++counted_;
}

FrameCosts::Report FrameCosts::report() const {
  const auto end = costs_.begin() + static_cast<std::ptrdiff_t>(std::min(counted_, kRoom));
  const auto sum = [&](auto&& value) {
    std::vector<double> values;
    std::transform(costs_.begin(), end, std::back_inserter(values), value);
    return sum_of(std::move(values));
  };
  return {sum([](const FrameCost& cost) { return cost.correct_s; }),
          sum([](const FrameCost& cost) { return cost.pose_s; }),
          sum([](const FrameCost& cost) { return cost.submit_s; }),
          sum([](const FrameCost& cost) { return cost.correct_s + cost.pose_s + cost.submit_s; })};
}

std::string as_text(const FrameCosts& costs) {
  const FrameCosts::Report report = costs.report();
  const auto both = [](const FrameCosts::Sum& sum) {
    return fmt::format("{:.3f} ms (p99 {:.3f})", sum.median_ms, sum.p99_ms);
  };
  return fmt::format(
      "{} frames; processor time of the frame's thread, median: correcting both hands {}, posing "
      "skins and arranging the scene {}, drawing calls for both eyes {}, together {}",
      costs.frames(), both(report.correct), both(report.pose), both(report.submit),
      both(report.together));
}

}  // namespace nade::xr
