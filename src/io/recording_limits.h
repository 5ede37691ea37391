#pragma once

#include <cstddef>
#include <cstdint>

namespace nade::io {

/// What no number of a hand may be beyond, read or written: metres, so far that something is wrong.
inline constexpr double kFarthest_m = 1e6;

/// How far from 0 a time may be, read or written, so that the difference of two is a time as well:
/// 126 years.
inline constexpr std::int64_t kLatest_ns = 4'000'000'000'000'000'000;

/// A joint's position, rotation and radius.
inline constexpr std::size_t kJointNumbers = 8;

/// A rotation that is read may be so long, and is made unit.
inline constexpr double kShortestRotation = 0.5;
inline constexpr double kLongestRotation = 2.0;

}  // namespace nade::io
