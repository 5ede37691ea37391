#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/recording_files.h"

namespace nade {
namespace {

using nlohmann::json;
using test::contains;
using test::read_whole;
using test::WholeRecording;

/// Made with IWER 2.5.0: six frames of its emulated Quest 3 hands, the left one away in frame 3.
const std::string kWebxrFile = NADE_TEST_DATA_DIR "/webxr_actions.json";

class WebxrImport : public test::RecordingFiles {
 protected:
  [[nodiscard]] static json stored() { return json::parse(test::read_file(kWebxrFile)); }
  [[nodiscard]] WholeRecording read(const json& recording) const {
    // The order of the members matters, and json sorts them.
    nlohmann::ordered_json ordered;
    ordered["schema"] = recording["schema"];
    ordered["frames"] = recording["frames"];
    return read_whole(given("in.json", ordered.dump()));
  }
};

TEST_F(WebxrImport, StoredFileLoads) {
  const WholeRecording whole = read_whole(kWebxrFile);
  EXPECT_EQ(whole.error, "");
  EXPECT_TRUE(whole.warnings.empty());
  EXPECT_EQ(whole.format, RecordingFormat::webxr_actions);
  EXPECT_EQ(whole.header.source, "webxr");
  ASSERT_EQ(whole.frames.size(), 6u);
  EXPECT_EQ(whole.frames[0].time_ns, 1'000'000'000);
  EXPECT_EQ(whole.frames[1].time_ns, 1'011'100'000);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(whole.frames[i].hands[0].has_value(), i != 3);
    EXPECT_TRUE(whole.frames[i].hands[1].has_value());
  }
}

TEST_F(WebxrImport, JointsAreWhereTheRuntimeHadThem) {
  // World poses the runtime gave at full precision when the stored file was made.
  struct Truth {
    std::size_t frame;
    Handedness side;
    Joint joint;
    Vec3 position;
    Vec3 back;
    Vec3 backwards;
    double radius;
  };
  const std::vector<Truth> truths{
      {5,
       Handedness::right,
       Joint::index_tip,
       {0.274819, 1.119496, -0.402397},
       {-0.544939, 0.824553, -0.152163},
       {0.553053, 0.489871, 0.673913},
       0.006636},
      {5,
       Handedness::left,
       Joint::thumb_tip,
       {-0.187997, 1.129070, -0.366778},
       {0.681244, -0.071042, 0.728601},
       {-0.730572, -0.002632, 0.682831},
       0.008769},
      {2,
       Handedness::right,
       Joint::wrist,
       {0.344808, 1.099832, -0.293956},
       {0.117387, 0.854221, 0.506484},
       {0.458995, -0.498936, 0.735110},
       0.021461},
      {4,
       Handedness::left,
       Joint::little_distal,
       {-0.318798, 1.174948, -0.407562},
       {-0.334832, 0.913029, 0.232948},
       {0.022927, -0.239250, 0.970687},
       0.006426},
  };
  const WholeRecording whole = read_whole(kWebxrFile);
  for (const Truth& truth : truths) {
    const HandPose& hand = whole.frames[truth.frame].hands[index_of(truth.side)]->pose;
    const Pose& joint = hand[truth.joint];
    // The file keeps three decimals of ray and joint.
    EXPECT_LT((joint.position - truth.position).norm(), 2e-3) << name_of(truth.joint);
    EXPECT_LT((joint.rotation * Vec3::UnitY() - truth.back).norm(), 4e-3);
    EXPECT_LT((joint.rotation * Vec3::UnitZ() - truth.backwards).norm(), 4e-3);
    EXPECT_NEAR(hand.radius[index_of(truth.joint)], truth.radius, 5.1e-4);
  }
}

TEST_F(WebxrImport, PalmIsTheMiddleOfTheMiddleMetacarpal) {
  for (const RecordedFrame& frame : read_whole(kWebxrFile).frames) {
    const HandPose& hand = frame.hands[1]->pose;
    const Vec3 middle =
        0.5 * (hand[Joint::middle_metacarpal].position + hand[Joint::middle_proximal].position);
    EXPECT_LT((hand[Joint::palm].position - middle).norm(), 1e-12);
    EXPECT_TRUE(is_usable(hand));
  }
}

TEST_F(WebxrImport, JointSequenceMayBeMissingOrInAnyOrder) {
  json recording = stored();
  const HandPose expected = read(recording).frames[0].hands[1]->pose;
  for (json& entry : recording["schema"]) entry[1].erase("jointSequence");
  EXPECT_EQ(read(recording).frames[0].hands[1]->pose[Joint::ring_tip].position,
            expected[Joint::ring_tip].position);

  recording = stored();
  auto& sequence = recording["schema"][1][1]["jointSequence"];
  std::swap(sequence[3], sequence[20]);
  const HandPose swapped = read(recording).frames[0].hands[1]->pose;
  const Joint third = joint_at(4);
  const Joint twentieth = joint_at(21);
  EXPECT_EQ(swapped[third].position, expected[twentieth].position);
  EXPECT_EQ(swapped[twentieth].position, expected[third].position);
}

TEST_F(WebxrImport, SourcesWithoutAHandAreIgnored) {
  json recording = stored();
  recording["schema"][0][1]["hasHand"] = false;
  for (json& frame : recording["frames"]) {
    for (std::size_t i = 8; i < frame.size(); ++i) {
      if (frame[i][0] == 0) frame[i].erase(9);
    }
  }
  const WholeRecording whole = read(recording);
  EXPECT_EQ(whole.error, "");
  for (const RecordedFrame& frame : whole.frames) {
    EXPECT_FALSE(frame.hands[0].has_value());
    EXPECT_TRUE(frame.hands[1].has_value());
  }
}

TEST_F(WebxrImport, BadInputIsNamed) {
  const auto error = [&](const std::function<void(json&)>& spoil) {
    json recording = stored();
    spoil(recording);
    return read(recording).error;
  };
  EXPECT_TRUE(contains(error([](json& r) { r["schema"][1][1]["jointSequence"][3] = "elbow"; }),
                       "schema[1]: jointSequence[3]: expected the name of a WebXR joint, found "
                       "\"elbow\""));
  EXPECT_TRUE(contains(error([](json& r) { r["schema"][1][1]["jointSequence"][3] = "wrist"; }),
                       "expected each joint once"));
  EXPECT_TRUE(contains(error([](json& r) { r["schema"][1][1]["jointSequence"].erase(3); }),
                       "expected 25 joint names"));
  EXPECT_TRUE(contains(error([](json& r) { r["frames"][2][8][9].erase(0); }),
                       "frames[2][8]: expected 200 numbers of a hand, found 199"));
  EXPECT_TRUE(contains(error([](json& r) { r["frames"][2][8][0] = 9; }),
                       "frames[2][8]: expected an index of the schema, found 9"));
  EXPECT_TRUE(contains(error([](json& r) { r["frames"][2][0] = "now"; }),
                       "frames[2]: expected a time in milliseconds"));
  EXPECT_TRUE(contains(error([](json& r) { r["frames"][2] = 5; }), "frames[2]: expected a time"));
  EXPECT_TRUE(contains(error([](json& r) { r["schema"] = 5; }), "schema: expected an array"));
}

TEST_F(WebxrImport, NothingMayFollowTheFrames) {
  const std::string text = test::read_file(kWebxrFile);
  EXPECT_TRUE(contains(read_whole(given("in.json", text + "xyz")).error,
                       "in.json: expected the file's end after the frames, found 'x'"));
}

TEST_F(WebxrImport, OddHandsAndTimesAreLeftOutAndCounted) {
  json recording = stored();
  recording["frames"][1][8][9][100] = nullptr;
  WholeRecording whole = read(recording);
  EXPECT_EQ(whole.error, "");
  EXPECT_FALSE(whole.frames[1].hands[0].has_value());
  EXPECT_TRUE(contains(whole.warning(), "frames[1]: left")) << whole.warning();

  recording = stored();
  recording["frames"][2][0] = recording["frames"][1][0];
  recording["frames"][4][0] = 0.5;
  whole = read(recording);
  EXPECT_EQ(whole.frames.size(), 4u);
  EXPECT_TRUE(contains(whole.warning(), "frames[2]: the time does not advance")) << whole.warning();
  EXPECT_TRUE(contains(whole.warning(), "and 1 more")) << whole.warning();
}

TEST_F(WebxrImport, CutOffFileIsReadToItsLastWholeFrame) {
  const std::string text = test::read_file(kWebxrFile);
  const WholeRecording whole = read_whole(given("cut.json", text.substr(0, text.size() - 500)));
  EXPECT_EQ(whole.error, "");
  EXPECT_EQ(whole.frames.size(), 5u);
  EXPECT_TRUE(contains(whole.warning(), "cut.json: frames[5]: cut off")) << whole.warning();
}

}  // namespace
}  // namespace nade
