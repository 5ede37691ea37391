#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nade/eval/metrics.h"
#include "nade/hand.h"
#include "nade/io/recording.h"
#include "nade/status.h"

namespace nade {

/// What two recordings that belong together show.
struct PairMetrics {
  double hand_scale = 1.0;
  Metrics both;
  std::array<std::optional<Metrics>, 2> hands{};  ///< by index_of(Handedness); those seen
  std::vector<std::string> warnings;              ///< what was odd but not fatal, a sentence each
};

/// A recording and its corrected form, read side by side and measured in memory that does not grow
/// with their length.
class RecordingPair {
 public:
  /// `tracked_name` is what messages call the tracked recording. Reads the tracked recording once:
  /// one hand size for the whole of it. The error names the file.
  [[nodiscard]] static Result<RecordingPair> open(const std::string& tracked_path,
                                                  const std::string& tracked_name,
                                                  const std::string& corrected_path);
  RecordingPair(RecordingPair&&) noexcept;
  RecordingPair& operator=(RecordingPair&&) noexcept;
  ~RecordingPair();

  /// Names the method, the object and where it stood.
  [[nodiscard]] const RecordingHeader& corrected_header() const;
  /// Frames of the tracked recording.
  [[nodiscard]] std::size_t frames() const;

  /// Pairs the frames by their times and measures them against the object. `before_frame`, where it
  /// is given, is called with the time of each tracked frame before it is measured, so that the
  /// object may move. Once. Recordings of which fewer than half of the frames pair are refused.
  [[nodiscard]] Result<PairMetrics> measure(
      const Object& object, const std::function<void(std::int64_t time_ns)>& before_frame = {});

 private:
  struct Impl;
  explicit RecordingPair(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// The method that a corrected recording's header names; empty where it names none.
[[nodiscard]] std::string method_of(const RecordingHeader& header);

}  // namespace nade
