#pragma once

#include <algorithm>
#include <cmath>

namespace nade {

/// 0 up to `from`, 1 from `to` on, and smooth between.
[[nodiscard]] inline double smoothstep(double from, double to, double x) noexcept {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// The share of its way that what follows with a time constant has made after so long; likewise
/// with lengths.
[[nodiscard]] inline double followed(double elapsed, double constant) noexcept {
  return 1.0 - std::exp(-elapsed / constant);
}

}  // namespace nade
