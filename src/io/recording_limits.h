#pragma once

#include <cstdint>

namespace nade::io {

/// What no number of a hand may be beyond, read or written: metres, so far that something is wrong.
inline constexpr double kFarthest_m = 1e6;

/// How far from 0 a time may be, read or written, so that the difference of two is a time as well:
/// 126 years.
inline constexpr std::int64_t kLatest_ns = 4'000'000'000'000'000'000;

}  // namespace nade::io
