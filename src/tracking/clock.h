#pragma once

#include <algorithm>

#include "ramps.h"

namespace nade {

/// What is known of a tracker's clock.
struct TrackerClock {
  double frame_s = 0.0;  ///< between frames, in the mean
};

/// How long a frame counts that came so long after the last: as long as all do in the mean, where
/// it is near that, since a tracker's times tremble more than its samples; a millisecond at the
/// least, and 50 at the most. Its numbers are of trackers, not of the method.
[[nodiscard]] inline double frame_seconds(double seconds, TrackerClock& clock) noexcept {
  constexpr double kMean_s = 0.35;
  constexpr double kLost = 1.6;  // so many times as long, a frame was lost
  constexpr double kShortest_s = 0.001;
  constexpr double kLongest_s = 0.05;
  if (seconds <= kLongest_s) {
    const double share = clock.frame_s == 0.0 ? 1.0 : followed(seconds, kMean_s);
    clock.frame_s += share * (seconds - clock.frame_s);
  }
  const bool is_even = seconds < kLost * clock.frame_s;
  return std::clamp(is_even ? clock.frame_s : seconds, kShortest_s, kLongest_s);
}

}  // namespace nade
