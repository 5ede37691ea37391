#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>

#include "byte_source.h"
#include "frame_array.h"
#include "hand_intake.h"
#include "json_text.h"
#include "nade/io/recording.h"
#include "warnings.h"

namespace nade::io {

/// Reads action recordings of WebXR sessions as IWER's ActionRecorder makes them.
class WebxrImport {
 public:
  [[nodiscard]] static Result<WebxrImport> open(ByteSource source);

  [[nodiscard]] const RecordingHeader& header() const { return header_; }
  [[nodiscard]] Result<std::optional<RecordedFrame>> next();
  [[nodiscard]] const Warnings& warnings() const { return warnings_; }
  [[nodiscard]] HandIntake& intake() { return intake_; }
  [[nodiscard]] const std::string& name() const { return frames_.name(); }

 private:
  static constexpr std::size_t kWebxrJoints = kJointCount - 1;
  using JointSequence = std::array<Joint, kWebxrJoints>;

  /// What an input source records besides its target ray.
  struct InputSchema {
    std::optional<Handedness> side;
    bool has_grip = false;
    std::optional<JointSequence> joints;  ///< where it has a hand
  };

  explicit WebxrImport(ByteSource source);

  Status read_schema(const Json& schema);
  Result<InputSchema> input_schema(const Json& fields, const std::string& where) const;
  Result<RecordedFrame> read_frame(const Json& frame);
  Status read_input(const Json& input, std::size_t element, RecordedFrame& result);
  [[nodiscard]] std::string place() const { return frames_.place(); }

  FrameArray frames_;
  RecordingHeader header_;
  std::map<std::int64_t, InputSchema> inputs_;
  bool has_schema_ = false;
  Warnings warnings_;
  HandIntake intake_{1e-3};
  std::optional<std::int64_t> last_time_ns_;
};

}  // namespace nade::io
