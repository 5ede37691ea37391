#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "nade/corrector.h"
#include "nade/io/recording.h"

namespace nade::study {

/// The hands of one frame as they were tracked and as they were drawn.
struct MotionFrame {
  std::int64_t time_ns = 0;
  std::array<std::optional<HandPose>, 2> tracked{};         ///< by index_of(Handedness)
  std::array<std::optional<CorrectedHand>, 2> corrected{};  ///< of the same frame
  std::optional<Pose> head;
};

/// Where a motion is written, and how the two files begin. Neither file may be there.
struct MotionFiles {
  std::string tracked_path;
  std::string corrected_path;
  RecordingHeader tracked_header;
  RecordingHeader corrected_header;
};

/// Writes motions to pairs of recordings on a thread of its own, one after another. What is pushed
/// outlives the program less than a second later: of one that is killed the files can be read up to
/// there. Whole files are on disk. Positions are kept to 0.1 µm and turns to 1e-7.
class MotionRecorder {
 public:
  /// Room for so many frames that are not written yet, all of it taken at once; > 0.
  explicit MotionRecorder(std::size_t capacity = 1024);
  MotionRecorder(const MotionRecorder&) = delete;
  MotionRecorder& operator=(const MotionRecorder&) = delete;
  /// Writes what was pushed and ends.
  ~MotionRecorder();

  /// Begins another pair of files. Ends the one before.
  void begin(MotionFiles files);
  /// A frame of the motion that was begun last; its time is after the one before. Neither waits
  /// nor allocates: where the disk does not keep up the frame is left out and counted.
  void push(const MotionFrame& frame) noexcept;
  /// Ends the files; they are complete soon after.
  void end();
  /// Waits until everything is written.
  void drain();

  /// Frames that were left out so far.
  [[nodiscard]] std::size_t dropped() const noexcept;
  /// The first thing that could not be written, if any. Clears it.
  [[nodiscard]] std::optional<Error> take_failure();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nade::study
