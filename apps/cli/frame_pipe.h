#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "nade/io/recording.h"
#include "nade/status.h"

namespace nade::cli {

/// Reads frames, lets `change` work on each, and writes them: all three at once, on threads of
/// their own, in memory that does not grow. `first` is a frame that was read already, if any. Gives
/// the number of frames; an error of either side ends it.
[[nodiscard]] Result<std::size_t> pipe_frames(RecordingReader& reader,
                                              std::optional<RecordedFrame> first,
                                              const std::function<void(RecordedFrame&)>& change,
                                              RecordingWriter& writer);

}  // namespace nade::cli
