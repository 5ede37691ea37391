#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <string>

#include "support/hand_checks.h"
#include "support/recording_files.h"

namespace nade {
namespace {

using test::contains;
using test::read_whole;
using test::WholeRecording;

/// How a logger spells a column.
struct Spelling {
  std::string time;
  std::function<std::string(Joint, const std::string&)> joint;
};

std::string squeezed(const std::string& name, bool capitals) {
  std::string result;
  bool starts = true;
  for (const char c : name) {
    if (c == '_') {
      starts = true;
      continue;
    }
    result += capitals && starts ? static_cast<char>(std::toupper(c)) : c;
    starts = false;
  }
  return result;
}

std::string number(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

class CsvImport : public test::RecordingFiles {
 protected:
  /// One hand, three frames 20 ms apart, in a logger's spelling.
  [[nodiscard]] std::string table(const Spelling& spelling, const HandPose& hand,
                                  const std::vector<std::string>& times) const {
    std::string text = spelling.time;
    for (std::size_t i = 0; i < kJointCount; ++i) {
      for (const char* part : {"px", "py", "pz", "qx", "qy", "qz", "qw"}) {
        text += "," + spelling.joint(joint_at(i), part);
      }
    }
    for (const std::string& time : times) {
      text += "\n" + time;
      for (const Pose& joint : hand.joints) {
        for (Eigen::Index k = 0; k < 3; ++k) text += "," + number(joint.position[k]);
        for (Eigen::Index k = 0; k < 4; ++k) text += "," + number(joint.rotation.coeffs()[k]);
      }
    }
    return text + "\n";
  }
};

TEST_F(CsvImport, ATableOfOursComesBackBitForBit) {
  std::mt19937 random(3);
  std::vector<RecordedFrame> frames;
  for (const char* name : {"out.csv", "out.csv.gz"}) {
    Result<RecordingWriter> writer = RecordingWriter::create(path(name), {"test", "", true, ""});
    ASSERT_TRUE(writer.ok());
    frames.clear();
    for (int i = 0; i < 20; ++i) {
      RecordedFrame frame;
      frame.time_ns = 4'611'686'018'427'387'904 / 2 + i * 11'111'111LL;
      if (i % 3 != 0) frame.hands[0] = test::random_hand(Handedness::left, random);
      if (i % 3 != 1) frame.hands[1] = test::random_hand(Handedness::right, random);
      if (frame.hands[1]) {
        frame.hands[1]->status = HandStatus::corrected;
        frame.hands[1]->contact[2] = RecordedContact{{1, 2, 3}, Vec3::UnitY(), 0.02};
      }
      ASSERT_TRUE(writer->write(frame).ok());
      frames.push_back(frame);
    }
    ASSERT_TRUE(writer->finish().ok());
    const WholeRecording whole = read_whole(path(name));
    EXPECT_EQ(whole.error, "");
    EXPECT_TRUE(whole.warnings.empty()) << whole.warning();
    EXPECT_EQ(whole.format, RecordingFormat::joint_table);
    ASSERT_EQ(whole.frames.size(), frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
      EXPECT_EQ(whole.frames[i].time_ns, frames[i].time_ns);
      for (std::size_t side = 0; side < 2; ++side) {
        const auto& read = whole.frames[i].hands[side];
        const auto& written = frames[i].hands[side];
        ASSERT_EQ(read.has_value(), written.has_value());
        if (!read) continue;
        EXPECT_TRUE(test::same_bits(read->pose, written->pose));
        EXPECT_EQ(read->pose.radius, written->pose.radius);
        EXPECT_EQ(read->pose.confidence, written->pose.confidence);
      }
    }
  }
}

TEST_F(CsvImport, SpellingsOfLoggers) {
  const auto plain = [](Joint joint) { return std::string(name_of(joint)); };
  const auto upper = [&](Joint joint) {
    std::string name = plain(joint);
    for (char& c : name) c = static_cast<char>(std::toupper(c));
    return name;
  };
  const std::vector<Spelling> spellings{
      {"timestamp",
       [&](Joint j, const std::string& part) {
         return "XR_HAND_JOINT_" + upper(j) + "_EXT_" + (part[0] == 'p' ? "pos_" : "rot_") +
                part[1];
       }},
      {"Time",
       [&](Joint j, const std::string& part) {
         return "Right" + squeezed(plain(j), true) + (part[0] == 'p' ? "Position" : "Rotation") +
                static_cast<char>(std::toupper(part[1]));
       }},
      {"Timestamp",
       [&](Joint j, const std::string& part) {
         return "XRHandJointID." + squeezed(plain(j), true) +
                (part[0] == 'p' ? ".position." : ".rotation.") + part[1];
       }},
      {"time_s",
       [&](Joint j, const std::string& part) {
         std::string name = plain(j);
         if (name.starts_with("little")) name.replace(0, 6, "pinky-finger");
         return "right." + name + (part[0] == 'p' ? "." : ".q") + part[1];
       }},
      {"\"t\"", [&](Joint j, const std::string& part) {
         return "\"r_" + squeezed(plain(j), false) + "_" + part + "\"";
       }}};
  const HandPose hand = test::sample_hand();
  for (const Spelling& spelling : spellings) {
    const WholeRecording whole =
        read_whole(given("right_hand.csv", table(spelling, hand, {"0.5", "0.52", "0.54"})));
    EXPECT_EQ(whole.error, "");
    EXPECT_TRUE(whole.warnings.empty()) << whole.warning();
    ASSERT_EQ(whole.frames.size(), 3U) << spelling.time;
    EXPECT_EQ(whole.frames[1].time_ns, 520'000'000);
    ASSERT_TRUE(whole.frames[1].hands[1].has_value());
    EXPECT_FALSE(whole.frames[1].hands[0].has_value());
    EXPECT_LT((whole.frames[1].hands[1]->pose[Joint::little_tip].position -
               hand[Joint::little_tip].position)
                  .norm(),
              1e-12);
  }
}

TEST_F(CsvImport, SemicolonsAndRowsOfNoHandAreTaken) {
  const Spelling spelling{"time_ms", [](Joint j, const std::string& part) {
                            return "left_" + std::string(name_of(j)) + "_" + part;
                          }};
  std::string text = table(spelling, test::sample_hand(Handedness::left), {"0", "20", "40"});
  std::size_t second = text.find("\n20,") + 4;
  const std::size_t end = text.find('\n', second);
  text.replace(second, end - second, std::string(7 * kJointCount - 1, ','));
  std::replace(text.begin(), text.end(), ',', ';');
  const WholeRecording whole = read_whole(given("in.csv", text));
  EXPECT_EQ(whole.error, "");
  EXPECT_TRUE(whole.warnings.empty()) << whole.warning();
  ASSERT_EQ(whole.frames.size(), 3U);
  EXPECT_TRUE(whole.frames[0].hands[0].has_value());
  EXPECT_FALSE(whole.frames[1].hands[0].has_value());
  EXPECT_EQ(whole.frames[2].time_ns, 40'000'000);
}

TEST_F(CsvImport, WhatIsMissingOrWrongIsNamed) {
  const Spelling unsided{"time_ns", [](Joint j, const std::string& part) {
                           return std::string(name_of(j)) + "_" + part;
                         }};
  const std::string text = table(unsided, test::sample_hand(), {"0", "20000000"});
  const auto error = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    const std::size_t at = changed.find(from);
    changed.replace(at, from.size(), to);
    return read_whole(given("right.csv", changed)).error;
  };
  EXPECT_EQ(error("time_ns", "time_ns"), "");
  EXPECT_TRUE(contains(error("time_ns", "frame"), "right.csv: line 1: expected a column of times"));
  EXPECT_TRUE(contains(error("ring_tip_qw", "ring_tip_speed"), "expected a column 'ring_tip_qw'"));
  EXPECT_TRUE(contains(error("\n20000000,", "\n20000000,1,"),
                       "right.csv: line 3: expected 183 columns, found 184"));
  EXPECT_TRUE(contains(error("\n20000000,", "\nsoon,"), "line 3: expected a time, found 'soon'"));
  EXPECT_TRUE(
      contains(error("\n20000000,", "\n20000000,x"), "line 3: column 2: expected a number"));
  EXPECT_TRUE(contains(read_whole(given("hand.csv", text)).error,
                       "expected a column 'hand', or left and right in the names of columns"));
}

}  // namespace
}  // namespace nade
