// Recordings as LeapJS Playback keeps them: packed into rows, and packed by LZString.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "support/lz_string.h"
#include "support/recording_files.h"

namespace nade {
namespace {

using nlohmann::json;
using test::contains;
using test::LzString;
using test::read_whole;
using test::WholeRecording;

const std::string kPlaybackFile = NADE_TEST_DATA_DIR "/leap_v2.json";

/// As LeapJS Playback 0.2 writes them.
const json kKeys = json::parse(R"([
  "id", "timestamp",
  {"hands": [["id", "type", "direction", "palmNormal", "palmPosition", "palmVelocity",
              "stabilizedPalmPosition", "pinchStrength", "grabStrength", "confidence"]]},
  {"pointables": [["id", "direction", "handId", "length", "stabilizedTipPosition", "tipPosition",
                   "tipVelocity", "tool", "carpPosition", "mcpPosition", "pipPosition",
                   "dipPosition", "btipPosition", "bases"]]},
  {"interactionBox": ["center", "size"]}])");

json row_of(const json& keys, const json& value) {
  json row = json::array();
  if (keys.front().is_array()) {
    for (const json& element : value) row.push_back(row_of(keys.front(), element));
    return row;
  }
  for (const json& key : keys) {
    const std::string name = key.is_string() ? key.get<std::string>() : key.begin().key();
    const json member = value.contains(name) ? value[name] : json();
    row.push_back(key.is_string() || member.is_null() ? member : row_of(key.front(), member));
  }
  return row;
}

class LeapPlayback : public test::RecordingFiles {
 protected:
  /// The stored recording, packed into rows.
  [[nodiscard]] static json rows() {
    json result = json::parse(test::read_file(kPlaybackFile));
    json rows = json::array({kKeys});
    for (const json& frame : result["frames"]) rows.push_back(row_of(kKeys, frame));
    // The metadata come first there.
    return {{"frames", rows}, {"a_metadata", {{"formatVersion", 2}}}};
  }
  [[nodiscard]] WholeRecording read(const std::string& content) const {
    return read_whole(given("in.json.lz", content));
  }
};

void expect_as_stored(const WholeRecording& found) {
  const WholeRecording stored = read_whole(kPlaybackFile);
  ASSERT_EQ(found.error, "");
  EXPECT_EQ(found.format, RecordingFormat::leap_v2);
  EXPECT_EQ(found.warnings, stored.warnings);
  ASSERT_EQ(found.frames.size(), stored.frames.size());
  for (std::size_t i = 0; i < stored.frames.size(); ++i) {
    EXPECT_EQ(found.frames[i].time_ns, stored.frames[i].time_ns);
    for (std::size_t side = 0; side < 2; ++side) {
      const auto& hand = stored.frames[i].hands[side];
      ASSERT_EQ(found.frames[i].hands[side].has_value(), hand.has_value());
      if (!hand) continue;
      EXPECT_EQ(found.frames[i].hands[side]->pose.joints, hand->pose.joints);
      EXPECT_EQ(found.frames[i].hands[side]->pose.confidence, hand->pose.confidence);
    }
  }
}

TEST_F(LeapPlayback, RowsAreReadAsFrames) { expect_as_stored(read(rows().dump())); }

TEST_F(LeapPlayback, WhatLzStringHasPackedIsRead) {
  expect_as_stored(read(LzString::packed(rows().dump())));
  expect_as_stored(read(LzString::packed(test::read_file(kPlaybackFile))));
}

TEST_F(LeapPlayback, LinesAndSpacesBetweenLettersAreForgiven) {
  std::string packed = LzString::packed(rows().dump());
  for (std::size_t at = 76; at < packed.size(); at += 78) packed.insert(at, "\r\n");
  expect_as_stored(read(packed + "\n"));
}

TEST_F(LeapPlayback, DataMayEndAtAnyBit) {
  const std::string frames = rows().dump();
  for (std::size_t lines = 0; lines < 30; ++lines) {
    expect_as_stored(read(LzString::packed(frames + std::string(lines, '\n'))));
  }
}

TEST_F(LeapPlayback, AnyFormMayBePackedByLzString) {
  // Letters of one, two and three bytes, and a pair of surrogates.
  const std::u16string header =
      u"{\"format\":\"nade-recording\",\"version\":1,\"source\":\"a\u00e9\u64ab\U0001F590\"}\n";
  EXPECT_EQ(read(LzString::packed(header)).header.source, "a\u00e9\u64ab\U0001F590");
}

TEST_F(LeapPlayback, WhatTheLibraryItselfPacks) {
  // By lz-string 1.5.0.
  const WholeRecording whole = read(
      "N4IgZg9gTgtghgFxALhAOzgEwKYForYDG0mAlmgOYgA0IAbtlAM6kRooCMtTEArlIWwoQAGwBeuJgijkKAAkDVJo"
      "HMGEAF8AUEA=");
  EXPECT_EQ(whole.error, "");
  EXPECT_EQ(whole.header.source, "lz-string 撫で");
}

TEST_F(LeapPlayback, DamagedDataAreRefused) {
  std::string packed = LzString::packed(rows().dump());
  packed[packed.size() / 2] = '!';
  EXPECT_EQ(read(packed).error,
            path("in.json.lz") + ": expected whole LZString data, found them damaged");
  EXPECT_TRUE(contains(read(LzString::packed(rows().dump()) + "BBBB").error, "damaged"));
}

TEST_F(LeapPlayback, CutOffDataAreReadUpToThere) {
  const std::string packed = LzString::packed(rows().dump());
  const WholeRecording whole = read(packed.substr(0, packed.size() * 9 / 10));
  EXPECT_EQ(whole.error, "");
  EXPECT_FALSE(whole.frames.empty());
  ASSERT_EQ(whole.warnings.size(), 1U);
  EXPECT_TRUE(contains(whole.warnings[0], "cut off"));
}

TEST_F(LeapPlayback, DataThatUnpackToFarMoreAreRefused) {
  // 72 MB of spaces behind the frames.
  EXPECT_TRUE(contains(read(LzString::packed("{\"frames\":[]", 12000)).error,
                       "more than 200 times their size"));
}

TEST_F(LeapPlayback, ARowThatIsNoneIsAnErrorThatNamesIt) {
  json recording = rows();
  recording["frames"][2] = 5;
  EXPECT_EQ(read(recording.dump()).error,
            path("in.json.lz") + ": frames[2]: expected a frame, found a number");
  recording["frames"][2] = json::array({1, 2});
  EXPECT_TRUE(contains(read(recording.dump()).error, "frames[2]: expected the \"hands\""));
}

}  // namespace
}  // namespace nade
