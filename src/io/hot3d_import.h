#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "byte_source.h"
#include "frame_stream.h"
#include "hand_intake.h"
#include "nade/io/recording.h"
#include "umetrack_hand.h"
#include "warnings.h"

namespace nade::io {

/// Reads the hands of HOT3D as its trackers gave them (umetrack_hand_pose_trajectory.jsonl): the
/// angles of the hand whose file lies beside it.
class Hot3dImport {
 public:
  [[nodiscard]] static Result<Hot3dImport> open(ByteSource source);

  [[nodiscard]] const RecordingHeader& header() const { return header_; }
  [[nodiscard]] Result<std::optional<RecordedFrame>> next();
  [[nodiscard]] const Warnings& warnings() const { return warnings_; }
  [[nodiscard]] HandIntake& intake() { return intake_; }
  [[nodiscard]] const std::string& name() const { return lines_.name(); }

 private:
  explicit Hot3dImport(ByteSource source) : lines_(std::move(source)) {}

  Status read_model();
  /// From the file that says whose headset it was.
  void learn_up();
  Result<RecordedFrame> read_frame(const Json& line);
  Status read_hand(const Json& hand, Handedness side, RecordedFrame& frame);
  [[nodiscard]] Error wrong(const std::string& what) const;

  JsonLines lines_;
  RecordingHeader header_;
  Warnings warnings_;
  HandIntake intake_{1e-9, HandIntake::Rotations::inferred};
  std::optional<UmetrackModel> model_;
  Quat up_ = Quat::Identity();  ///< turns the file's axes into ours
  std::optional<std::int64_t> last_time_ns_;
};

}  // namespace nade::io
