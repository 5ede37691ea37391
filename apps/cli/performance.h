#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nade/corrector.h"
#include "nade/draw/stage.h"
#include "nade/eval/press.h"
#include "nade/io/recording.h"
#include "nade/status.h"
#include "object_options.h"

namespace nade::cli {

/// Where the hands of one frame were: what cameras are aimed by. Means where there are two.
struct Glimpse {
  std::int64_t time_ns = 0;
  Vec3 center = Vec3::Zero();  ///< the palm
  Vec3 wrist = Vec3::Zero();
  Vec3 knuckle = Vec3::Zero();  ///< of the middle finger
  PalmSkin palms{};
};

/// A recording seen once from end to end, in memory that does not grow with its length.
struct Survey {
  std::size_t frames = 0;
  std::int64_t first_ns = 0;
  std::int64_t last_ns = 0;
  std::array<double, 2> scale{1.0, 1.0};  ///< median, of each side's skin against its mesh
  PalmTrack palms;
  std::vector<Glimpse> glimpses;  ///< of frames with a hand, evenly thinned
};
[[nodiscard]] Result<Survey> survey(const std::string& path, const draw::HandMeshes& meshes);

/// The time at which a palm lies deepest in the object: of equally deep ones the middle. The
/// recording's first hand where none touches; no value without any hand.
[[nodiscard]] std::optional<std::int64_t> deepest_press(const Survey& survey, const Object& object);

/// The time of the frame of this number, from 0; no value where there are not so many.
[[nodiscard]] Result<std::optional<std::int64_t>> time_of_frame(const std::string& path,
                                                                std::size_t frame);

/// One frame to be shown.
struct Moment {
  std::int64_t time_ns = 0;
  draw::StagedHands hands{};
};

/// What is played: a tracked recording, corrected on the way or in a recording of its own; or a
/// corrected one alone.
struct Performance {
  std::string recording;
  std::optional<std::string> corrected;
  CorrectorOptions method;  ///< none where the recording is itself corrected
  std::array<double, 2> scale{1.0, 1.0};
  Method drawn = Method::none;  ///< by which the hands are corrected, or were
};

/// Plays a performance, one frame after another.
class MomentReader {
 public:
  /// `placed` must outlive the reader, which moves it on to the time of each frame.
  [[nodiscard]] static Result<MomentReader> open(const Performance& performance,
                                                 PlacedObject& placed);
  /// No value at the end.
  [[nodiscard]] Result<std::optional<Moment>> next();

 private:
  MomentReader(const Performance& performance, PlacedObject& placed, RecordingReader tracked);
  [[nodiscard]] Status find_partner(std::int64_t time_ns);

  Performance performance_;
  PlacedObject* placed_;
  RecordingReader tracked_;
  std::optional<RecordingReader> corrected_;
  std::optional<RecordedFrame> partner_;  ///< the corrected frame at or after the last time
  std::array<HandCorrector, 2> correctors_;
};

/// A performance at any times, in between its frames too.
class MomentSampler {
 public:
  explicit MomentSampler(MomentReader reader) : reader_(std::move(reader)) {}

  /// Times must not decrease. Between two frames joints move straight from one to the other; over
  /// a gap of more than 0.2 s the hand waits that long and is gone.
  [[nodiscard]] Result<Moment> at(std::int64_t time_ns);

 private:
  MomentReader reader_;
  bool started_ = false;
  std::optional<Moment> before_;
  std::optional<Moment> after_;
};

}  // namespace nade::cli
