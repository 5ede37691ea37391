#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "nade/eval/recording_pair.h"
#include "nade/io/recording.h"
#include "nade/status.h"

namespace nade::cli {

/// Whether a recording's hands were corrected, which its header says by naming a method.
[[nodiscard]] inline bool is_corrected(const RecordingHeader& header) {
  return !method_of(header).empty();
}

/// The error where a corrected recording was given and a tracked one is `expected`.
[[nodiscard]] inline Error not_tracked(const std::string& recording, std::string_view expected) {
  return {ErrorCode::bad_value,
          fmt::format("{}: expected {}, found a corrected one", recording, expected)};
}
constexpr std::string_view kTracked = "a tracked recording";
constexpr std::string_view kTrackedFirst = "the tracked recording first";

}  // namespace nade::cli
