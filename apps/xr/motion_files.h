#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "nade/corrector.h"
#include "nade/study/motion_recorder.h"

namespace nade::xr {

/// What the header of a recording says beside the hands.
struct RecordedAs {
  std::string object;
  Placement placement;
  /// The recording's time at which the animation of an object that moves by itself began.
  std::optional<std::int64_t> animation_start_ns;
  Method method = Method::nade;
  SettleOptions settle;  ///< of method nade
  std::string headset;
  friend bool operator==(const RecordedAs& a, const RecordedAs& b) {
    return a.object == b.object && a.method == b.method;
  }
};

/// The recording of the tracked hands at `path`, of the corrected hands at `corrected_path(path)`.
/// Takes away a tracked recording that is there.
[[nodiscard]] study::MotionFiles motion_files(const std::string& path, const RecordedAs& as);

/// "stroke.jsonl.gz" gives "stroke-corrected.jsonl.gz".
[[nodiscard]] std::string corrected_path(const std::string& path);
/// Whether a run can record at `path`: a file that is there is replaced, one at
/// `corrected_path(path)`, which nobody has named, is not. The error names the file.
[[nodiscard]] Status check_recordable(const std::string& path);
/// The first number above `number` whose files are not there.
[[nodiscard]] int next_number(const std::string& path, int number);
/// "stroke.jsonl" and 2 give "stroke-2.jsonl"; 1 gives it as it is.
[[nodiscard]] std::string numbered_path(const std::string& path, int number);

}  // namespace nade::xr
