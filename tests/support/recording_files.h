#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "nade/io/recording.h"
#include "support/files.h"
#include "support/scratch_folder.h"

namespace nade::test {

/// Tests that write files, each in an empty folder of its own.
class RecordingFiles : public FolderTest {
 protected:
  [[nodiscard]] std::string given(const std::string& name, const std::string& content) const {
    write_file(path(name), content);
    return path(name);
  }
  [[nodiscard]] std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder())) {
      names.push_back(entry.path().filename().string());
    }
    return names;
  }
};

/// All of a recording, and how reading it ended.
struct WholeRecording {
  RecordingFormat format = RecordingFormat::nade;
  RecordingHeader header;
  std::vector<RecordedFrame> frames;
  std::vector<std::string> warnings;
  std::string error;  ///< empty where there was none

  [[nodiscard]] std::string warning() const {
    return warnings.size() == 1 ? warnings[0] : std::to_string(warnings.size()) + " warnings";
  }
};

inline WholeRecording read_whole(const std::string& path) {
  WholeRecording whole;
  Result<RecordingReader> reader = RecordingReader::open(path);
  if (!reader) {
    whole.error = reader.error().message;
    return whole;
  }
  whole.format = reader->format();
  whole.header = reader->header();
  while (true) {
    Result<std::optional<RecordedFrame>> frame = reader->next();
    if (!frame) {
      whole.error = frame.error().message;
      break;
    }
    if (!*frame) break;
    whole.frames.push_back(**frame);
  }
  whole.warnings = reader->warnings();
  return whole;
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace nade::test
