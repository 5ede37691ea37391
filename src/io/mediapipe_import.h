#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "byte_source.h"
#include "frame_stream.h"
#include "frame_time.h"
#include "hand_intake.h"
#include "mediapipe_hand.h"
#include "mediapipe_result.h"
#include "nade/io/recording.h"
#include "warnings.h"

namespace nade::io {

/// Reads results of MediaPipe's HandLandmarker and of its older Hands solution. Some hundred
/// frames are read ahead: what a file does not say, the unit of time, the hand's proportions and
/// its size in the picture, is the same for all of it.
class MediapipeImport {
 public:
  [[nodiscard]] static Result<MediapipeImport> open(ByteSource source);

  [[nodiscard]] const RecordingHeader& header() const { return header_; }
  [[nodiscard]] Result<std::optional<RecordedFrame>> next();
  [[nodiscard]] const Warnings& warnings() const { return warnings_; }
  [[nodiscard]] HandIntake& intake() { return intake_; }
  [[nodiscard]] const std::string& name() const { return frames_.name(); }

 private:
  /// A frame that is read ahead.
  struct Ahead {
    std::string place;
    FrameTime time;
    double aspect = 1.0;
    LandmarkHands hands{};
  };

  MediapipeImport(FrameStream frames, std::optional<double> aspect);

  void read_ahead();
  Result<std::optional<Ahead>> read_frame();
  Result<FrameTime> time_of(const Json& frame);
  double aspect_of(const Json& frame, const LandmarkHands& hands);
  void learn_unit();
  /// From `first` and the frames after it.
  void learn_hand(Handedness side, const Ahead& first);
  void learn_picture(Handedness side, const Ahead& first);
  void take_hand(Handedness side, const Ahead& ahead, RecordedFrame& frame);
  /// The points of a hand of this shape where the frame has it.
  Landmarks placed(Handedness side, const Landmarks& shape, const Ahead& ahead);

  FrameStream frames_;
  RecordingHeader header_;
  Warnings warnings_;
  HandIntake intake_{1e-3, HandIntake::Rotations::inferred};
  std::optional<double> file_aspect_;  ///< where the object around the frames has it
  std::size_t read_ = 0;
  bool timed_ = true;
  bool at_end_ = false;
  std::optional<Error> error_;  ///< behind the frames ahead
  std::deque<Ahead> ahead_;
  double unit_ns_ = 0.0;  ///< of times that do not say it; 0 until it is learnt
  std::array<std::optional<LandmarkBones>, 2> bones_{};
  std::optional<double> height_m_;  ///< of the picture, where the hands are
  std::optional<std::int64_t> last_time_ns_;
};

}  // namespace nade::io
