#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>

namespace nade {

/// 0 as far as `from`, 1 from `to` on, and smooth between; `to` may be the lesser.
template <std::floating_point T>
[[nodiscard]] T smoothstep(T from, T to, T x) noexcept {
  const T t = std::clamp((x - from) / (to - from), T{0}, T{1});
  return t * t * (T{3} - T{2} * t);
}

/// The share of its way that what follows with a time constant has made after so long; likewise
/// with lengths.
[[nodiscard]] inline double followed(double elapsed, double constant) noexcept {
  return 1.0 - std::exp(-elapsed / constant);
}

}  // namespace nade
