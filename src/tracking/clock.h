#pragma once

#include <algorithm>

#include "proxy/state.h"
#include "ramps.h"

namespace nade {

/// How long a frame counts that came so long after the last: as long as all do in the mean, where
/// it is near that, since a tracker's times tremble more than its samples; a millisecond at the
/// least, and 50 at the most.
[[nodiscard]] inline double frame_seconds(double seconds, ProxyState& state) noexcept {
  constexpr double kMean_s = 0.35;
  constexpr double kLost = 1.6;  // so many times as long, a frame was lost
  constexpr double kShortest_s = 0.001;
  constexpr double kLongest_s = 0.05;
  if (seconds <= kLongest_s) {
    const double share = state.frame_s == 0.0 ? 1.0 : followed(seconds, kMean_s);
    state.frame_s += share * (seconds - state.frame_s);
  }
  const bool is_even = seconds < kLost * state.frame_s;
  return std::clamp(is_even ? state.frame_s : seconds, kShortest_s, kLongest_s);
}

}  // namespace nade
