#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <string>
#include <vector>

#include "nade/io/recording.h"
#include "support/files.h"
#include "support/sample_hand.h"
#include "support/scratch_folder.h"

namespace nade::test {

/// A hand somewhere, bent somehow.
inline RecordedHand random_hand(Handedness side, std::mt19937& random) {
  std::uniform_real_distribution<double> coordinate(-0.1, 0.1);
  const auto vector = [&] {
    return Vec3(coordinate(random), coordinate(random), coordinate(random));
  };
  HandAngles angles = relaxed_angles();
  for (DigitAngles& digit : angles) {
    for (HingeAngles& hinge : digit) hinge.flexion += coordinate(random);
  }
  RecordedHand hand;
  const Quat turn(Eigen::AngleAxisd(20.0 * coordinate(random), vector().normalized()));
  hand.pose = placed_hand(sample_hand(side, angles), vector(), turn);
  for (double& radius : hand.pose.radius) radius = 0.01 + 0.05 * coordinate(random);
  hand.pose.confidence = 0.5 + coordinate(random);
  return hand;
}

/// Tests that write files, each in an empty folder of its own.
class RecordingFiles : public FolderTest {
 protected:
  [[nodiscard]] std::string given(const std::string& name, const std::string& content) const {
    write_file(path(name), content);
    return path(name);
  }
  /// A recording of random right hands, 30 a second.
  void write_random(const std::string& name, std::size_t frames) const {
    std::mt19937 random(7);
    Result<RecordingWriter> writer = RecordingWriter::create(path(name), {"test", "", true, ""});
    ASSERT_TRUE(writer.ok()) << writer.error().message;
    for (std::size_t i = 0; i < frames; ++i) {
      RecordedFrame frame;
      frame.time_ns = static_cast<std::int64_t>(i) * 33333333;
      frame.hands[1] = random_hand(Handedness::right, random);
      ASSERT_TRUE(writer->write(frame).ok());
    }
    ASSERT_TRUE(writer->finish().ok());
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
