#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "support/recording_files.h"

namespace nade {
namespace {

using nlohmann::json;
using test::contains;
using test::read_whole;
using test::WholeRecording;

/// Four frames of a made-up hand: none, the right, both, the left.
const std::string kLeapFile = NADE_TEST_DATA_DIR "/leap_v2.json";
const std::vector<std::string> kClips{"HandSplay-110fps", "confidence-74fps", "pinch",
                                      "rollAndPitchCropped"};

std::string clip_path(const std::string& clip) {
  return std::string(NADE_TEST_SHARED_DATA) + "/leap/" + clip + ".json";
}
bool have_clips() { return std::filesystem::exists(clip_path(kClips[0])); }

class LeapImport : public test::RecordingFiles {
 protected:
  [[nodiscard]] static json stored() { return json::parse(test::read_file(kLeapFile)); }
  [[nodiscard]] WholeRecording read(const json& recording) const {
    return read_whole(given("in.json", recording.dump()));
  }
};

/// What every imported hand must be.
void expect_sound(const HandPose& hand) {
  ASSERT_TRUE(is_usable(hand));
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const DigitJoints digit = joints_of(digit_at(d));
    for (std::size_t k = 0; k + 1 < digit.count(); ++k) {
      const std::size_t i = index_of(digit.metacarpal) + k;
      const Vec3 bone = (hand.joints[i + 1].position - hand.joints[i].position).normalized();
      const Eigen::Matrix3d axes = hand.joints[i].rotation.toRotationMatrix();
      EXPECT_NEAR(axes.determinant(), 1.0, 1e-9);
      EXPECT_GT(-axes.col(2).dot(bone), 0.999999) << name_of(joint_at(i));
    }
  }
  // The back of a straight metacarpal is the back of the hand.
  for (const Joint joint : {Joint::index_metacarpal, Joint::middle_metacarpal,
                            Joint::ring_metacarpal, Joint::little_metacarpal}) {
    EXPECT_GT((hand[joint].rotation * Vec3::UnitY()).dot(hand.back()), 0.85) << name_of(joint);
  }
}

/// A hand seen from its own palm.
HandPose from_palm(const HandPose& hand) { return moved(hand, hand[Joint::palm].inverse()); }

TEST_F(LeapImport, StoredFileLoads) {
  const WholeRecording whole = read_whole(kLeapFile);
  EXPECT_EQ(whole.error, "");
  EXPECT_TRUE(whole.warnings.empty());
  EXPECT_EQ(whole.format, RecordingFormat::leap_v2);
  EXPECT_EQ(whole.header.source, "leap");
  EXPECT_TRUE(whole.header.hand_scale_known);
  ASSERT_EQ(whole.frames.size(), 4u);
  EXPECT_FALSE(whole.frames[0].hands[0] || whole.frames[0].hands[1]);
  EXPECT_TRUE(!whole.frames[1].hands[0] && whole.frames[1].hands[1]);
  EXPECT_TRUE(whole.frames[2].hands[0] && whole.frames[2].hands[1]);
  EXPECT_EQ(whole.frames[1].time_ns, 5'009'000'000);
  for (const RecordedFrame& frame : whole.frames) {
    for (const auto& hand : frame.hands) {
      if (hand) expect_sound(hand->pose);
    }
  }
}

TEST_F(LeapImport, MeasuredJointsStayWhereTheyWere) {
  const json raw = stored();
  const HandPose hand = read_whole(kLeapFile).frames[1].hands[1]->pose;
  EXPECT_DOUBLE_EQ(hand.confidence, 0.9);
  for (const json& pointable : raw["frames"][1]["pointables"]) {
    const auto digit = pointable["type"].get<std::size_t>();
    const DigitJoints joints = joints_of(digit_at(digit));
    const std::size_t first = index_of(joints.metacarpal) + (digit == 0 ? 0 : 1);
    std::size_t k = 0;
    for (const char* key : {"mcpPosition", "pipPosition", "dipPosition", "tipPosition"}) {
      const json& p = pointable[key];
      const Vec3 expected(1e-3 * p[0].get<double>(), 1e-3 * p[1].get<double>(),
                          1e-3 * p[2].get<double>());
      EXPECT_LT((hand.joints[first + k++].position - expected).norm(), 1e-12);
    }
  }
  EXPECT_LT((hand.back() - Vec3::UnitY()).norm(), 1e-12);
}

TEST_F(LeapImport, LeftIsTheMirrorOfRight) {
  const WholeRecording whole = read_whole(kLeapFile);
  const HandPose left = from_palm(whole.frames[2].hands[0]->pose);
  const HandPose right = mirrored(from_palm(whole.frames[2].hands[1]->pose));
  for (std::size_t i = 0; i < kJointCount; ++i) {
    EXPECT_LT((left.joints[i].position - right.joints[i].position).norm(), 1e-6);
    EXPECT_LT(left.joints[i].rotation.angularDistance(right.joints[i].rotation), 1e-4);
  }
}

TEST_F(LeapImport, WristLiesBehindTheKnucklesAsInAHand) {
  const HandPose hand = from_palm(read_whole(kLeapFile).frames[1].hands[1]->pose);
  EXPECT_GT(hand_length(hand), 0.085);
  EXPECT_LT(hand_length(hand), 0.105);
  EXPECT_GT(hand[Joint::wrist].position.z(), hand[Joint::thumb_metacarpal].position.z());
  for (const Joint knuckle : {Joint::index_proximal, Joint::middle_proximal, Joint::ring_proximal,
                              Joint::little_proximal}) {
    const Joint base = joint_at(index_of(knuckle) - 1);
    const double bone_m = (hand[knuckle].position - hand[base].position).norm();
    EXPECT_GT(bone_m, 0.040) << name_of(base);
    EXPECT_LT(bone_m, 0.072) << name_of(base);
  }
}

TEST_F(LeapImport, BentFingersTurnAboutTheirHinge) {
  const HandPose hand = read_whole(kLeapFile).frames[1].hands[1]->pose;
  for (std::size_t d = 1; d < kDigitCount; ++d) {
    const std::size_t first = index_of(joints_of(digit_at(d)).metacarpal) + 1;
    const Vec3 hinge = hand.joints[first].rotation * Vec3::UnitX();
    for (std::size_t k = 1; k < 4; ++k) {
      EXPECT_GT((hand.joints[first + k].rotation * Vec3::UnitX()).dot(hinge), 0.95);
      // Flexed: the back turns forward.
      EXPECT_LE((hand.joints[first + k].rotation * Vec3::UnitY()).dot(hand.back()),
                (hand.joints[first + k - 1].rotation * Vec3::UnitY()).dot(hand.back()) + 1e-9);
    }
  }
}

TEST_F(LeapImport, TurnAboutABoneIsContinuousThroughStraight) {
  // One finger, bent from 20 degrees backwards to 100 degrees forwards at each hinge.
  json recording = stored();
  const json frame = recording["frames"][1];
  recording["frames"] = json::array();
  const double step = 0.5;
  for (double degrees = -20.0; degrees <= 100.0; degrees += step) {
    json bent = frame;
    bent["timestamp"] = 1000000 + static_cast<std::int64_t>(1000.0 * (degrees + 20.0));
    for (json& pointable : bent["pointables"]) {
      if (pointable["type"] != 2) continue;
      std::array<double, 3> at = pointable["mcpPosition"];
      double angle = 0.0;
      for (const auto& [key, length] : std::map<int, double>{{0, 44.6}, {1, 26.3}, {2, 17.4}}) {
        if (key > 0) angle += degrees * 3.14159265358979 / 180.0;
        at[1] -= length * std::sin(angle);
        at[2] -= length * std::cos(angle);
        pointable[key == 0 ? "pipPosition" : key == 1 ? "dipPosition" : "tipPosition"] = at;
      }
    }
    recording["frames"].push_back(bent);
  }
  const WholeRecording whole = read(recording);
  ASSERT_EQ(whole.error, "");
  ASSERT_GT(whole.frames.size(), 200u);
  double most_deg = 0.0;
  for (std::size_t i = 1; i < whole.frames.size(); ++i) {
    for (const Joint joint : {Joint::middle_proximal, Joint::middle_intermediate,
                              Joint::middle_distal, Joint::middle_tip}) {
      most_deg =
          std::max(most_deg, 180.0 / 3.14159265358979 *
                                 whole.frames[i].hands[1]->pose[joint].rotation.angularDistance(
                                     whole.frames[i - 1].hands[1]->pose[joint].rotation));
    }
  }
  EXPECT_LT(most_deg, 2.5 * step);
}

TEST_F(LeapImport, TopLevelArrayIsRead) {
  EXPECT_EQ(read(stored()["frames"]).frames.size(), 4u);
  const std::string pretty = stored().dump(2);
  EXPECT_EQ(read_whole(given("pretty.json", pretty)).frames.size(), 4u);
}

TEST_F(LeapImport, OddFramesAndHandsAreLeftOutAndCounted) {
  json recording = stored();
  recording["frames"][2]["timestamp"] = recording["frames"][1]["timestamp"];
  WholeRecording whole = read(recording);
  EXPECT_EQ(whole.error, "");
  EXPECT_EQ(whole.frames.size(), 3u);
  EXPECT_TRUE(contains(whole.warning(), "frames[2]: the time does not advance"));

  recording = stored();
  recording["frames"][1]["pointables"].erase(3);
  recording["frames"][2]["pointables"][0]["tipPosition"][1] = nullptr;
  whole = read(recording);
  EXPECT_EQ(whole.error, "");
  EXPECT_FALSE(whole.frames[1].hands[1] || whole.frames[2].hands[1]);
  EXPECT_TRUE(contains(whole.warning(), "frames[1]: right: one of the five fingers is missing"));
  EXPECT_TRUE(contains(whole.warning(), "and 1 more"));

  recording = stored();
  recording["frames"][1]["hands"][0]["direction"] = {0, 0, 0};
  whole = read(recording);
  EXPECT_FALSE(whole.frames[1].hands[1].has_value());
  EXPECT_TRUE(contains(whole.warning(), "frames[1]: right")) << whole.warning();

  recording = stored();
  recording["frames"][2]["hands"][1]["type"] = "right";
  whole = read(recording);
  EXPECT_TRUE(contains(whole.warning(), "frames[2]: two right hands")) << whole.warning();
  EXPECT_DOUBLE_EQ(whole.frames[2].hands[1]->pose.confidence, 0.9);
}

TEST_F(LeapImport, BadInputIsNamed) {
  json recording = stored();
  recording["frames"][1].erase("timestamp");
  EXPECT_TRUE(contains(read(recording).error, "in.json: frames[1]: timestamp: expected a time"));
  recording = stored();
  recording["frames"][1]["hands"][0]["type"] = "third";
  EXPECT_TRUE(contains(read(recording).error, "frames[1]: hands[0]: type: expected \"left\""));
  recording["frames"][1] = 5;
  EXPECT_TRUE(contains(read(recording).error, "frames[1]: expected a frame, found a number"));
  EXPECT_TRUE(contains(
      read_whole(given("in.json", R"({"frames":[{"timestamp":1,"hands":[]},nonsense]})")).error,
      "frames[1]: column 2: expected valid JSON"));
  EXPECT_TRUE(
      contains(read_whole(given("in.json", R"({"metadata":{},"frames":[{"times)")).warning(),
               "frames[0]: cut off"));
}

TEST_F(LeapImport, OtherFramesAreRefused) {
  EXPECT_TRUE(contains(read_whole(given("in.json", R"([{"timestamp":0,"pose":[]}])")).error,
                       "in.json: frames[0]: expected the \"hands\" of a raw LeapJS frame"));
}

TEST_F(LeapImport, NothingMayFollowTheFrames) {
  const std::string text = stored().dump();
  const auto error = [&](const std::string& whole) {
    return read_whole(given("in.json", whole)).error;
  };
  EXPECT_EQ(error(text + " \n"), "");
  EXPECT_TRUE(contains(error(text + "\n" + text),
                       "in.json: expected the file's end after the frames, found '{'"));
  EXPECT_TRUE(contains(error(stored()["frames"].dump() + "xyz"), "file's end after the frames"));
  EXPECT_TRUE(contains(error(R"({"frames":[{"timestamp":1,"hands":[]}]xyz})"),
                       "in.json: expected the object's end after the frames, found 'x'"));
  EXPECT_TRUE(contains(error(R"({"frames":[{"timestamp":1,"hands":[]}],"frames":[]})"),
                       "in.json: expected one array \"frames\", found a second"));
  const WholeRecording cut =
      read_whole(given("in.json", R"({"frames":[{"timestamp":1,"hands":[]}],"a":)"));
  EXPECT_TRUE(contains(cut.warning(), "in.json: cut off after the frames")) << cut.error;
}

TEST_F(LeapImport, CutOffFileIsReadToItsLastWholeFrame) {
  const std::string text = test::read_file(kLeapFile);
  const WholeRecording whole = read_whole(given("cut.json", text.substr(0, text.size() - 900)));
  EXPECT_EQ(whole.error, "");
  EXPECT_EQ(whole.frames.size(), 3u);
  EXPECT_TRUE(contains(whole.warning(), "cut.json: frames[3]: cut off")) << whole.warning();
}

TEST_F(LeapImport, RealClipsImportEveryFrame) {
  if (!have_clips()) GTEST_SKIP() << "no recordings in " << NADE_TEST_SHARED_DATA;
  for (const std::string& clip : kClips) {
    const json raw = json::parse(test::read_file(clip_path(clip)));
    const WholeRecording whole = read_whole(clip_path(clip));
    EXPECT_EQ(whole.error, "");
    EXPECT_TRUE(whole.warnings.empty()) << clip;
    ASSERT_EQ(whole.frames.size(), raw["frames"].size()) << clip;
    for (std::size_t i = 0; i < whole.frames.size(); ++i) {
      std::size_t hands = 0;
      for (const auto& hand : whole.frames[i].hands) {
        if (!hand) continue;
        ++hands;
        expect_sound(hand->pose);
      }
      ASSERT_EQ(hands, raw["frames"][i]["hands"].size()) << clip << " frame " << i;
    }
  }
}

TEST_F(LeapImport, RealHandsKeepTheirBonesAndWrist) {
  if (!have_clips()) GTEST_SKIP() << "no recordings in " << NADE_TEST_SHARED_DATA;
  // One tracked hand each: where the device takes up a hand anew it may give it another size.
  for (const char* clip : {"HandSplay-110fps", "pinch", "rollAndPitchCropped"}) {
    const WholeRecording whole = read_whole(clip_path(clip));
    const HandPose first = from_palm(whole.frames[0].hands[1]->pose);
    for (const RecordedFrame& frame : whole.frames) {
      const HandPose hand = from_palm(frame.hands[1]->pose);
      EXPECT_LT((hand[Joint::wrist].position - first[Joint::wrist].position).norm(), 1e-5);
      for (std::size_t d = 0; d < kDigitCount; ++d) {
        const DigitJoints digit = joints_of(digit_at(d));
        for (std::size_t i = index_of(digit.metacarpal); i < index_of(digit.tip); ++i) {
          const auto length = [&](const HandPose& pose) {
            return (pose.joints[i + 1].position - pose.joints[i].position).norm();
          };
          EXPECT_NEAR(length(hand), length(first), 1e-5);
        }
      }
    }
  }
}

TEST_F(LeapImport, RealWristIsHardlyLessStillThanThePalm) {
  if (!have_clips()) GTEST_SKIP() << "no recordings in " << NADE_TEST_SHARED_DATA;
  for (const char* clip : {"HandSplay-110fps", "pinch", "rollAndPitchCropped"}) {
    const WholeRecording whole = read_whole(clip_path(clip));
    const auto jitter_m = [&](Joint joint) {
      double sum = 0.0;
      for (std::size_t i = 1; i + 1 < whole.frames.size(); ++i) {
        const auto at = [&](std::size_t k) {
          return whole.frames[k].hands[1]->pose[joint].position;
        };
        sum += (at(i + 1) - 2.0 * at(i) + at(i - 1)).squaredNorm();
      }
      return std::sqrt(sum / static_cast<double>(whole.frames.size() - 2));
    };
    EXPECT_LT(jitter_m(Joint::wrist), 1.5 * jitter_m(Joint::palm)) << clip;
  }
}

}  // namespace
}  // namespace nade
