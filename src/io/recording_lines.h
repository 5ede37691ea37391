#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>

#include "byte_source.h"
#include "hand_intake.h"
#include "json_text.h"
#include "nade/io/recording.h"
#include "warnings.h"

namespace nade::io {

/// Reads our own format.
class RecordingLines {
 public:
  [[nodiscard]] static Result<RecordingLines> open(ByteSource source);

  [[nodiscard]] const RecordingHeader& header() const { return header_; }
  [[nodiscard]] Result<std::optional<RecordedFrame>> next();
  [[nodiscard]] const Warnings& warnings() const { return warnings_; }
  [[nodiscard]] HandIntake& intake() { return intake_; }
  [[nodiscard]] const std::string& name() const { return source_.name(); }

 private:
  explicit RecordingLines(ByteSource source) : source_(std::move(source)) {}

  /// The next line that is not blank, as JSON; none at the end.
  Result<std::optional<Json>> next_json();
  Status read_header();
  Result<RecordedFrame> read_frame(Json object);
  [[nodiscard]] Error wrong_count(Handedness side, const std::string& found) const;
  Status read_joints(const Json& joints, HandPose& pose);
  Result<std::optional<RecordedHand>> read_hand(Json object, Handedness side);
  [[nodiscard]] std::string place() const;
  [[nodiscard]] Error bad_value(const std::string& sentence) const;

  ByteSource source_;
  RecordingHeader header_;
  Warnings warnings_;
  HandIntake intake_{1e-9};
  std::size_t line_ = 0;
  std::optional<std::int64_t> last_time_ns_;
};

/// What of a frame cannot be written, to be prefixed with the file's name.
[[nodiscard]] Status check_frame(const RecordedFrame& frame);

/// Appends a line of our format, with its end.
void append_header(const RecordingHeader& header, fmt::memory_buffer& out);
void append_frame(const RecordedFrame& frame, fmt::memory_buffer& out);

}  // namespace nade::io
