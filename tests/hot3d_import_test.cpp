#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "nade/hand_check.h"
#include "support/hand_checks.h"
#include "support/recording_files.h"

namespace nade {
namespace {

using nlohmann::json;
using test::contains;
using test::read_whole;
using test::WholeRecording;

constexpr const char* kTrajectory = "umetrack_hand_pose_trajectory.jsonl";
constexpr const char* kProfile = "umetrack_hand_user_profile.json";

/// A direction or point of ours in UmeTrack's axes: fingers along +X, back of the hand +Y.
Vec3 in_model(const Vec3& ours) { return {-ours.z(), ours.y(), ours.x()}; }

json three(const Vec3& v) { return json::array({v.x(), v.y(), v.z()}); }

/// The left sample hand, stretched out, as a person's file has it.
json profile() {
  const HandPose rest = test::sample_hand(Handedness::left, {});
  json hinges = json::array();
  json axes = json::array();
  json tips = json::array();
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const DigitJoints digit = joints_of(digit_at(d));
    const std::size_t base = index_of(digit.tip) - 3;
    for (const std::size_t joint : {base, base, base + 1, base + 2}) {
      hinges.push_back(three(1e3 * in_model(rest.joints[joint].position)));
      axes.push_back(three(in_model(rest.joints[joint].rotation * -Vec3::UnitX())));
    }
    tips.push_back(three(1e3 * in_model(rest[digit.tip].position)));
  }
  return {{"hand_model",
           {{"joint_rest_positions", hinges},
            {"joint_rotation_axes", axes},
            {"landmark_rest_positions", tips}}}};
}

HandAngles bent(double by) {
  HandAngles angles{};
  for (DigitAngles& digit : angles) {
    for (HingeAngles& hinge : digit) hinge.flexion = by;
  }
  return angles;
}

/// The wrist of the first frame, in a frame with +Y up.
Pose wrist_of(Handedness side) {
  const double sign = side == Handedness::left ? -1.0 : 1.0;
  return {Vec3(sign * 0.2, 0.9, -0.3), Quat(Eigen::AngleAxisd(0.4, Vec3::UnitY()))};
}

HandPose truth(Handedness side, double by) {
  return moved(test::sample_hand(side, bent(by)), wrist_of(side));
}

json hand(Handedness side, double by, const Quat& axes = Quat::Identity()) {
  // From the model's axes to ours, of a right hand from its mirror image's.
  const double quarter = side == Handedness::left ? 90.0 : -90.0;
  const Pose wrist = Pose{Vec3::Zero(), axes} * wrist_of(side) *
                     Pose{Vec3::Zero(), Quat(Eigen::AngleAxisd(quarter * kDegree, Vec3::UnitY()))};
  json angles = json::array();
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    for (const double angle : {0.0, by, by, by}) angles.push_back(angle);
  }
  angles.push_back(0.0);
  angles.push_back(0.0);
  const Quat& q = wrist.rotation;
  return {
      {"wrist_xform", {{"t_xyz", three(wrist.position)}, {"q_wxyz", {q.w(), q.x(), q.y(), q.z()}}}},
      {"joint_angles", angles},
      {"hand_confidence", 0.75}};
}

std::string line(std::int64_t time_ns, const json& hands) {
  return json{{"timestamp_ns", time_ns}, {"hand_poses", hands}}.dump() + "\n";
}

json both(double by, const Quat& axes = Quat::Identity()) {
  return {{"0", hand(Handedness::left, by, axes)}, {"1", hand(Handedness::right, by, axes)}};
}

class Hot3dImport : public test::RecordingFiles {
 protected:
  void SetUp() override {
    test::RecordingFiles::SetUp();
    static_cast<void>(given(kProfile, profile().dump()));
    static_cast<void>(given("metadata.json", R"({"headset":"Quest3"})"));
  }
  [[nodiscard]] WholeRecording read(const std::string& text) const {
    return read_whole(given(kTrajectory, text));
  }
};

void expect_hands(const RecordedFrame& frame, double by) {
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    const auto& read = frame.hands[index_of(side)];
    ASSERT_TRUE(read.has_value());
    const HandPose expected = truth(side, by);
    for (std::size_t j = 1; j < kJointCount; ++j) {
      const bool guessed = j > index_of(Joint::thumb_tip) &&
                           std::string(name_of(joint_at(j))).ends_with("metacarpal");
      EXPECT_LT((read->pose.joints[j].position - expected.joints[j].position).norm(),
                guessed ? 0.02 : 1e-9)
          << name_of(side) << " " << name_of(joint_at(j));
    }
    EXPECT_EQ(check_hand(read->pose).cause, std::nullopt);
    EXPECT_EQ(read->pose.confidence, 0.75);
  }
}

TEST_F(Hot3dImport, BendsThePersonsHand) {
  const WholeRecording whole =
      read(line(5'000'000'000, both(0.1)) + line(5'033'333'333, both(0.5)));
  EXPECT_EQ(whole.error, "");
  EXPECT_TRUE(whole.warnings.empty()) << whole.warning();
  EXPECT_EQ(whole.format, RecordingFormat::hot3d);
  EXPECT_TRUE(whole.header.hand_scale_known);
  ASSERT_EQ(whole.frames.size(), 2U);
  EXPECT_EQ(whole.frames[1].time_ns, 5'033'333'333);
  expect_hands(whole.frames[0], 0.1);
  expect_hands(whole.frames[1], 0.5);
}

TEST_F(Hot3dImport, ThumbHasItsBaseOnTheWayToItsKnuckleWhereItsHingesLieApart) {
  json person = profile();
  json& hinges = person["hand_model"]["joint_rest_positions"];
  hinges[1][1] = hinges[1][1].get<double>() + 20.0;
  static_cast<void>(given(kProfile, person.dump()));
  const WholeRecording whole = read(line(1, both(0.0)));
  ASSERT_EQ(whole.frames.size(), 1U);
  const HandPose expected = truth(Handedness::right, 0.0);
  const Vec3& first = expected[Joint::thumb_metacarpal].position;
  const Vec3 base = first + 0.3 * (expected[Joint::thumb_proximal].position - first);
  EXPECT_LT((whole.frames[0].hands[1]->pose[Joint::thumb_metacarpal].position - base).norm(), 1e-9);
}

TEST_F(Hot3dImport, AriaHasZUp) {
  static_cast<void>(given("metadata.json", R"({"headset":"Aria"})"));
  const Quat up(Eigen::AngleAxisd(90.0 * kDegree, Vec3::UnitX()));
  const WholeRecording whole = read(line(1, both(0.3, up)));
  EXPECT_EQ(whole.error, "");
  ASSERT_EQ(whole.frames.size(), 1U);
  expect_hands(whole.frames[0], 0.3);
}

TEST_F(Hot3dImport, WhatIsUpIsGuessedWithoutMetadata) {
  ASSERT_EQ(std::remove(path("metadata.json").c_str()), 0);
  const WholeRecording whole = read(line(1, both(0.3)));
  EXPECT_TRUE(contains(whole.warning(), "+Y is taken to be up")) << whole.warning();
  ASSERT_EQ(whole.frames.size(), 1U);
}

TEST_F(Hot3dImport, BothCamerasOfAMomentAreOneFrame) {
  const WholeRecording whole =
      read(line(1'000'000'000, both(0.1)) + line(1'000'090'000, both(0.1)) +
           line(1'033'000'000, json::object()));
  EXPECT_EQ(whole.frames.size(), 2U);
  EXPECT_TRUE(contains(whole.warning(), "line 2: less than a millisecond")) << whole.warning();
}

TEST_F(Hot3dImport, PersonsHandIsMissingOrWrong) {
  const std::string text = line(1, both(0.1));
  static_cast<void>(given(kProfile, "{}"));
  EXPECT_TRUE(contains(read(text).error, std::string(kProfile) + ": expected an object"));
  json wrong = profile();
  wrong["hand_model"]["joint_rotation_axes"].erase(0);
  static_cast<void>(given(kProfile, wrong.dump()));
  EXPECT_TRUE(contains(read(text).error, "joint_rotation_axes: expected 20 points"));
  wrong = profile();
  wrong["hand_model"]["landmark_rest_positions"][2] = {1, 2, "3"};
  static_cast<void>(given(kProfile, wrong.dump()));
  EXPECT_TRUE(contains(read(text).error, "landmark_rest_positions[2]: expected three numbers"));
  static_cast<void>(given(kProfile, R"({"hand_model":)"));
  EXPECT_TRUE(contains(read(text).error, "found it cut off"));
  ASSERT_EQ(std::remove(path(kProfile).c_str()), 0);
  EXPECT_TRUE(contains(read(text).error, "expected the hand that these angles bend beside it"));
}

TEST_F(Hot3dImport, ManoSaysWhatToConvert) {
  const json mano{{"0", {{"pose", {0.1, 0.2}}, {"betas", {0.3}}, {"wrist_xform", json::object()}}}};
  EXPECT_TRUE(contains(read(line(1, mano)).error,
                       "found a pose of MANO, whose joints only that model gives, which may not be "
                       "passed on; convert umetrack_hand_pose_trajectory.jsonl"));
}

TEST_F(Hot3dImport, ThePersonsHandIsNoRecording) {
  EXPECT_TRUE(contains(read_whole(path(kProfile)).error, "found the hand of a person of HOT3D"));
}

TEST_F(Hot3dImport, OddLines) {
  json hands = both(0.1);
  hands["0"]["joint_angles"][3] = nullptr;
  hands["1"]["wrist_xform"]["q_wxyz"] = {0, 0, 0, 0};
  const WholeRecording whole = read(line(1, hands));
  EXPECT_TRUE(contains(whole.warning(), "line 1: left: joint_angles or wrist_xform is missing"));
  EXPECT_TRUE(contains(whole.warning(), "1 more like it"));
  ASSERT_EQ(whole.frames.size(), 1U);
  EXPECT_FALSE(whole.frames[0].hands[0] || whole.frames[0].hands[1]);
  EXPECT_TRUE(contains(read(R"({"timestamp_ns":1.5,"hand_poses":{}})").error,
                       "line 1: expected a whole \"timestamp_ns\""));
  EXPECT_TRUE(contains(read(R"({"timestamp_ns":1,"hand_poses":[]})").error,
                       "line 1: expected an object \"hand_poses\""));
}

}  // namespace
}  // namespace nade
