#include "nade/io/recording.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "support/recording_files.h"

namespace nade {
namespace {

using nlohmann::json;
using test::contains;
using test::random_hand;
using test::read_whole;
using test::WholeRecording;

const std::string kHeader = R"({"format":"nade-recording","version":1,"source":"test"})";

void expect_same_bits(double a, double b) {
  EXPECT_EQ(a, b);
  EXPECT_EQ(std::signbit(a), std::signbit(b));
}

void expect_same_bits(const HandPose& a, const HandPose& b) {
  EXPECT_EQ(a.side, b.side);
  expect_same_bits(a.confidence, b.confidence);
  for (std::size_t i = 0; i < kJointCount; ++i) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      expect_same_bits(a.joints[i].position[k], b.joints[i].position[k]);
    }
    for (Eigen::Index k = 0; k < 4; ++k) {
      expect_same_bits(a.joints[i].rotation.coeffs()[k], b.joints[i].rotation.coeffs()[k]);
    }
    expect_same_bits(a.radius[i], b.radius[i]);
  }
}

/// A frame line as JSON, to be spoilt. There are a hundred in a second.
json frame_json(std::int64_t number) {
  json joints = json::array();
  const HandPose hand = test::sample_hand();
  for (const Pose& joint : hand.joints) {
    const Vec3& p = joint.position;
    const Quat& q = joint.rotation;
    joints.push_back({p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w(), 0.01});
  }
  return {{"t", 10'000'000 * number}, {"right", {{"joints", joints}, {"confidence", 0.9}}}};
}

class Recording : public test::RecordingFiles {
 protected:
  /// Reads the header, a good frame and then these lines.
  [[nodiscard]] WholeRecording read_lines(const std::vector<std::string>& lines) const {
    std::string text = kHeader + "\n" + frame_json(0).dump() + "\n";
    for (const std::string& line : lines) text += line + "\n";
    return read_whole(given("in.jsonl", text));
  }
  /// The error about a frame in line 3 without the file's name and the line.
  [[nodiscard]] std::string error_of(const json& frame) const {
    const WholeRecording whole = read_lines({frame.dump()});
    const std::string prefix = path("in.jsonl") + ": line 3: ";
    EXPECT_EQ(whole.error.rfind(prefix, 0), 0u) << whole.error;
    EXPECT_EQ(whole.frames.size(), 1u);
    return whole.error.size() > prefix.size() ? whole.error.substr(prefix.size()) : whole.error;
  }
};

TEST_F(Recording, ComesBackBitEqual) {
  for (const char* name : {"out.jsonl", "out.jsonl.gz"}) {
    std::mt19937 random(1);
    std::vector<RecordedFrame> frames(50);
    Result<RecordingWriter> writer = RecordingWriter::create(
        path(name), {"leap", "2026-11-21T02:40:00Z", true, R"({"method":"paper"})"});
    ASSERT_TRUE(writer.ok());
    for (std::size_t i = 0; i < frames.size(); ++i) {
      RecordedFrame& frame = frames[i];
      frame.time_ns = 1'700'000'000'000'000'001 + 11'111'111 * static_cast<std::int64_t>(i);
      if (i % 3 != 0) frame.hands[0] = random_hand(Handedness::left, random);
      if (i % 5 != 0) frame.hands[1] = random_hand(Handedness::right, random);
      if (frame.hands[1]) {
        frame.hands[1]->pose.joints[3].position.x() = -0.0;
        frame.hands[1]->pose.joints[4].position.x() = 1e-300;
        frame.hands[1]->pose.joints[5].position.x() = 0.1 + 0.2;
      }
      ASSERT_TRUE(writer->write(frame).ok());
    }
    ASSERT_TRUE(writer->finish().ok());

    const WholeRecording whole = read_whole(path(name));
    EXPECT_EQ(whole.error, "");
    EXPECT_TRUE(whole.warnings.empty());
    EXPECT_EQ(whole.header.source, "leap");
    EXPECT_EQ(whole.header.created, "2026-11-21T02:40:00Z");
    EXPECT_TRUE(whole.header.hand_scale_known);
    EXPECT_EQ(json::parse(whole.header.unknown_json), json::parse(R"({"method":"paper"})"));
    ASSERT_EQ(whole.frames.size(), frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
      EXPECT_EQ(whole.frames[i].time_ns, frames[i].time_ns);
      for (std::size_t side = 0; side < 2; ++side) {
        ASSERT_EQ(whole.frames[i].hands[side].has_value(), frames[i].hands[side].has_value());
        if (!frames[i].hands[side]) continue;
        expect_same_bits(whole.frames[i].hands[side]->pose, frames[i].hands[side]->pose);
      }
    }
  }
}

TEST_F(Recording, StoredVersionOneStillLoads) {
  const WholeRecording whole = read_whole(NADE_TEST_DATA_DIR "/recording_v1.jsonl");
  EXPECT_EQ(whole.error, "");
  ASSERT_EQ(whole.warnings.size(), 2u);
  EXPECT_TRUE(contains(whole.warnings[0], "left hand: all joints are turned alike"));
  EXPECT_EQ(whole.format, RecordingFormat::nade);
  EXPECT_EQ(whole.header.source, "leap");
  EXPECT_EQ(json::parse(whole.header.unknown_json)["object"]["name"], "plane");
  ASSERT_EQ(whole.frames.size(), 4u);
  EXPECT_EQ(whole.frames[1].time_ns, 11111111);
  ASSERT_TRUE(whole.frames[1].hands[0] && whole.frames[1].hands[1]);
  const RecordedHand& hand = *whole.frames[1].hands[1];
  EXPECT_EQ(hand.status, HandStatus::corrected);
  EXPECT_DOUBLE_EQ(hand.pose.confidence, 0.91);
  EXPECT_DOUBLE_EQ(hand.pose[Joint::wrist].position.x(), 0.2);
  EXPECT_DOUBLE_EQ(hand.pose.radius[index_of(Joint::wrist)], 0.021);
  ASSERT_TRUE(hand.contact[index_of(Part::palm)].has_value());
  EXPECT_DOUBLE_EQ(hand.contact[index_of(Part::palm)]->depth_m, 0.021);
  EXPECT_DOUBLE_EQ(hand.contact[index_of(Part::index)]->point.z(), -0.177);
  EXPECT_FALSE(hand.contact[index_of(Part::thumb)].has_value());
  EXPECT_FALSE(whole.frames[2].hands[0] || whole.frames[2].hands[1]);
  EXPECT_EQ(whole.frames[3].hands[1]->status, HandStatus::released);
}

TEST_F(Recording, NothingIsLostOnTheWayThrough) {
  const std::string in = NADE_TEST_DATA_DIR "/recording_v1.jsonl";
  const WholeRecording whole = read_whole(in);
  Result<RecordingWriter> writer = RecordingWriter::create(path("out.jsonl"), whole.header);
  ASSERT_TRUE(writer.ok());
  for (const RecordedFrame& frame : whole.frames) ASSERT_TRUE(writer->write(frame).ok());
  ASSERT_TRUE(writer->finish().ok());

  std::ifstream before(in);
  std::ifstream after(path("out.jsonl"));
  std::string line_before;
  std::string line_after;
  std::size_t lines = 0;
  while (std::getline(before, line_before)) {
    ASSERT_TRUE(std::getline(after, line_after));
    EXPECT_EQ(json::parse(line_before), json::parse(line_after)) << "line " << ++lines;
  }
  EXPECT_FALSE(std::getline(after, line_after));
}

TEST_F(Recording, GzipIsToldByContentNotName) {
  write_random("a.jsonl.gz", 5);
  std::filesystem::rename(path("a.jsonl.gz"), path("a.jsonl"));
  EXPECT_EQ(read_whole(path("a.jsonl")).frames.size(), 5u);
  write_random("b.jsonl", 5);
  std::filesystem::rename(path("b.jsonl"), path("b.jsonl.gz"));
  EXPECT_EQ(read_whole(path("b.jsonl.gz")).frames.size(), 5u);
}

TEST_F(Recording, ToleratesMarksBlankLinesAndLineEnds) {
  const std::string text = "\xEF\xBB\xBF\n" + kHeader + "\r\n\r\n" + frame_json(1).dump() +
                           "\r\n   \n" + frame_json(2).dump();
  const WholeRecording whole = read_whole(given("in.jsonl", text));
  EXPECT_EQ(whole.error, "");
  EXPECT_TRUE(whole.warnings.empty());
  EXPECT_EQ(whole.frames.size(), 2u);
}

TEST_F(Recording, CutOffPlainFileIsReadToItsLastWholeLine) {
  write_random("in.jsonl", 10);
  const std::string text = test::read_file(path("in.jsonl"));
  const WholeRecording whole = read_whole(given("cut.jsonl", text.substr(0, text.size() - 30)));
  EXPECT_EQ(whole.error, "");
  EXPECT_EQ(whole.frames.size(), 9u);
  EXPECT_TRUE(contains(whole.warning(), "cut.jsonl: line 11: cut off")) << whole.warning();
}

TEST_F(Recording, CutOffGzipIsReadAsFarAsItGoes) {
  write_random("in.jsonl.gz", 200);
  const std::string bytes = test::read_file(path("in.jsonl.gz"));
  for (const std::size_t size : {bytes.size() / 2, bytes.size() - 1, bytes.size() - 8}) {
    const WholeRecording whole = read_whole(given("cut.jsonl.gz", bytes.substr(0, size)));
    EXPECT_EQ(whole.error, "");
    EXPECT_GT(whole.frames.size(), size == bytes.size() / 2 ? 50u : 199u);
    EXPECT_TRUE(contains(whole.warning(), "cut off")) << whole.warning();
  }
}

TEST_F(Recording, DamagedGzipIsAnError) {
  write_random("in.jsonl.gz", 200);
  std::string bytes = test::read_file(path("in.jsonl.gz"));
  bytes[bytes.size() - 6] = static_cast<char>(~bytes[bytes.size() - 6]);  // its check sum
  const WholeRecording whole = read_whole(given("bad.jsonl.gz", bytes));
  EXPECT_TRUE(contains(whole.error, "bad.jsonl.gz: expected whole gzip data")) << whole.error;
}

TEST_F(Recording, DamagedGzipIsSaidToBeDamagedWhateverComesOutOfIt) {
  for (const std::string name : {"recording_v1.jsonl", "leap_v2.json", "mediapipe_results.json",
                                 "webxr_actions.json", "webxr_joints.json", "hands.bvh"}) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(write_whole(path("in.gz"), test::read_file(NADE_TEST_DATA_DIR "/" + name)).ok());
    const std::string bytes = test::read_file(path("in.gz"));
    for (std::size_t at = 20; at < bytes.size(); at += bytes.size() / 40 + 1) {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damaged[at] ^ 0x24);
      const WholeRecording whole = read_whole(given("bad.gz", damaged));
      // Some damage looks like an end that came too early.
      const bool cut_off = whole.error.empty() && !whole.warnings.empty() &&
                           contains(whole.warnings.back(), "cut off");
      EXPECT_TRUE(cut_off || contains(whole.error, "bad.gz: expected whole gzip data"))
          << "byte " << at << ": " << whole.error;
    }
  }
}

TEST_F(Recording, GzipOfSeveralMembersIsWholeOrAnError) {
  write_random("in.jsonl", 200);
  write_random("in.jsonl.gz", 200);
  const std::string text = test::read_file(path("in.jsonl"));
  const std::string half = text.substr(0, text.find('\n', text.size() / 2) + 1);
  ASSERT_TRUE(write_whole(path("1.gz"), half).ok());
  ASSERT_TRUE(write_whole(path("2.gz"), text.substr(half.size())).ok());
  const std::string first = test::read_file(path("1.gz"));
  const std::string second = test::read_file(path("2.gz"));
  const std::string padding(5, '\0');
  for (const std::string& bytes : {first + second, first + second + padding}) {
    const WholeRecording whole = read_whole(given("members.gz", bytes));
    EXPECT_EQ(whole.error, "");
    EXPECT_TRUE(whole.warnings.empty());
    EXPECT_EQ(whole.frames.size(), 200u);
  }
  for (const std::string& between : {std::string("x"), padding, std::string("\x1F")}) {
    const WholeRecording whole = read_whole(given("members.gz", first + between + second));
    EXPECT_TRUE(contains(whole.error, "members.gz: expected whole gzip data")) << whole.error;
  }
  const WholeRecording cut =
      read_whole(given("members.gz", first + second.substr(0, second.size() / 2)));
  EXPECT_EQ(cut.error, "");
  EXPECT_TRUE(contains(cut.warning(), "cut off")) << cut.warning();
}

TEST_F(Recording, WhatIsNoRecordingIsNamed) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "found nothing"},
      {"\n \n", "found nothing"},
      {"once upon a time\n", "found none of them"},
      {"{\"a\":1}\n", "found an object that begins with \"a\""},
      {frame_json(0).dump() + "\n", "a frame in line 1, without the recording's header"},
      {"{\"format\":\"other\",\"version\":1}\n", "line 1: expected the format \"nade-recording\""},
      {"{\"format\":\"nade-recording\",\"version\":2}\n", "line 1: expected version 1 of"},
      {"{\"format\":\"nade-recording\"}\n", "found none"},
      {"{\"format\":\"nade-recording\",\"ver", "line 1: expected a recording's header"},
      {"{\"format\":\"nade-recording\",\"version\":1,\"source\":3}\n", "line 1: source: expected"},
      {R"({"frames":[["packed"],[1]]})", "frames[1]: expected the \"hands\""},
      {R"({"frames":[[0,1,2]],"schema":[]})", "expected \"schema\" before \"frames\""},
  };
  for (const auto& [text, part] : cases) {
    const WholeRecording whole = read_whole(given("in.jsonl", text));
    EXPECT_TRUE(contains(whole.error, path("in.jsonl"))) << whole.error;
    EXPECT_TRUE(contains(whole.error, part)) << whole.error << " for " << text;
    EXPECT_EQ(whole.error.find('\n'), std::string::npos);
  }
  EXPECT_TRUE(contains(read_whole(path("none.jsonl")).error, "no such file"));
  EXPECT_TRUE(contains(read_whole(path(".")).error, "directory"));
}

TEST_F(Recording, WrongLinesAreErrorsThatNameThem) {
  json frame = frame_json(0);
  EXPECT_EQ(error_of(frame), "t: expected a time after 0, found 0");
  frame["t"] = -5;
  EXPECT_EQ(error_of(frame), "t: expected a time after 0, found -5");
  frame["t"] = "now";
  EXPECT_EQ(error_of(frame), "t: expected a time in whole nanoseconds, found \"now\"");
  frame["t"] = 1.5;
  EXPECT_EQ(error_of(frame), "t: expected a time in whole nanoseconds, found 1.5");
  frame["t"] = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(error_of(frame),
            "t: expected a time up to 4000000000000000000 ns from 0, found 9223372036854775807");
  EXPECT_EQ(error_of({{"right", 1}}), "t: expected a time in whole nanoseconds, found none");
  frame = frame_json(5);
  frame["right"] = 7;
  EXPECT_EQ(error_of(frame), "right: expected a hand, found a number");
  frame = frame_json(5);
  frame["right"].erase("joints");
  EXPECT_EQ(error_of(frame), "right: joints: expected 26 joints, found none");
  frame = frame_json(5);
  frame["right"]["joints"].erase(3);
  EXPECT_EQ(error_of(frame), "right: joints: expected 26 joints, found 25");
  frame = frame_json(5);
  frame["right"]["joints"][4].erase(0);
  EXPECT_EQ(error_of(frame), "right: joint 4: expected 8 numbers, found 7");
  frame = frame_json(5);
  frame["right"]["joints"][4][2] = "x";
  EXPECT_EQ(error_of(frame), "right: joint 4: expected 8 numbers, found a string among them");
  frame["right"]["joints"][4] = nullptr;
  EXPECT_EQ(error_of(frame), "right: joint 4: expected 8 numbers, found no finite number");
  frame = frame_json(5);
  frame["right"]["joints"][4][2] = 1e7;
  EXPECT_TRUE(contains(error_of(frame), "right: joint 4: expected numbers up to 1000000"));
  frame = frame_json(5);
  frame["right"]["joints"][4][7] = -0.01;
  EXPECT_TRUE(contains(error_of(frame), "right: joint 4: expected a radius of 0 or more"));
  frame = frame_json(5);
  frame["right"]["confidence"] = 1.5;
  EXPECT_EQ(error_of(frame), "right: confidence: expected a number from 0 to 1, found 1.5");
  frame = frame_json(5);
  frame["right"]["status"] = "asleep";
  EXPECT_TRUE(contains(error_of(frame), "right: status: expected free or corrected or"));
  frame = frame_json(5);
  frame["right"]["contact"] = {{"palm", {{"point", {1, 2}}}}};
  EXPECT_TRUE(contains(error_of(frame), "right: contact: palm: expected a point and a normal"));
}

TEST_F(Recording, WrongJsonIsAnErrorThatNamesItsColumn) {
  for (const char* line :
       {"{\"t\":5,}", "nonsense", "{\"t\":5", "{\"t\":5}}", "{\"t\":5,\"a\":\"\xff\"}"}) {
    const WholeRecording whole = read_lines({line, frame_json(9).dump()});
    EXPECT_TRUE(contains(whole.error, "in.jsonl: line 3: column")) << whole.error;
    EXPECT_TRUE(contains(whole.error, "expected valid JSON")) << whole.error;
  }
  EXPECT_TRUE(contains(read_lines({"[1]"}).error, "line 3: expected a frame, found an array"));
  const std::string deep =
      "{\"t\":5,\"a\":" + std::string(100000, '[') + std::string(100000, ']') + "}";
  EXPECT_TRUE(contains(read_lines({deep}).error, "nested at most")) << read_lines({deep}).error;
}

TEST_F(Recording, HandThatIsNotFiniteIsLeftOut) {
  for (const char* number : {"null", "NaN", "-Infinity", "1e999", "-1e999"}) {
    std::string line = frame_json(5).dump();
    const std::size_t first = line.find("[[") + 2;
    line.replace(first, line.find(',', first) - first, number);
    const WholeRecording whole = read_lines({line, frame_json(6).dump()});
    EXPECT_EQ(whole.error, "") << number;
    ASSERT_EQ(whole.frames.size(), 3u);
    EXPECT_FALSE(whole.frames[1].hands[1].has_value());
    EXPECT_TRUE(whole.frames[2].hands[1].has_value());
    EXPECT_TRUE(contains(whole.warning(), "line 3: right: ")) << whole.warning();
    EXPECT_TRUE(contains(whole.warning(), "left out")) << whole.warning();
  }
}

TEST_F(Recording, UnusableHandsAreCounted) {
  json far = frame_json(5);
  far["right"]["joints"][9][0] = 3.0;
  json unturned = frame_json(6);
  for (std::size_t k = 3; k < 7; ++k) unturned["right"]["joints"][9][k] = 0.0;
  const WholeRecording whole = read_lines({far.dump(), unturned.dump()});
  EXPECT_EQ(whole.error, "");
  ASSERT_EQ(whole.frames.size(), 3u);
  EXPECT_FALSE(whole.frames[1].hands[1] || whole.frames[2].hands[1]);
  EXPECT_TRUE(contains(whole.warning(), "line 3")) << whole.warning();
  EXPECT_TRUE(contains(whole.warning(), "and 1 more")) << whole.warning();
}

TEST_F(Recording, TheJointsOfWebXrAreTakenWithoutThePalm) {
  json frame = frame_json(5);
  frame["right"]["joints"].erase(0);
  const WholeRecording whole = read_lines({frame.dump()});
  EXPECT_EQ(whole.error, "");
  EXPECT_TRUE(contains(whole.warning(), "line 3: right: 25 joints")) << whole.warning();
  ASSERT_EQ(whole.frames.size(), 2u);
  const HandPose& hand = whole.frames[1].hands[1]->pose;
  const HandPose& full = whole.frames[0].hands[1]->pose;
  EXPECT_EQ(hand[Joint::little_tip], full[Joint::little_tip]);
  EXPECT_EQ(hand[Joint::palm], palm_from_middle_metacarpal(full));
  for (const std::size_t lost : {1U, 7U, 12U, 17U, 25U}) {
    frame = frame_json(5);
    frame["right"]["joints"].erase(lost);
    EXPECT_EQ(error_of(frame), "right: joints: expected 26 joints, found 25") << lost;
  }
}

/// What a whole recording looks like to be.
TEST_F(Recording, AnotherConventionIsNamed) {
  const auto warning = [&](const auto& spoil) {
    std::string text = kHeader + "\n";
    for (std::int64_t i = 0; i < 9; ++i) {
      json frame = frame_json(i);
      spoil(frame);
      text += frame.dump() + "\n";
    }
    const WholeRecording whole = read_whole(given("in.jsonl", text));
    EXPECT_EQ(whole.error, "");
    return whole.warnings.empty() ? std::string() : whole.warnings.back();
  };
  const auto each = [](json& frame, const auto& spoil_joint) {
    for (json& joint : frame["right"]["joints"]) spoil_joint(joint);
  };
  EXPECT_EQ(warning([](json&) {}), "");
  for (const auto& [divisor, unit] : std::vector<std::pair<std::int64_t, std::string>>{
           {1'000, "microseconds"}, {1'000'000, "milliseconds"}}) {
    EXPECT_TRUE(contains(
        warning([d = divisor](json& frame) { frame["t"] = frame["t"].get<std::int64_t>() / d; }),
        "in.jsonl: the times look to be in " + unit));
  }
  EXPECT_TRUE(contains(warning([&](json& frame) {
                         each(frame, [](json& joint) {
                           joint = {joint[0], joint[1], joint[2], joint[6],
                                    joint[3], joint[4], joint[5], joint[7]};
                         });
                       }),
                       "right hand: the quaternions look to have w first"));
  for (const auto& [factor, unit] : std::vector<std::pair<double, std::string>>{
           {1e3, "millimetres"}, {1e2, "centimetres"}, {1.0 / 0.0254, "inches"}}) {
    EXPECT_TRUE(contains(warning([&, f = factor](json& frame) {
                           each(frame, [f](json& joint) {
                             for (std::size_t k = 0; k < 3; ++k) {
                               joint[k] = f * joint[k].get<double>();
                             }
                           });
                         }),
                         "right hand: the positions look to be in " + unit));
  }
  EXPECT_TRUE(contains(warning([](json& frame) {
                         frame["left"] = frame["right"];
                         frame.erase("right");
                       }),
                       "left hand: the hand looks to be of the other side"));
}

TEST_F(Recording, AHandInOnePointIsLeftOut) {
  json frame = frame_json(5);
  for (json& joint : frame["right"]["joints"]) {
    for (std::size_t k = 0; k < 3; ++k) joint[k] = 0.0;
  }
  const WholeRecording whole = read_lines({frame.dump()});
  EXPECT_FALSE(whole.frames[1].hands[1].has_value());
  EXPECT_TRUE(contains(whole.warning(), "line 3: right: the hand has no length"));
}

TEST_F(Recording, ABombIsRefused) {
  const std::string bomb = kHeader + "\n" + std::string(std::size_t{100} << 20, '\n');
  ASSERT_TRUE(write_whole(path("bomb.jsonl.gz"), bomb).ok());
  EXPECT_TRUE(contains(read_whole(path("bomb.jsonl.gz")).error,
                       "bomb.jsonl.gz: expected a recording, found gzip data that unpack to more"));
  std::string many = kHeader + "\n{\"t\":1,\"a\":[0";
  for (int i = 0; i < 1'000'000; ++i) many += ",0";
  EXPECT_TRUE(contains(read_whole(given("many.jsonl", many + "]}\n")).error,
                       "line 2: expected at most 1000000 values"));
}

TEST_F(Recording, QuaternionsAreMadeUnit) {
  json frame = frame_json(5);
  frame["right"]["joints"][9][6] = 1.2;
  const WholeRecording whole = read_lines({frame.dump()});
  EXPECT_EQ(whole.error, "");
  ASSERT_TRUE(whole.frames[1].hands[1].has_value());
  EXPECT_NEAR(whole.frames[1].hands[1]->pose.joints[9].rotation.norm(), 1.0, 1e-12);
  EXPECT_TRUE(contains(whole.warning(), "joint 9: the quaternion")) << whole.warning();
}

TEST_F(Recording, ZeroLengthBonesAreRead) {
  json frame = frame_json(5);
  json& joints = frame["right"]["joints"];
  for (std::size_t i = 7; i <= 10; ++i) joints[i] = joints[6];
  const WholeRecording whole = read_lines({frame.dump()});
  EXPECT_EQ(whole.error, "");
  EXPECT_TRUE(whole.frames[1].hands[1].has_value());
}

TEST_F(Recording, LineWithoutEndIsRefused) {
  const std::string text =
      kHeader + "\n{\"t\":0,\"a\":\"" + std::string(std::size_t{17} << 20, 'x') + "\"}\n";
  EXPECT_TRUE(contains(read_whole(given("in.jsonl", text)).error,
                       "line 2: expected at most 16 MiB in a line"));
}

TEST_F(Recording, HeadComesBackBitForBit) {
  Result<RecordingWriter> writer = RecordingWriter::create(path("out.jsonl"), {});
  ASSERT_TRUE(writer.ok());
  RecordedFrame frame;
  frame.head = Pose{{0.1, 1.6, -0.3}, Quat(0.6, 0.0, 0.8, 0.0)};
  ASSERT_TRUE(writer->write(frame).ok());
  frame.time_ns = 1;
  frame.head.reset();
  ASSERT_TRUE(writer->write(frame).ok());
  ASSERT_TRUE(writer->finish().ok());
  const WholeRecording whole = read_whole(path("out.jsonl"));
  ASSERT_EQ(whole.frames.size(), 2u);
  ASSERT_TRUE(whole.frames[0].head);
  EXPECT_EQ(whole.frames[0].head->position, Vec3(0.1, 1.6, -0.3));
  EXPECT_EQ(whole.frames[0].head->rotation.coeffs(), Quat(0.6, 0.0, 0.8, 0.0).coeffs());
  EXPECT_EQ(whole.frames[0].unknown_json, "");
  EXPECT_FALSE(whole.frames[1].head);
}

TEST_F(Recording, HeadThatIsNoneIsNamed) {
  const std::string header = R"({"format":"nade-recording","version":1,"source":""})";
  const std::string file = given("head.jsonl", header + "\n{\"t\":0,\"head\":[0,1,2]}\n");
  EXPECT_TRUE(contains(read_whole(file).error, "line 2: head: expected 7 numbers"));
}

}  // namespace
}  // namespace nade
