#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "nade/hand_check.h"
#include "support/bvh_file.h"
#include "support/hand_checks.h"
#include "support/recording_files.h"

namespace nade {
namespace {

using test::bvh_text;
using test::BvhNames;
using test::BvhStyle;
using test::contains;
using test::read_whole;
using test::WholeRecording;

/// Two made-up hands on a body, in four frames, as Mixamo names them.
const std::string kStored = NADE_TEST_DATA_DIR "/hands.bvh";

/// Frame by frame the hands bend and turn.
HandPose bent_hand(Handedness side, std::size_t frame) {
  const double phase = 0.5 * static_cast<double>(frame);
  HandAngles angles = test::relaxed_angles();
  for (DigitAngles& digit : angles) {
    for (HingeAngles& hinge : digit) hinge.flexion += 0.2 * phase;
  }
  const double sign = side == Handedness::right ? 1.0 : -1.0;
  return test::placed_hand(test::sample_hand(side, angles), {sign * 0.3, 1.1 + 0.05 * phase, -0.4},
                           Quat(Eigen::AngleAxisd(0.4 * phase, Vec3::UnitY()) *
                                Eigen::AngleAxisd(sign * 0.3 * phase, Vec3::UnitZ())));
}

std::vector<test::BvhFrame> bent_hands(std::size_t count) {
  std::vector<test::BvhFrame> frames(count);
  for (std::size_t i = 0; i < count; ++i) {
    frames[i] = {bent_hand(Handedness::left, i), bent_hand(Handedness::right, i)};
  }
  return frames;
}

double angle_deg(const Quat& a, const Quat& b) { return a.angularDistance(b) / kDegree; }

bool warns(const WholeRecording& whole, const std::string& part) {
  for (const std::string& warning : whole.warnings) {
    if (contains(warning, part)) return true;
  }
  return false;
}

class BvhImport : public test::RecordingFiles {
 protected:
  [[nodiscard]] WholeRecording read(const std::string& text,
                                    const std::string& name = "take.bvh") const {
    return read_whole(given(name, text));
  }
};

/// Joints that the file has come back where they were; the others as near as can be guessed.
void expect_hands(const WholeRecording& whole, std::size_t frames, double metacarpals_m) {
  ASSERT_EQ(whole.error, "");
  ASSERT_EQ(whole.frames.size(), frames);
  for (std::size_t i = 0; i < frames; ++i) {
    for (const Handedness side : {Handedness::left, Handedness::right}) {
      const auto& hand = whole.frames[i].hands[index_of(side)];
      ASSERT_TRUE(hand.has_value());
      const HandPose truth = bent_hand(side, i);
      for (std::size_t j = 1; j < kJointCount; ++j) {
        const Joint joint = joint_at(j);
        // The sample hand's metacarpals are not turned along their bones.
        const bool metacarpal =
            joint > Joint::thumb_tip && std::string(name_of(joint)).ends_with("metacarpal");
        EXPECT_LT((hand->pose[joint].position - truth[joint].position).norm(),
                  metacarpal ? metacarpals_m : 1e-5)
            << name_of(side) << " " << name_of(joint);
        if (metacarpal) continue;
        EXPECT_LT(angle_deg(hand->pose[joint].rotation, truth[joint].rotation), 25.0)
            << name_of(side) << " " << name_of(joint) << " in " << i;
      }
      EXPECT_EQ(check_hand(hand->pose).cause, std::nullopt);
    }
  }
}

TEST_F(BvhImport, StoredFileLoads) {
  const WholeRecording whole = read_whole(kStored);
  EXPECT_EQ(whole.format, RecordingFormat::bvh);
  EXPECT_EQ(whole.header.source, "bvh");
  EXPECT_FALSE(whole.header.hand_scale_known);
  EXPECT_EQ(whole.header.created, "");
  expect_hands(whole, 4, 0.02);
  EXPECT_EQ(whole.frames[3].time_ns, 25'000'000);
}

TEST_F(BvhImport, FingersBendToThePalm) {
  const WholeRecording whole = read_whole(kStored);
  ASSERT_EQ(whole.frames.size(), 4U);
  for (const auto& hand : whole.frames[3].hands) {
    ASSERT_TRUE(hand.has_value());
    const HandAngles angles = measure_angles(hand->pose);
    for (std::size_t d = 1; d < kDigitCount; ++d) EXPECT_GT(angles[d][1].flexion, 0.3);
    // The thumb of a left hand that lies palm down with its fingers ahead is on its right.
    const HandPose palm = moved(hand->pose, hand->pose[Joint::palm].inverse());
    const double sign = palm.side == Handedness::left ? 1.0 : -1.0;
    EXPECT_GT(sign * palm[Joint::thumb_tip].position.x(), 0.02);
  }
}

TEST_F(BvhImport, NamesOfManyPrograms) {
  for (const BvhNames& names : test::bvh_names()) {
    SCOPED_TRACE(names.program);
    const WholeRecording whole = read(bvh_text(bent_hands(3), names, {}));
    expect_hands(whole, 3, names.has_metacarpals ? 1e-5 : 0.02);
    EXPECT_EQ(warns(whole, "no metacarpals"), !names.has_metacarpals);
    EXPECT_TRUE(warns(whole, "centimetres"));
    EXPECT_EQ(whole.warnings.size(), names.has_metacarpals ? 1U : 2U) << whole.warnings.back();
  }
}

TEST_F(BvhImport, OrdersOfRotation) {
  for (const char* order : {"XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"}) {
    BvhStyle style;
    style.order = order;
    SCOPED_TRACE(order);
    expect_hands(read(bvh_text(bent_hands(3), test::bvh_names()[0], style)), 3, 0.02);
  }
}

TEST_F(BvhImport, PositionsOfEveryJointInPlaceOfItsOffset) {
  BvhStyle style;
  style.positions = BvhStyle::Positions::placed;
  expect_hands(read(bvh_text(bent_hands(3), test::bvh_names()[0], style)), 3, 0.02);
  style.positions = BvhStyle::Positions::added;
  expect_hands(read(bvh_text(bent_hands(3), test::bvh_names()[0], style)), 3, 0.02);
}

TEST_F(BvhImport, UnitsAreToldFromTheHandsLength) {
  for (const auto& [unit_m, name] : {std::pair{1.0, "metres"},
                                     {1e-2, "centimetres"},
                                     {1e-3, "millimetres"},
                                     {0.0254, "inches"}}) {
    BvhStyle style;
    style.unit_m = unit_m;
    const WholeRecording whole = read(bvh_text(bent_hands(2), test::bvh_names()[0], style));
    EXPECT_TRUE(warns(whole, std::string("it is taken to be ") + name)) << name;
    expect_hands(whole, 2, 0.02);
  }
  BvhStyle style;
  style.unit_m = 0.005;
  const WholeRecording whole = read(bvh_text(bent_hands(2), test::bvh_names()[0], style));
  EXPECT_TRUE(warns(whole, "fits no unit; it is made 92 mm long"));
  ASSERT_EQ(whole.frames.size(), 2U);
  EXPECT_NEAR(hand_length(whole.frames[0].hands[0]->pose), kGenericHandLength, 1e-6);
}

TEST_F(BvhImport, MissingJointsArePutIn) {
  for (const std::size_t left_out : {1U, 2U}) {
    BvhStyle style;
    style.joints_left_out = left_out;
    const WholeRecording whole = read(bvh_text(bent_hands(3), test::bvh_names()[0], style));
    ASSERT_EQ(whole.error, "");
    EXPECT_TRUE(warns(whole, "joints are missing (left thumb, left index"));
    ASSERT_EQ(whole.frames.size(), 3U);
    for (const auto& frame : whole.frames) {
      for (const auto& hand : frame.hands) {
        ASSERT_TRUE(hand.has_value());
        const HandPose truth = bent_hand(hand->pose.side, 0);
        for (std::size_t j = 2; j < kJointCount; ++j) {
          EXPECT_GT((hand->pose.joints[j].position - hand->pose.joints[j - 1].position).norm(),
                    0.008)
              << j;
        }
        EXPECT_NEAR(hand_length(hand->pose), hand_length(truth), 1e-5);
      }
    }
  }
  BvhStyle style;
  style.ends = false;
  const WholeRecording whole = read(bvh_text(bent_hands(1), test::bvh_names()[0], style));
  EXPECT_TRUE(warns(whole, "joints are missing"));
  ASSERT_EQ(whole.frames.size(), 1U);
  const HandPose& hand = whole.frames[0].hands[1]->pose;
  const double last = (hand[Joint::index_tip].position - hand[Joint::index_distal].position).norm();
  EXPECT_NEAR(last, 0.014, 0.008);
}

TEST_F(BvhImport, OneHandByTheNameOfItsFile) {
  BvhNames names = test::bvh_names()[0];
  const auto sided = names.joint;
  names.joint = [sided](Handedness side, Digit digit, std::size_t joint) {
    return sided(side, digit, joint).substr(side == Handedness::left ? 4 : 5);
  };
  names.wrist = [](Handedness) { return std::string("Wrist"); };
  BvhStyle style;
  style.body = false;
  std::vector<test::BvhFrame> frames(2);
  for (std::size_t i = 0; i < 2; ++i) frames[i].right = bent_hand(Handedness::right, i);
  const std::string text = bvh_text(frames, names, style);
  const WholeRecording whole = read(text, "take_right.bvh");
  EXPECT_EQ(whole.error, "");
  ASSERT_EQ(whole.frames.size(), 2U);
  EXPECT_TRUE(whole.frames[1].hands[1].has_value());
  EXPECT_FALSE(whole.frames[1].hands[0].has_value());
  EXPECT_TRUE(contains(read(text).error, "take.bvh: expected left or right in the names"));
}

TEST_F(BvhImport, BodiesWithoutFingers) {
  const std::string body =
      "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n"
      "JOINT LeftHand\n{\nOFFSET 0 9 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n"
      "End Site\n{\nOFFSET 0 8 0\n}\n}\n}\nMOTION\nFrames: 0\nFrame Time: 0.01\n";
  EXPECT_TRUE(contains(read(body).error,
                       "take.bvh: expected joints of fingers, as LeftHandIndex1, found 3 joints"));
  std::string one_finger = body;
  one_finger.insert(one_finger.find("End Site"),
                    "JOINT LeftHandIndex1\n{\nOFFSET 0 9 0\nEnd Site\n{\nOFFSET 0 8 0\n}\n}\n");
  EXPECT_TRUE(contains(read(one_finger).error,
                       "take.bvh: left hand: no joints of thumb, middle, ring, little"));
}

TEST_F(BvhImport, CutOffAndMiscounted) {
  const std::string text = bvh_text(bent_hands(4), test::bvh_names()[0], {});
  const WholeRecording cut = read(text.substr(0, text.size() - 40));
  EXPECT_EQ(cut.error, "");
  EXPECT_EQ(cut.frames.size(), 3U);
  EXPECT_TRUE(warns(cut, "cut off here; the frame is left out"));

  const std::size_t last = text.rfind('\n', text.size() - 2);
  const WholeRecording fewer = read(text.substr(0, last + 1));
  EXPECT_EQ(fewer.frames.size(), 3U);
  EXPECT_TRUE(warns(fewer, "expected 4 frames, as MOTION says, found 3"));
  const WholeRecording more = read(text + text.substr(last + 1));
  EXPECT_EQ(more.frames.size(), 5U);
  EXPECT_TRUE(warns(more, "expected 4 frames, as MOTION says, found 5"));

  EXPECT_TRUE(contains(read(text + "1 2 3\n").error,
                       " numbers, one for each channel of the "
                       "HIERARCHY, found '3'"));
  EXPECT_TRUE(
      contains(read(text.substr(0, text.find("MOTION"))).error, "found the end of the file"));
}

TEST_F(BvhImport, NumbersThatAreNone) {
  const std::string text = bvh_text(bent_hands(3), test::bvh_names()[0], {});
  const std::size_t line = text.find('\n', text.find("Frame Time")) + 1;
  std::string none = text;
  none.replace(line, none.find(' ', line) - line, "nan");
  const WholeRecording whole = read(none);
  EXPECT_EQ(whole.error, "");
  ASSERT_EQ(whole.frames.size(), 3U);
  EXPECT_FALSE(whole.frames[0].hands[0].has_value());
  EXPECT_TRUE(whole.frames[1].hands[0].has_value());
  EXPECT_TRUE(warns(whole, "left: a number is not finite; the hand is left out of the frame"));
  none.replace(line, 3, "1,5");
  EXPECT_TRUE(contains(read(none).error, "expected a number for channel 1, found '1,5'"));
}

TEST_F(BvhImport, WrongHierarchies) {
  const std::string text = bvh_text(bent_hands(1), test::bvh_names()[0], {});
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    return read(changed).error;
  };
  EXPECT_TRUE(contains(with("ROOT", "RUT"), "line 2: expected ROOT or MOTION, found 'rut'"));
  EXPECT_TRUE(
      contains(with("OFFSET 0", "OFFSET nan"), "line 4: expected OFFSET and three numbers"));
  EXPECT_TRUE(contains(with("CHANNELS 6", "CHANNELS 1000000"),
                       "line 5: expected CHANNELS and their number, 0 to 6, found '1000000'"));
  EXPECT_TRUE(contains(with("Xposition", "Wposition"), "expected a channel, as Xposition"));
  EXPECT_TRUE(contains(with("Frames: 1", "Frames: many"), "expected a number of frames"));
  EXPECT_TRUE(contains(with("Frame Time: 0.008333333333", "Frame Time: 0"),
                       "expected the seconds of a frame"));
  std::string deep = "HIERARCHY\n";
  for (int i = 0; i < 5000; ++i) deep += i == 0 ? "ROOT a\n{\n" : "JOINT a\n{\n";
  EXPECT_TRUE(contains(read(deep).error, "expected joints nested at most 200 deep"));
  std::string wide = "HIERARCHY\nROOT a\n{\n";
  for (int i = 0; i < 200'000; ++i) wide += "JOINT a\n{\nCHANNELS 6\n}\n";
  EXPECT_NE(read(wide).error, "");
  EXPECT_TRUE(contains(read("HIERARCHY\nMOTION\n").error, "expected ROOT"));
}

}  // namespace
}  // namespace nade
