#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

#include "support/recording_files.h"

namespace nade {
namespace {

using nlohmann::json;
using test::contains;
using test::read_whole;
using test::WholeRecording;

/// Two made-up hands in three frames, the left one away in the last.
const std::string kDumpFile = NADE_TEST_DATA_DIR "/webxr_joints.json";

/// The 25 joints in WebXR's order.
const std::vector<std::string> kNames{"wrist",
                                      "thumb-metacarpal",
                                      "thumb-phalanx-proximal",
                                      "thumb-phalanx-distal",
                                      "thumb-tip",
                                      "index-finger-metacarpal",
                                      "index-finger-phalanx-proximal",
                                      "index-finger-phalanx-intermediate",
                                      "index-finger-phalanx-distal",
                                      "index-finger-tip",
                                      "middle-finger-metacarpal",
                                      "middle-finger-phalanx-proximal",
                                      "middle-finger-phalanx-intermediate",
                                      "middle-finger-phalanx-distal",
                                      "middle-finger-tip",
                                      "ring-finger-metacarpal",
                                      "ring-finger-phalanx-proximal",
                                      "ring-finger-phalanx-intermediate",
                                      "ring-finger-phalanx-distal",
                                      "ring-finger-tip",
                                      "pinky-finger-metacarpal",
                                      "pinky-finger-phalanx-proximal",
                                      "pinky-finger-phalanx-intermediate",
                                      "pinky-finger-phalanx-distal",
                                      "pinky-finger-tip"};

HandPose hand_in(Handedness side, std::size_t frame) {
  const double phase = 0.3 * static_cast<double>(frame);
  HandPose hand = test::placed_hand(test::sample_hand(side), {0.1 + 0.01 * phase, 1.2, -0.3},
                                    Quat(Eigen::AngleAxisd(phase, Vec3::UnitY())));
  hand[Joint::palm] = palm_from_middle_metacarpal(hand);
  hand.radius.fill(0.01);
  return hand;
}

json xyzw(const Quat& q) { return {{"x", q.x()}, {"y", q.y()}, {"z", q.z()}, {"w", q.w()}}; }
json xyz(const Vec3& p) { return {{"x", p.x()}, {"y", p.y()}, {"z", p.z()}}; }

using JointSpelling = std::function<json(const Pose&)>;

/// As XRJointPose has it.
json transform_of(const Pose& joint) {
  return {{"transform", {{"position", xyz(joint.position)}, {"orientation", xyzw(joint.rotation)}}},
          {"radius", 0.01}};
}

json by_name(const HandPose& hand, const JointSpelling& spelling = transform_of) {
  json joints = json::object();
  for (std::size_t i = 0; i < kNames.size(); ++i) joints[kNames[i]] = spelling(hand.joints[i + 1]);
  return joints;
}

std::vector<double> column_by_column(const Pose& joint) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = joint.rotation.toRotationMatrix();
  matrix.topRightCorner<3, 1>() = joint.position;
  return {matrix.data(), matrix.data() + matrix.size()};
}

/// As XRFrame.fillPoses and fillJointRadii fill their arrays.
json filled(const HandPose& hand) {
  json matrices = json::array();
  for (std::size_t i = 1; i < kJointCount; ++i) {
    for (const double number : column_by_column(hand.joints[i])) matrices.push_back(number);
  }
  return {{"matrices", matrices}, {"radii", std::vector<double>(25, 0.01)}};
}

/// What JSON.stringify makes of a Float32Array.
json stringified(const json& array) {
  json object = json::object();
  for (std::size_t i = 0; i < array.size(); ++i) object[std::to_string(i)] = array[i];
  return object;
}

/// Three frames 11 ms apart, the left hand away in the last.
json frames_of(const std::function<json(const HandPose&)>& write) {
  json frames = json::array();
  for (std::size_t i = 0; i < 3; ++i) {
    frames.push_back({{"time", 500.0 + 11.0 * static_cast<double>(i)},
                      {"left", i == 2 ? json() : write(hand_in(Handedness::left, i))},
                      {"right", write(hand_in(Handedness::right, i))}});
  }
  return frames;
}
json frames_by_name() {
  return frames_of([](const HandPose& hand) { return by_name(hand); });
}

class WebxrDumpImport : public test::RecordingFiles {
 protected:
  [[nodiscard]] WholeRecording read(const json& recording) const {
    return read_whole(given("in.json", recording.dump()));
  }
  static void expect_frames(const WholeRecording& whole, double within) {
    EXPECT_EQ(whole.error, "");
    EXPECT_TRUE(whole.warnings.empty()) << whole.warning();
    EXPECT_EQ(whole.format, RecordingFormat::webxr_joints);
    ASSERT_EQ(whole.frames.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(whole.frames[i].time_ns, 500'000'000 + 11'000'000 * static_cast<std::int64_t>(i));
      EXPECT_EQ(whole.frames[i].hands[0].has_value(), i != 2);
      for (const Handedness side : {Handedness::left, Handedness::right}) {
        if (!whole.frames[i].hands[index_of(side)]) continue;
        const HandPose expected = hand_in(side, i);
        const HandPose& found = whole.frames[i].hands[index_of(side)]->pose;
        for (std::size_t j = 0; j < kJointCount; ++j) {
          EXPECT_LT((found.joints[j].position - expected.joints[j].position).norm(), within);
          EXPECT_LT(found.joints[j].rotation.angularDistance(expected.joints[j].rotation),
                    10.0 * within);
          EXPECT_NEAR(found.radius[j], j == 0 ? 0.0 : 0.01, 1e-6);
        }
      }
    }
  }
};

TEST_F(WebxrDumpImport, StoredFileLoads) {
  const WholeRecording whole = read_whole(kDumpFile);
  expect_frames(whole, 1e-4);
  EXPECT_EQ(whole.header.source, "webxr");
  EXPECT_FALSE(whole.header.hand_scale_known);
}

TEST_F(WebxrDumpImport, EverySpellingOfAJoint) {
  const std::vector<JointSpelling> spellings{
      transform_of,
      [](const Pose& joint) {
        return json{{"position", xyz(joint.position)},
                    {"orientation", xyzw(joint.rotation)},
                    {"radius", 0.01}};
      },
      [](const Pose& joint) {
        const Vec3& p = joint.position;
        const Quat& q = joint.rotation;
        return json{{"position", {p.x(), p.y(), p.z()}},
                    {"quaternion", {q.x(), q.y(), q.z(), q.w()}},
                    {"radius", 0.01}};
      },
      [](const Pose& joint) {
        return json{{"position", xyz(joint.position)},
                    {"rotation", xyzw(joint.rotation)},
                    {"radius", 0.01}};
      },
      [](const Pose& joint) {
        return json{{"transform", {{"matrix", stringified(column_by_column(joint))}}},
                    {"radius", 0.01}};
      }};
  for (const JointSpelling& spelling : spellings) {
    expect_frames(read(frames_of([&](const HandPose& hand) { return by_name(hand, spelling); })),
                  1e-9);
  }
  const json underscores = frames_of([](const HandPose& hand) {
    json joints = json::object();
    const json dashes = by_name(hand);
    for (auto [name, joint] : dashes.items()) {
      std::string underscored = name;
      std::replace(underscored.begin(), underscored.end(), '-', '_');
      joints[underscored] = joint;
    }
    return joints;
  });
  expect_frames(read(underscores), 1e-9);
}

TEST_F(WebxrDumpImport, ArraysOfFillPoses) {
  expect_frames(read(frames_of(filled)), 1e-9);
  for (const char* key : {"transforms", "poses"}) {
    expect_frames(read(frames_of([&](const HandPose& hand) {
                    const json arrays = filled(hand);
                    return json{{key, stringified(arrays["matrices"])},
                                {"radii", stringified(arrays["radii"])}};
                  })),
                  1e-9);
  }
  expect_frames(read(frames_of([](const HandPose& hand) {
                  json arrays = filled(hand);
                  arrays["matrices"] = json::array();
                  for (std::size_t i = 1; i < kJointCount; ++i) {
                    arrays["matrices"].push_back(column_by_column(hand.joints[i]));
                  }
                  return arrays;
                })),
                1e-9);
}

TEST_F(WebxrDumpImport, EveryPlaceOfTheHands) {
  const json frames = frames_by_name();
  expect_frames(read({{"page", "demo"}, {"frames", frames}}), 1e-9);
  std::string lines;
  for (const json& frame : frames) lines += frame.dump() + "\n";
  expect_frames(read_whole(given("in.jsonl", lines)), 1e-9);

  json by_side = json::array();
  json listed = json::array();
  for (const json& frame : frames) {
    by_side.push_back({{"timestamp", frame["time"]},
                       {"hands", {{"left", frame["left"]}, {"right", frame["right"]}}}});
    json hands = json::array();
    for (const char* side : {"left", "right"}) {
      if (frame[side].is_null()) continue;
      hands.push_back({{"handedness", side}, {"joints", frame[side]}});
    }
    listed.push_back({{"t", frame["time"]}, {"hands", hands}});
  }
  expect_frames(read(by_side), 1e-9);
  expect_frames(read(listed), 1e-9);
  for (json& frame : listed) {
    for (json& hand : frame["hands"]) {
      json joints = hand["joints"];
      joints["handedness"] = hand["handedness"];
      hand = joints;
    }
    frame["hands"].push_back({{"handedness", "none"}});
  }
  expect_frames(read(listed), 1e-9);
  lines.clear();
  for (const json& frame : listed) lines += frame.dump() + "\n";
  expect_frames(read_whole(given("in.jsonl", lines)), 1e-9);
}

TEST_F(WebxrDumpImport, AHandThatIsNotWholeIsLeftOut) {
  const auto warning = [&](const std::function<void(json&)>& spoil) {
    json frames = frames_by_name();
    spoil(frames);
    const WholeRecording whole = read(frames);
    EXPECT_EQ(whole.error, "");
    EXPECT_EQ(whole.frames.size(), 3u);
    EXPECT_FALSE(whole.frames.size() > 1 && whole.frames[1].hands[1].has_value());
    return whole.warning();
  };
  EXPECT_EQ(warning([](json& f) { f[1]["right"]["ring-finger-tip"] = nullptr; }),
            path("in.json") +
                ": frames[1]: right: ring_tip is missing or has no finite position and rotation; "
                "the hand is left out of the frame");
  EXPECT_TRUE(contains(warning([](json& f) { f[1]["right"].erase("thumb-tip"); }), "thumb_tip"));
  EXPECT_TRUE(contains(
      warning([](json& f) { f[1]["right"]["wrist"]["transform"]["position"]["y"] = nullptr; }),
      "wrist is missing"));
  EXPECT_TRUE(
      contains(warning([](json& f) { f[1]["right"]["wrist"]["transform"].erase("orientation"); }),
               "wrist is missing"));
  EXPECT_TRUE(contains(warning([](json& f) {
                         f[1]["right"] = filled(hand_in(Handedness::right, 1));
                         f[1]["right"]["matrices"][30] = nullptr;
                       }),
                       "thumb_metacarpal is missing"));
  EXPECT_TRUE(contains(warning([](json& f) {
                         f[1]["right"] = {{"matrices", std::vector<double>(400, 0.0)}};
                       }),
                       "wrist is missing"));
  EXPECT_TRUE(contains(warning([](json& f) {
                         for (json& joint : f[1]["right"]) {
                           joint["transform"]["position"] = {0.0, 0.0, 0.0};
                         }
                       }),
                       "has no length"));
}

TEST_F(WebxrDumpImport, BadInputIsNamed) {
  const auto error = [&](const std::function<void(json&)>& spoil) {
    json frames = frames_by_name();
    spoil(frames);
    return read(frames).error;
  };
  EXPECT_EQ(
      error([](json& f) { f[1]["right"]["elbow"] = f[1]["right"]["wrist"]; }),
      path("in.json") + ": frames[1]: right: expected the name of a WebXR joint, found \"elbow\"");
  EXPECT_TRUE(contains(error([](json& f) { f[1].erase("time"); }),
                       "frames[1]: expected a \"time\" in milliseconds, found none"));
  EXPECT_TRUE(contains(error([](json& f) { f[1]["time"] = "now"; }),
                       "frames[1]: time: expected a time, found a string"));
  EXPECT_TRUE(contains(error([](json& f) { f[1] = 5; }), "expected a frame, found a number"));
  EXPECT_TRUE(contains(error([](json& f) { f[1]["right"] = 5; }),
                       "frames[1]: right: expected the joints of a hand by their names"));
  EXPECT_TRUE(contains(error([](json& f) {
                         f[1]["hands"] = {{{"handedness", "third"}, {"wrist", nullptr}}};
                       }),
                       "frames[1]: hands[0]: handedness: expected \"left\" or \"right\", found "
                       "\"third\""));
  EXPECT_TRUE(contains(error([](json& f) {
                         f[1]["right"] = {{"matrices", std::vector<double>(384, 0.0)}};
                       }),
                       "frames[1]: right: expected 25 matrices of 16 numbers, found 384"));
  json deep = 1;
  for (int i = 0; i < 70; ++i) deep = json::array({deep});
  EXPECT_TRUE(contains(error([&](json& f) { f[1]["deep"] = deep; }), "nested at most 64 deep"));
}

TEST_F(WebxrDumpImport, OddTimesAndHandsAreLeftOutAndCounted) {
  json frames = frames_by_name();
  frames[2]["time"] = frames[1]["time"];
  WholeRecording whole = read(frames);
  EXPECT_EQ(whole.frames.size(), 2u);
  EXPECT_TRUE(contains(whole.warning(), "frames[2]: the time does not advance"));

  frames = frames_by_name();
  const json right = frames[1]["right"];
  frames[1]["hands"] = {{{"handedness", "right"}, {"joints", right}},
                        {{"handedness", "right"}, {"joints", right}}};
  EXPECT_TRUE(contains(read(frames).warning(), "frames[1]: two right hands"));
}

TEST_F(WebxrDumpImport, CutOffFileIsReadToItsLastWholeFrame) {
  const std::string text = frames_by_name().dump();
  const WholeRecording whole = read_whole(given("cut.json", text.substr(0, text.size() - 500)));
  EXPECT_EQ(whole.error, "");
  EXPECT_EQ(whole.frames.size(), 2u);
  EXPECT_TRUE(contains(whole.warning(), "cut.json: frames[2]: cut off")) << whole.warning();
}

TEST_F(WebxrDumpImport, FramesOfOursWithoutTheirHeaderAreNamed) {
  EXPECT_TRUE(contains(
      read_whole(given("in.jsonl", R"({"t":0,"right":{"joints":[[0,0,0,0,0,0,1,0]]}})")).error,
      "a frame in line 1, without the recording's header"));
}

}  // namespace
}  // namespace nade
