#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "json_text.h"

namespace nade::io {

/// A frame's time as a file has it.
struct FrameTime {
  double value = 0.0;
  double unit_ns = 0.0;  ///< 0 where its key does not say it
};

/// What a frame has under "timestamp", "time" or "t", by itself or with a unit ("timestampMs",
/// "time_s"); none where it has none of them. The error names `place` and the key.
[[nodiscard]] Result<std::optional<FrameTime>> time_of_frame(const Json& frame,
                                                             const std::string& place);

/// The unit in which most of the steps between these times are 1 to 200 ms; milliseconds where
/// none is.
[[nodiscard]] double unit_by_steps(const std::vector<double>& times);

/// The error names `place`.
[[nodiscard]] Result<std::int64_t> nanoseconds_of(const FrameTime& time, const std::string& place);

}  // namespace nade::io
