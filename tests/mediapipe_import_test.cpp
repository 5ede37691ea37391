#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "support/recording_files.h"

namespace nade {
namespace {

using nlohmann::json;
using test::contains;
using test::read_whole;
using test::WholeRecording;

/// Two made-up hands in four frames, the left one away in the last two.
const std::string kMediapipeFile = NADE_TEST_DATA_DIR "/mediapipe_results.json";

constexpr double kLength_m = 0.092;
constexpr double kDepth_m = 0.5;
constexpr double kPictureHeight_m = 0.4;  // where the hands are
constexpr double kWidth = 640.0;
constexpr double kHeight = 480.0;

/// The joints that MediaPipe finds, in its order.
std::vector<Joint> landmark_joints() {
  std::vector<Joint> joints{Joint::wrist};
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const DigitJoints digit = joints_of(digit_at(d));
    for (std::size_t k = digit.count() - 4; k < digit.count(); ++k) {
      joints.push_back(joint_at(index_of(digit.metacarpal) + k));
    }
  }
  return joints;
}

/// A hand as long as the generic one, its palm's points on average at `place` of the picture's
/// plane.
HandPose hand_at(Handedness side, double bend, const Vec3& place, const Quat& turn) {
  HandAngles angles = test::relaxed_angles();
  for (DigitAngles& digit : angles) {
    for (HingeAngles& hinge : digit) hinge.flexion += bend;
  }
  HandPose hand = moved(test::sample_hand(side, angles), {Vec3::Zero(), turn});
  const double scale = kLength_m / hand_length(hand);
  for (Pose& joint : hand.joints) joint.position *= scale;
  Vec3 middle = Vec3::Zero();
  for (const Joint joint : {Joint::wrist, Joint::index_proximal, Joint::middle_proximal,
                            Joint::ring_proximal, Joint::little_proximal}) {
    middle += hand[joint].position / 5.0;
  }
  return moved(hand, {place - Vec3(0.0, 0.0, kDepth_m) - middle, Quat::Identity()});
}

/// Frame by frame the hand opens and closes, turns and goes across the picture.
HandPose moving_hand(Handedness side, std::size_t frame) {
  const double phase = 0.1 * static_cast<double>(frame);
  const double sign = side == Handedness::right ? 1.0 : -1.0;
  const Quat turn = Eigen::AngleAxisd(1.2 + 0.3 * std::sin(phase), Vec3::UnitX()) *
                    Eigen::AngleAxisd(sign * 0.4 * std::sin(1.7 * phase), Vec3::UnitZ());
  return hand_at(side, 0.3 + 0.3 * std::sin(phase),
                 {sign * 0.1 + 0.02 * std::cos(phase), 0.03 * std::sin(phase), 0.0}, turn);
}

struct Points {
  json picture;
  json world;
};

json point(const Vec3& at) { return {{"x", at.x()}, {"y", at.y()}, {"z", at.z()}}; }

/// What MediaPipe would give for a hand, had it no errors.
Points points_of(const HandPose& hand) {
  Points points;
  Vec3 middle = Vec3::Zero();
  for (const Joint joint : landmark_joints()) middle += hand[joint].position / 21.0;
  for (const Joint joint : landmark_joints()) {
    const Vec3& at = hand[joint].position;
    const Vec3 seen = (at - hand[Joint::wrist].position) / kPictureHeight_m * kHeight / kWidth;
    points.picture.push_back(point({0.5 + at.x() / kPictureHeight_m * kHeight / kWidth,
                                    0.5 - at.y() / kPictureHeight_m, -seen.z()}));
    // At another size than the hand's: MediaPipe guesses it.
    const Vec3 from_middle = 1.1 * (at - middle);
    points.world.push_back(point({from_middle.x(), -from_middle.y(), -from_middle.z()}));
  }
  return points;
}

const char* label_of(Handedness side) { return side == Handedness::left ? "Left" : "Right"; }

/// A result of HandLandmarker in JavaScript.
json result_of(const std::vector<HandPose>& hands, double time_ms) {
  json result{{"timestampMs", time_ms},
              {"width", kWidth},
              {"height", kHeight},
              {"landmarks", json::array()},
              {"worldLandmarks", json::array()},
              {"handedness", json::array()}};
  for (const HandPose& hand : hands) {
    const Points points = points_of(hand);
    result["landmarks"].push_back(points.picture);
    result["worldLandmarks"].push_back(points.world);
    result["handedness"].push_back({{{"score", 0.9},
                                     {"index", 0},
                                     {"categoryName", label_of(hand.side)},
                                     {"displayName", label_of(hand.side)}}});
  }
  return result;
}

json results(std::size_t frames) {
  json list = json::array();
  for (std::size_t i = 0; i < frames; ++i) {
    std::vector<HandPose> hands{moving_hand(Handedness::right, i)};
    if (i + 2 < frames) hands.push_back(moving_hand(Handedness::left, i));
    list.push_back(result_of(hands, 1000.0 + 33.0 * static_cast<double>(i)));
  }
  return list;
}

std::string as_lines(const json& list) {
  std::string text;
  for (const json& frame : list) text += frame.dump() + "\n";
  return text;
}

/// Without the warning of what every result lacks.
std::vector<std::string> other_warnings(const WholeRecording& whole) {
  std::vector<std::string> rest;
  for (const std::string& warning : whole.warnings) {
    if (!contains(warning, "does not measure how far")) rest.push_back(warning);
  }
  return rest;
}

double angle_deg(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) / kDegree;
}

class MediapipeImport : public test::RecordingFiles {
 protected:
  [[nodiscard]] WholeRecording read(const json& recording) const {
    return read_whole(given("in.json", recording.dump()));
  }
  /// The only other warning of a recording that can be read.
  [[nodiscard]] std::string warning_of(const json& recording) const {
    const WholeRecording whole = read(recording);
    EXPECT_EQ(whole.error, "");
    const std::vector<std::string> rest = other_warnings(whole);
    EXPECT_EQ(rest.size(), 1u) << recording.dump().substr(0, 300);
    return rest.empty() ? "" : rest[0];
  }
  /// Frames as `results` has them.
  static void expect_moving_hands(const WholeRecording& whole, std::size_t frames) {
    EXPECT_EQ(whole.error, "");
    EXPECT_EQ(whole.format, RecordingFormat::mediapipe_hands);
    ASSERT_EQ(whole.frames.size(), frames);
    for (std::size_t i = 0; i < frames; ++i) {
      EXPECT_EQ(whole.frames[i].hands[0].has_value(), i + 2 < frames);
      for (const Handedness side : {Handedness::left, Handedness::right}) {
        if (!whole.frames[i].hands[index_of(side)]) continue;
        const HandPose expected = moving_hand(side, i);
        const HandPose& found = whole.frames[i].hands[index_of(side)]->pose;
        for (const Joint joint : landmark_joints()) {
          EXPECT_LT((found[joint].position - expected[joint].position).norm(), 1e-3)
              << name_of(joint) << " in frame " << i;
        }
      }
    }
  }
};

TEST_F(MediapipeImport, StoredFileLoads) {
  const WholeRecording whole = read_whole(kMediapipeFile);
  expect_moving_hands(whole, 4);
  ASSERT_EQ(whole.frames.size(), 4u);
  EXPECT_TRUE(other_warnings(whole).empty()) << other_warnings(whole)[0];
  EXPECT_EQ(whole.header.source, "mediapipe");
  EXPECT_FALSE(whole.header.hand_scale_known);
  EXPECT_EQ(whole.frames[0].time_ns, 1'000'000'000);
  EXPECT_EQ(whole.frames[1].time_ns, 1'033'000'000);
  EXPECT_DOUBLE_EQ(whole.frames[0].hands[0]->pose.confidence, 0.9);
}

TEST_F(MediapipeImport, WhatIsGuessedIsSaid) {
  EXPECT_TRUE(contains(read_whole(kMediapipeFile).warning(),
                       "mediapipe_results.json: MediaPipe does not measure how far a hand is from "
                       "the camera, nor how large: it is put 0.5 m away and made as long as the "
                       "generic hand, 92 mm from wrist to middle knuckle"));
  json recording = results(5);
  for (json& frame : recording) frame.erase("width");
  EXPECT_TRUE(contains(warning_of(recording),
                       "in.json: frames[0]: no width and height of the picture; it is taken to be "
                       "4 to 3 (and 4 more like it)"));
  expect_moving_hands(read(recording), 5);
}

TEST_F(MediapipeImport, RotationsAreThoseOfTheBones) {
  const WholeRecording whole = read(results(60));
  double most_bone_deg = 0.0;
  double most_back_deg = 0.0;
  for (std::size_t i = 0; i < whole.frames.size(); ++i) {
    for (const Handedness side : {Handedness::left, Handedness::right}) {
      if (!whole.frames[i].hands[index_of(side)]) continue;
      const HandPose expected = moving_hand(side, i);
      const HandPose& found = whole.frames[i].hands[index_of(side)]->pose;
      for (const Joint joint : landmark_joints()) {
        if (joint == Joint::wrist) continue;
        const Quat& turn = expected[joint].rotation;
        most_bone_deg = std::max(
            most_bone_deg, angle_deg(found[joint].rotation * Vec3::UnitZ(), turn * Vec3::UnitZ()));
        if (joint < Joint::index_metacarpal) continue;
        most_back_deg = std::max(
            most_back_deg, angle_deg(found[joint].rotation * Vec3::UnitY(), turn * Vec3::UnitY()));
      }
      most_back_deg = std::max(most_back_deg, angle_deg(found.back(), expected.back()));
    }
  }
  EXPECT_LT(most_bone_deg, 1.0);
  EXPECT_LT(most_back_deg, 20.0);
}

TEST_F(MediapipeImport, BonesDoNotBreathe) {
  json recording = results(300);
  // What a tracker guesses of the size changes from frame to frame, and no point is exact.
  std::mt19937 random(5);
  std::uniform_real_distribution<double> size(0.8, 1.2);
  std::normal_distribution<double> error(0.0, 0.002);
  for (json& frame : recording) {
    for (json& hand : frame["worldLandmarks"]) {
      const double scale = size(random);
      for (json& landmark : hand) {
        for (json& value : landmark) value = scale * (value.get<double>() + error(random));
      }
    }
  }
  const WholeRecording whole = read(recording);
  ASSERT_EQ(whole.frames.size(), 300u);
  const HandPose& first = whole.frames[0].hands[1]->pose;
  EXPECT_NEAR(hand_length(first), kLength_m, 1e-9);
  for (const RecordedFrame& frame : whole.frames) {
    const HandPose& hand = frame.hands[1]->pose;
    EXPECT_NEAR(hand_length(hand), kLength_m, 1e-9);
    for (std::size_t d = 0; d < kDigitCount; ++d) {
      for (std::size_t h = 0; h < kHingeCount; ++h) {
        const auto length = [&](const HandPose& pose) {
          return (pose[hinge_joint(digit_at(d), h + 1)].position -
                  pose[hinge_joint(digit_at(d), h)].position)
              .norm();
        };
        EXPECT_NEAR(length(hand), length(first), 1e-9);
        EXPECT_NEAR(length(hand), length(moving_hand(Handedness::right, 0)), 2e-3);
      }
    }
  }
}

/// Each way that results are written down in.
TEST_F(MediapipeImport, EverySpelling) {
  const json list = results(8);
  const auto rewritten = [&](const std::function<json(const json&)>& rewrite) {
    json frames = json::array();
    for (const json& frame : list) frames.push_back(rewrite(frame));
    return frames;
  };
  const auto renamed = [&](const char* picture, const char* world, const char* sides) {
    return rewritten([&](const json& frame) {
      return json{{"timestamp_ms", frame["timestampMs"]},
                  {"imageWidth", kWidth},
                  {"imageHeight", kHeight},
                  {picture, frame["landmarks"]},
                  {world, frame["worldLandmarks"]},
                  {sides, frame["handedness"]}};
    });
  };
  json python = renamed("hand_landmarks", "hand_world_landmarks", "handedness");
  for (json& frame : python) {
    for (json& side : frame["handedness"]) {
      side[0] = {{"index", 0}, {"score", 0.9}, {"category_name", side[0]["categoryName"]}};
    }
  }
  json solution = renamed("multiHandLandmarks", "multiHandWorldLandmarks", "multiHandedness");
  for (json& frame : solution) {
    for (json& side : frame["multiHandedness"]) {
      side = {{"index", 0}, {"score", 0.9}, {"label", side[0]["categoryName"]}};
    }
  }
  json buffers = renamed("multi_hand_landmarks", "multi_hand_world_landmarks", "multi_handedness");
  for (json& frame : buffers) {
    for (const char* key : {"multi_hand_landmarks", "multi_hand_world_landmarks"}) {
      for (json& hand : frame[key]) hand = json{{"landmark", hand}};
    }
    for (json& side : frame["multi_handedness"]) {
      side = {{"classification", {{{"label", side[0]["categoryName"]}, {"score", 0.9}}}}};
    }
  }
  json arrays = list;
  for (json& frame : arrays) {
    for (const char* key : {"landmarks", "worldLandmarks"}) {
      for (json& hand : frame[key]) {
        for (json& landmark : hand) landmark = {landmark["x"], landmark["y"], landmark["z"]};
      }
    }
  }
  const json by_hand = rewritten([](const json& frame) {
    json hands = json::array();
    for (std::size_t i = 0; i < frame["landmarks"].size(); ++i) {
      hands.push_back({{"handedness", frame["handedness"][i][0]["categoryName"]},
                       {"landmarks", frame["landmarks"][i]},
                       {"worldLandmarks", frame["worldLandmarks"][i]}});
    }
    return json{{"timestampMs", frame["timestampMs"]},
                {"width", kWidth},
                {"height", kHeight},
                {"hands", hands}};
  });
  const json around{{"camera", "front"}, {"frames", list}};
  json sized{{"an_image_of", 1}, {"frames", list}};
  for (json& frame : sized["frames"]) frame.erase("height");
  sized["a"] = 1;
  for (const json& form : {list, python, solution, buffers, arrays, by_hand, around}) {
    expect_moving_hands(read(form), 8);
    EXPECT_TRUE(other_warnings(read(form)).empty()) << form.dump().substr(0, 200);
    const json& frames = form.is_array() ? form : form["frames"];
    const std::string lines = as_lines(frames);
    expect_moving_hands(read_whole(given("in.jsonl", lines)), 8);
  }
  // json sorts its members: "frames" comes before "width".
  std::string text = R"({"width":640,"height":480,"frames":)" + sized["frames"].dump() + "}";
  const WholeRecording whole = read_whole(given("in.json", text));
  expect_moving_hands(whole, 8);
  EXPECT_TRUE(other_warnings(whole).empty());
}

TEST_F(MediapipeImport, OnlyTheOneOrTheOtherPoints) {
  json recording = results(5);
  for (json& frame : recording) frame.erase("worldLandmarks");
  EXPECT_TRUE(contains(warning_of(recording), "frames[0]: left: no world landmarks"));
  expect_moving_hands(read(recording), 5);

  recording = results(5);
  for (json& frame : recording) frame.erase("landmarks");
  EXPECT_TRUE(contains(warning_of(recording), "frames[0]: left: no landmarks in the picture"));
  const HandPose hand = read(recording).frames[4].hands[1]->pose;
  const Vec3 shift =
      hand[Joint::wrist].position - moving_hand(Handedness::right, 4)[Joint::wrist].position;
  for (const Joint joint : landmark_joints()) {
    EXPECT_LT(
        (hand[joint].position - shift - moving_hand(Handedness::right, 4)[joint].position).norm(),
        1e-3);
  }
}

TEST_F(MediapipeImport, UnitsOfTime) {
  struct Case {
    const char* key;
    double per_ms;
  };
  for (const Case& unit : std::vector<Case>{{"timestamp", 1.0},
                                            {"timestamp", 1e-3},
                                            {"timestamp", 1e3},
                                            {"time", 1e6},
                                            {"time", 1e-3},
                                            {"t", 1.0},
                                            {"time_ms", 1.0},
                                            {"time_s", 1e-3},
                                            {"timestamp_us", 1e3},
                                            {"timestampNs", 1e6}}) {
    json recording = results(6);
    for (json& frame : recording) {
      frame[unit.key] = unit.per_ms * frame["timestampMs"].get<double>();
      frame.erase("timestampMs");
    }
    const WholeRecording whole = read(recording);
    expect_moving_hands(whole, 6);
    EXPECT_TRUE(other_warnings(whole).empty());
    EXPECT_EQ(whole.frames[5].time_ns, 1'165'000'000) << unit.key << unit.per_ms;
  }
}

TEST_F(MediapipeImport, WithoutTimesThirtyFramesASecond) {
  json recording = results(6);
  for (json& frame : recording) frame.erase("timestampMs");
  EXPECT_TRUE(contains(warning_of(recording), "in.json: frames[0]: no time"));
  const WholeRecording whole = read(recording);
  expect_moving_hands(whole, 6);
  EXPECT_EQ(whole.frames[3].time_ns, 100'000'000);
}

TEST_F(MediapipeImport, AHandThatIsNotWholeIsLeftOut) {
  json recording = results(5);
  recording[1]["worldLandmarks"][0][7]["z"] = nullptr;
  recording[2]["landmarks"][0][7].erase("x");
  recording[3]["worldLandmarks"][0] = nullptr;
  const WholeRecording whole = read(recording);
  EXPECT_EQ(whole.error, "");
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(whole.frames[i].hands[1].has_value(), i == 0 || i == 4);
  }
  EXPECT_TRUE(contains(warning_of(recording),
                       "frames[1]: hand 0: right: a point is missing or not finite; the hand is "
                       "left out of the frame (and 2 more like it)"));

  std::string text = results(2).dump();
  const std::size_t at = text.find("\"x\":") + 4;
  text.replace(at, text.find(',', at) - at, "NaN");
  EXPECT_TRUE(contains(other_warnings(read_whole(given("in.json", text))).at(0), "not finite"));

  recording = results(5);
  for (json& landmark : recording[1]["worldLandmarks"][0]) landmark = {0.0, 0.0, 0.0};
  EXPECT_TRUE(contains(warning_of(recording), "wrist and middle knuckle lie in one point"));
}

TEST_F(MediapipeImport, TwoHandsOfOneSide) {
  json recording = results(5);
  recording[1]["handedness"][1][0]["categoryName"] = "Right";
  recording[1]["handedness"][1][0]["score"] = 0.4;
  EXPECT_TRUE(contains(warning_of(recording), "frames[1]: two right hands"));
  EXPECT_DOUBLE_EQ(read(recording).frames[1].hands[1]->pose.confidence, 0.9);
}

TEST_F(MediapipeImport, WrongSidesAreDoubted) {
  json recording = results(5);
  for (json& frame : recording) {
    for (json& side : frame["handedness"]) {
      side[0]["categoryName"] = side[0]["categoryName"] == "Left" ? "Right" : "Left";
    }
  }
  const WholeRecording whole = read(recording);
  EXPECT_EQ(whole.error, "");
  const std::vector<std::string> doubts = other_warnings(whole);
  ASSERT_EQ(doubts.size(), 2u);
  EXPECT_TRUE(contains(doubts[0], "left hand") && contains(doubts[0], "the other side"))
      << doubts[0];
}

TEST_F(MediapipeImport, TimesThatGoBackAreLeftOut) {
  json recording = results(6);
  recording[2]["timestampMs"] = 5.0;
  EXPECT_TRUE(contains(warning_of(recording), "frames[2]: the time does not advance"));
  EXPECT_EQ(read(recording).frames.size(), 5u);
}

TEST_F(MediapipeImport, BadInputIsNamed) {
  const auto error = [&](const std::function<void(json&)>& spoil) {
    json recording = results(5);
    spoil(recording);
    const WholeRecording whole = read(recording);
    // What stood before it is read.
    EXPECT_EQ(whole.frames.size(), 2u);
    return whole.error;
  };
  EXPECT_EQ(error([](json& r) { r[2]["landmarks"][1].erase(20); }),
            path("in.json") + ": frames[2]: hand 1: expected 21 points of a hand, found 20");
  EXPECT_TRUE(contains(error([](json& r) { r[2]["handedness"][0][0]["categoryName"] = "Third"; }),
                       "frames[2]: hand 0: expected the hand's side, \"Left\" or \"Right\", found "
                       "\"Third\""));
  EXPECT_TRUE(contains(error([](json& r) { r[2].erase("handedness"); }), "found none"));
  EXPECT_TRUE(contains(error([](json& r) { r[2]["worldLandmarks"].erase(1); }),
                       "frames[2]: expected as many hands in the picture as in the world, found 2 "
                       "and 1"));
  EXPECT_TRUE(contains(error([](json& r) { r[2].erase("timestampMs"); }),
                       "frames[2]: expected a time, as the frames before have, found none"));
  EXPECT_TRUE(contains(error([](json& r) { r[2]["timestampMs"] = "now"; }),
                       "frames[2]: timestampMs: expected a time, found a string"));
  EXPECT_TRUE(contains(error([](json& r) { r[2]["timestampMs"] = 1e300; }),
                       "frames[2]: expected a time within 126 years of 0"));
  EXPECT_TRUE(contains(error([](json& r) { r[2] = 5; }),
                       "frames[2]: expected a result of MediaPipe, found a number"));
  EXPECT_TRUE(contains(error([](json& r) { r[2]["landmarks"] = "none"; }),
                       "frames[2]: expected as many hands"));
  EXPECT_TRUE(contains(error([](json& r) {
                         json deep = 1;
                         for (int i = 0; i < 70; ++i) deep = json::array({deep});
                         r[2]["deep"] = deep;
                       }),
                       "frames[2]: expected values nested at most 64 deep"));
}

TEST_F(MediapipeImport, CutOffFileIsReadToItsLastWholeFrame) {
  const std::string text = results(5).dump();
  WholeRecording whole = read_whole(given("cut.json", text.substr(0, text.size() - 900)));
  EXPECT_EQ(whole.error, "");
  EXPECT_EQ(whole.frames.size(), 4u);
  EXPECT_TRUE(contains(other_warnings(whole).at(0), "cut.json: frames[4]: cut off here"));

  const std::string lines = as_lines(results(5));
  whole = read_whole(given("cut.jsonl", lines.substr(0, lines.size() - 900)));
  EXPECT_EQ(whole.frames.size(), 4u);
  EXPECT_TRUE(contains(other_warnings(whole).at(0), "cut.jsonl: line 5: cut off here"));
  EXPECT_TRUE(contains(read_whole(given("in.jsonl", lines + "{\"timestampMs\":}\n")).error,
                       "in.jsonl: line 6: column"));
}

TEST_F(MediapipeImport, FramesWithoutHands) {
  json recording = results(3);
  recording[1] = {{"timestampMs", 1040.0}};
  const json none{{"timestampMs", 0.0}, {"landmarks", json::array()}, {"handedness", nullptr}};
  recording.insert(recording.begin(), none);
  const WholeRecording whole = read(recording);
  EXPECT_EQ(whole.error, "");
  ASSERT_EQ(whole.frames.size(), 4u);
  EXPECT_FALSE(whole.frames[0].hands[0] || whole.frames[0].hands[1]);
  EXPECT_TRUE(whole.frames[1].hands[1].has_value());
  EXPECT_FALSE(whole.frames[2].hands[1].has_value());
}

TEST_F(MediapipeImport, OtherJsonIsNotTakenForIt) {
  for (const char* text : {R"([{"timestamp":0,"keypoints":[]}])", R"({"faceLandmarks":[[]]})"}) {
    EXPECT_NE(read_whole(given("in.json", text)).error, "") << text;
  }
}

}  // namespace
}  // namespace nade
