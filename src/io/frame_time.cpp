#include "frame_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "recording_limits.h"

namespace nade::io {
namespace {

constexpr double kMillisecond_ns = 1e6;
constexpr double kShortestFrame_ns = 1e6;
constexpr double kLongestFrame_ns = 2e8;
/// The longest step in one unit is shorter than the shortest in the next, so the order is of no
/// matter.
constexpr std::array kTimeUnits_ns{kMillisecond_ns, 1e9, 1e3, 1.0};

struct TimeKey {
  const char* key;
  double unit_ns;
};
constexpr std::array<TimeKey, 17> kTimeKeys{{{"timestamp_ms", kMillisecond_ns},
                                             {"timestampMs", kMillisecond_ns},
                                             {"time_ms", kMillisecond_ns},
                                             {"timeMs", kMillisecond_ns},
                                             {"t_ms", kMillisecond_ns},
                                             {"timestampInMilliseconds", kMillisecond_ns},
                                             {"timestamp_us", 1e3},
                                             {"timestampUs", 1e3},
                                             {"time_us", 1e3},
                                             {"timestamp_ns", 1.0},
                                             {"timestampNs", 1.0},
                                             {"time_ns", 1.0},
                                             {"timestamp_s", 1e9},
                                             {"time_s", 1e9},
                                             {"timestamp", 0.0},
                                             {"time", 0.0},
                                             {"t", 0.0}}};

}  // namespace

Result<std::optional<FrameTime>> time_of_frame(const Json& frame, const std::string& place) {
  for (const TimeKey& known : kTimeKeys) {
    const auto found = frame.find(known.key);
    if (found == frame.end()) continue;
    if (!found->is_number()) {
      return Error{ErrorCode::bad_value, fmt::format("{}: {}: expected a time, found {}", place,
                                                     known.key, kind_of(*found))};
    }
    return std::optional<FrameTime>({found->get<double>(), known.unit_ns});
  }
  return std::optional<FrameTime>();
}

double unit_by_steps(const std::vector<double>& times) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double step = times[i] - times[i - 1];
    if (step > 0.0) steps.push_back(step);
  }
  if (steps.empty()) return kMillisecond_ns;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  const auto unit = std::find_if(kTimeUnits_ns.begin(), kTimeUnits_ns.end(), [&](double unit_ns) {
    const double step_ns = *middle * unit_ns;
    return step_ns >= kShortestFrame_ns && step_ns <= kLongestFrame_ns;
  });
  return unit == kTimeUnits_ns.end() ? kMillisecond_ns : *unit;
}

Result<std::int64_t> nanoseconds_of(const FrameTime& time, const std::string& place) {
  const double time_ns = time.value * time.unit_ns;
  if (std::abs(time_ns) < static_cast<double>(kLatest_ns)) return std::llround(time_ns);
  return Error{
      ErrorCode::bad_value,
      fmt::format("{}: expected a time within 126 years of 0, found {}", place, time.value)};
}

}  // namespace nade::io
