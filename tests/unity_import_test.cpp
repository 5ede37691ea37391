#include <gtest/gtest.h>

#include <bit>
#include <string>

#include "nade/hand_check.h"
#include "support/hand_checks.h"
#include "support/recording_files.h"

namespace nade {
namespace {

using test::contains;
using test::read_whole;
using test::WholeRecording;

void append_int(std::string& bytes, std::uint32_t number) {
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(number >> (8 * i));
}

void append_float(std::string& bytes, double number) {
  append_int(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(number)));
}

/// As Unity's XR Hand Capture writes it: +Z is forward, the wrist stands before the palm.
void append_hand(std::string& bytes, const HandPose& hand) {
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const Pose& joint = hand.joints[i < 2 ? 1 - i : i];
    for (const double number :
         {joint.position.x(), joint.position.y(), -joint.position.z(), -joint.rotation.x(),
          -joint.rotation.y(), joint.rotation.z(), joint.rotation.w()}) {
      append_float(bytes, number);
    }
  }
}

std::string header(std::uint32_t version, const std::string& name, std::uint32_t frames) {
  std::string bytes;
  append_int(bytes, version);
  bytes += static_cast<char>(name.size());
  bytes += name;
  append_float(bytes, 1.5);
  append_int(bytes, frames);
  return bytes;
}

HandPose hand_of(Handedness side) {
  return test::placed_hand(test::sample_hand(side), {0.1, 1.2, -0.3},
                           Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized())));
}

/// The right hand in each frame, the left in the first.
std::string frames(std::uint32_t count) {
  std::string bytes;
  for (std::uint32_t i = 0; i < count; ++i) {
    append_float(bytes, 0.0125 * i);
    bytes += std::string(i == 0 ? "\1\1\1\1" : "\0\1\0\1", 4);
    if (i == 0) append_hand(bytes, hand_of(Handedness::left));
    append_hand(bytes, hand_of(Handedness::right));
  }
  return bytes;
}

class UnityImport : public test::RecordingFiles {
 protected:
  [[nodiscard]] WholeRecording read(const std::string& bytes) const {
    return read_whole(given("take.handsbin", bytes));
  }
};

TEST_F(UnityImport, HandsComeInOurAxes) {
  const WholeRecording whole = read(header(1, "Wave", 3) + frames(3));
  EXPECT_EQ(whole.error, "");
  EXPECT_TRUE(whole.warnings.empty()) << whole.warning();
  EXPECT_EQ(whole.format, RecordingFormat::unity_hands);
  ASSERT_EQ(whole.frames.size(), 3U);
  EXPECT_EQ(whole.frames[2].time_ns, 25'000'000);
  EXPECT_FALSE(whole.frames[1].hands[0].has_value());
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    const auto& hand = whole.frames[0].hands[index_of(side)];
    ASSERT_TRUE(hand.has_value());
    const HandPose expected = hand_of(side);
    for (std::size_t j = 0; j < kJointCount; ++j) {
      EXPECT_LT((hand->pose.joints[j].position - expected.joints[j].position).norm(), 1e-6);
      EXPECT_LT(hand->pose.joints[j].rotation.angularDistance(expected.joints[j].rotation), 1e-5);
    }
    EXPECT_EQ(check_hand(hand->pose).cause, std::nullopt);
  }
}

TEST_F(UnityImport, CutOffOrLonger) {
  const std::string whole = header(1, "Wave", 3) + frames(3);
  for (const std::size_t left_out : {1U, 700U, 730U}) {
    const WholeRecording cut = read(whole.substr(0, whole.size() - left_out));
    EXPECT_EQ(cut.error, "");
    EXPECT_EQ(cut.frames.size(), 2U);
    EXPECT_TRUE(contains(cut.warning(), "frame 3: cut off here")) << cut.warning();
  }
  EXPECT_TRUE(contains(read(whole + "x").error, "expected the file's end after 3 frames"));
  EXPECT_TRUE(contains(read(header(1, "Wave", 3).substr(0, 7)).error, "the recording's name"));
  const WholeRecording huge = read(header(1, "Wave", 0xFFFFFFFFU) + frames(1));
  EXPECT_EQ(huge.frames.size(), 1U);
}

TEST_F(UnityImport, OtherVersionsSayWhatToDo) {
  EXPECT_TRUE(contains(read(header(2, "Wave", 3) + frames(3)).error,
                       "take.handsbin: expected version 1 of a Unity hand recording, found version "
                       "2; write its joints as a table instead"));
}

TEST_F(UnityImport, AnAssetOfTheEditorIsNamed) {
  EXPECT_TRUE(contains(read("%YAML 1.1\n%TAG !u! tag:unity3d.com,2011:\n--- !u!114\n").error,
                       "an asset of Unity's editor; take the .handsbin that it was made of"));
}

TEST_F(UnityImport, WrongBytes) {
  std::string flag = header(1, "Wave", 1) + frames(1);
  flag[header(1, "Wave", 1).size() + 5] = '\7';
  EXPECT_TRUE(contains(read(flag).error, "frame 1: expected 0 or 1 for whether a hand is there"));
  std::string time = header(1, "Wave", 1);
  append_int(time, 0x7FC00000U);
  EXPECT_TRUE(contains(read(time).error, "frame 1: expected a time in seconds, found nan"));
  std::string joint = header(1, "Wave", 1) + frames(1);
  joint.replace(header(1, "Wave", 1).size() + 8, 4, std::string("\0\0\xC0\x7F", 4));
  const WholeRecording whole = read(joint);
  EXPECT_EQ(whole.error, "");
  ASSERT_EQ(whole.frames.size(), 1U);
  EXPECT_FALSE(whole.frames[0].hands[0].has_value());
  EXPECT_TRUE(whole.frames[0].hands[1].has_value());
}

}  // namespace
}  // namespace nade
