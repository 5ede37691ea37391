#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "mcap_file.h"
#include "nade/io/recording.h"
#include "nade/status.h"

namespace nade::io {

/// Whether a file's name says that it holds a log of messages: ".mcap".
[[nodiscard]] bool names_a_log(const std::string& path);

/// A recording as messages for Foxglove and what else reads MCAP (docs/formats.md).
class McapRecording {
 public:
  explicit McapRecording(const RecordingHeader& header);

  /// The error where the time is before 0, which the file cannot have.
  [[nodiscard]] Status add(const RecordedFrame& frame);
  void finish() { file_.finish(); }
  /// What is to be written next.
  [[nodiscard]] std::string take() { return file_.take(); }

 private:
  struct Channels {
    std::uint16_t joints = 0;
    std::uint16_t state = 0;
    std::uint16_t contacts = 0;
  };

  McapFile file_;
  std::array<Channels, 2> channels_;  ///< by index_of(Handedness)
  std::uint16_t head_ = 0;
};

}  // namespace nade::io
