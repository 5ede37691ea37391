#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "byte_source.h"
#include "frame_stream.h"
#include "hand_intake.h"
#include "nade/io/recording.h"
#include "warnings.h"

namespace nade::io {

/// Reads what pages write down of the hands of a WebXR session, a frame with a time and a hand's
/// joints under "left" and "right" or in "hands".
class WebxrDumpImport {
 public:
  [[nodiscard]] static Result<WebxrDumpImport> open(ByteSource source);

  [[nodiscard]] const RecordingHeader& header() const { return header_; }
  [[nodiscard]] Result<std::optional<RecordedFrame>> next();
  [[nodiscard]] const Warnings& warnings() const { return warnings_; }
  [[nodiscard]] HandIntake& intake() { return intake_; }
  [[nodiscard]] const std::string& name() const { return frames_.name(); }

 private:
  explicit WebxrDumpImport(FrameStream frames) : frames_(std::move(frames)) {
    header_.source = "webxr";
  }

  Result<RecordedFrame> read_frame(const Json& frame);
  Status read_listed_hands(const Json& hands, RecordedFrame& frame);
  Status read_hand(const Json& hand, Handedness side, const std::string& where,
                   RecordedFrame& frame);
  [[nodiscard]] std::string place() const { return frames_.place(); }

  FrameStream frames_;
  RecordingHeader header_;
  Warnings warnings_;
  HandIntake intake_{1e-3};
  std::optional<std::int64_t> last_time_ns_;
};

}  // namespace nade::io
