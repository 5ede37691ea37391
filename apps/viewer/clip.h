#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nade/eval/press.h"
#include "nade/hand.h"
#include "nade/io/recording.h"
#include "nade/status.h"

namespace nade::viewer {

/// The hands of one frame of a recording, in the order of Handedness.
struct ClipFrame {
  std::int64_t time_ns = 0;
  std::array<std::optional<HandPose>, 2> hands{};
};

/// A recording that can be shown from any frame on. It is read once, in the background, into an
/// unnamed file of frames of one size, so that memory stays small however long it is.
class Clip {
 public:
  /// Starts reading. The error names the file and what was expected.
  [[nodiscard]] static Result<Clip> open(const std::string& path);
  Clip(Clip&&) noexcept;
  Clip& operator=(Clip&&) noexcept;
  ~Clip();

  [[nodiscard]] const std::string& path() const;
  [[nodiscard]] const RecordingHeader& header() const;

  /// Whether everything is read, or reading has failed.
  [[nodiscard]] bool complete() const;
  void wait() const;
  /// Why reading stopped before the end, if it did, once complete; the frames before it count.
  [[nodiscard]] std::optional<Error> failure() const;
  /// What was odd about the file, once complete.
  [[nodiscard]] std::vector<std::string> warnings() const;

  /// The recording's time at its first frame, once complete.
  [[nodiscard]] std::int64_t start_ns() const;
  /// How many frames have been read so far.
  [[nodiscard]] std::size_t size() const;
  /// Of frame `index` < size(), since the first.
  [[nodiscard]] std::int64_t time_ns(std::size_t index) const;
  /// The last frame at or before a time since the first, 0 where there is none.
  [[nodiscard]] std::size_t index_at(std::int64_t time_ns) const;
  /// Frame `index` < size(). No hands where the frame cannot be read back.
  [[nodiscard]] ClipFrame frame(std::size_t index) const;

  /// Where the palms were, once complete.
  [[nodiscard]] const PalmTrack& palms() const;

 private:
  struct Impl;
  explicit Clip(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace nade::viewer
