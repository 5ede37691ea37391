#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "byte_source.h"
#include "hand_intake.h"
#include "nade/io/recording.h"
#include "warnings.h"

namespace nade::io {

/// Whether bytes begin like a recording of Unity's XR Hand Capture.
[[nodiscard]] bool looks_like_unity_hands(std::string_view beginning);

/// Whether a text begins like an asset of Unity's editor.
[[nodiscard]] bool looks_like_unity_asset(std::string_view beginning);

/// Reads recordings of Unity's XR Hand Capture (.handsbin, version 1): Unity's left-handed axes
/// become ours.
class UnityImport {
 public:
  [[nodiscard]] static Result<UnityImport> open(ByteSource source);

  [[nodiscard]] const RecordingHeader& header() const { return header_; }
  [[nodiscard]] Result<std::optional<RecordedFrame>> next();
  [[nodiscard]] const Warnings& warnings() const { return warnings_; }
  [[nodiscard]] HandIntake& intake() { return intake_; }
  [[nodiscard]] const std::string& name() const { return source_.name(); }

 private:
  explicit UnityImport(ByteSource source) : source_(std::move(source)) {}

  Status read_header();
  /// None where the file is cut off, which is a warning.
  Result<std::optional<RecordedFrame>> read_frame();
  Result<std::optional<RecordedFrame>> cut_off();
  std::optional<std::uint32_t> read_int();
  std::optional<double> read_float();
  std::optional<Pose> read_pose();
  std::optional<HandPose> read_hand(Handedness side);
  [[nodiscard]] std::string place() const;

  ByteSource source_;
  RecordingHeader header_;
  Warnings warnings_;
  HandIntake intake_{1.0};
  std::uint32_t frame_count_ = 0;
  std::uint32_t read_ = 0;
  bool at_end_ = false;
  std::optional<std::int64_t> last_time_ns_;
};

}  // namespace nade::io
