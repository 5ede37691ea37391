#pragma once

#include <cstdint>
#include <optional>

#include "byte_source.h"
#include "frame_array.h"
#include "hand_intake.h"
#include "json_text.h"
#include "leap_hand.h"
#include "nade/io/recording.h"
#include "warnings.h"

namespace nade::io {

/// Reads raw frames of a Leap Motion v2 as LeapJS has them: an object with an array "frames", or
/// the array itself; frames may be packed as LeapJS Playback does it.
class LeapImport {
 public:
  [[nodiscard]] static Result<LeapImport> open(ByteSource source);

  [[nodiscard]] const RecordingHeader& header() const { return header_; }
  [[nodiscard]] Result<std::optional<RecordedFrame>> next();
  [[nodiscard]] const Warnings& warnings() const { return warnings_; }
  [[nodiscard]] HandIntake& intake() { return intake_; }
  [[nodiscard]] const std::string& name() const { return frames_.name(); }

 private:
  explicit LeapImport(ByteSource source);

  Result<std::optional<Json>> next_frame();
  Result<RecordedFrame> read_frame(const Json& frame);
  Status read_hand(const Json& frame, std::size_t hand_index, RecordedFrame& result);
  void leave_out(Oddity oddity, const std::string& what);
  [[nodiscard]] std::string place() const;

  FrameArray frames_;
  RecordingHeader header_;
  Warnings warnings_;
  HandIntake intake_{1e-6};
  std::optional<std::int64_t> last_time_ns_;
  std::optional<Json> keys_;  ///< of packed frames
};

}  // namespace nade::io
