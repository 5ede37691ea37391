#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "clip.h"
#include "mouse_hand.h"
#include "nade/eval/synth.h"
#include "nade/io/hand_file.h"
#include "script.h"
#include "session.h"

namespace nade::viewer {
namespace {

constexpr double kStep_s = 1.0 / 60.0;
constexpr double kDegree = std::numbers::pi / 180.0;

const bool kAssetsNamed = [] {
  return ::setenv("NADE_ASSETS", NADE_TEST_HANDS_DIR "/..", 1) == 0;
}();

HandPose relaxed_hand() {
  Result<HandPose> hand = load_relaxed_hand(Handedness::right);
  EXPECT_TRUE(hand.ok());
  return std::move(hand).value();
}

/// From above, with -Z up in the picture.
Aim from_above(double x, double z) {
  Aim aim;
  aim.ray = Ray{Vec3(x, 0.5, z), -Vec3::UnitY()};
  aim.viewer_ahead = -Vec3::UnitY();
  aim.viewer_up = -Vec3::UnitZ();
  return aim;
}

Vec3 palm_skin_of(const HandPose& hand) { return *palm_skin(hand); }

class MouseHandTest : public testing::Test {
 protected:
  MouseHandTest() : hand_(relaxed_hand()) { hand_.place(plane_object_, {}); }

  HandPose rest(const Object& object, const Aim& aim, double seconds) {
    HandPose pose;
    for (double t = 0.0; t < seconds; t += kStep_s) pose = hand_.update(object, aim, kStep_s);
    return pose;
  }

  PlaneSurface plane_;
  Object plane_object_{plane_};
  MouseHand hand_;
};

TEST_F(MouseHandTest, PalmSkinLiesUnderTheCursorAtTheDepthSet) {
  hand_.settings().depth_m = 0.015;
  const HandPose pose = rest(plane_object_, from_above(0.1, -0.05), 1.0);
  EXPECT_TRUE(is_usable(pose));
  EXPECT_LT((palm_skin_of(pose) - Vec3(0.1, -0.015, -0.05)).norm(), 1e-3);
  EXPECT_GT(pose.back().y(), 0.999);
}

TEST_F(MouseHandTest, FingersPointAwayFromTheViewer) {
  const HandPose pose = rest(plane_object_, from_above(0.0, 0.0), 1.0);
  const Vec3 ahead = pose[Joint::palm].rotation * -Vec3::UnitZ();
  EXPECT_GT(ahead.dot(-Vec3::UnitZ()), 0.85);
  EXPECT_LT(ahead.x(), -0.4) << "a right hand comes from the right";
  hand_.settings().turn_rad = 90.0 * kDegree;
  const HandPose turned = rest(plane_object_, from_above(0.0, 0.0), 1.0);
  const Vec3 now = turned[Joint::palm].rotation * -Vec3::UnitZ();
  EXPECT_NEAR(std::acos(now.dot(ahead)), 90.0 * kDegree, 0.5 * kDegree);
  EXPECT_GT(ahead.cross(now).y(), 0.99);
}

TEST_F(MouseHandTest, FingersFollowTheMotionWhereAsked) {
  hand_.settings().heading = Heading::with_motion;
  HandPose pose;
  for (int i = 0; i < 120; ++i) {
    pose = hand_.update(plane_object_, from_above(0.15 * i * kStep_s, 0.0), kStep_s);
  }
  EXPECT_GT((pose[Joint::palm].rotation * -Vec3::UnitZ()).dot(Vec3::UnitX()), 0.95);
}

TEST_F(MouseHandTest, StrokeLagsLessThanTwoFrames) {
  constexpr double kSpeed = 0.2;
  HandPose pose;
  double x = 0.0;
  for (int i = 0; i < 90; ++i) {
    x = kSpeed * i * kStep_s;
    pose = hand_.update(plane_object_, from_above(x, 0.0), kStep_s);
  }
  EXPECT_LT((x - palm_skin_of(pose).x()) / kSpeed, 2.0 * kStep_s);
}

TEST_F(MouseHandTest, StillCursorThatTremblesByAPixelIsSteadied) {
  rest(plane_object_, from_above(0.0, 0.0), 0.5);
  double largest = 0.0;
  Vec3 before = palm_skin_of(hand_.update(plane_object_, from_above(0.0, 0.0), kStep_s));
  for (int i = 0; i < 60; ++i) {
    const double x = i % 2 == 0 ? 0.001 : 0.0;
    const Vec3 now = palm_skin_of(hand_.update(plane_object_, from_above(x, 0.0), kStep_s));
    largest = std::max(largest, (now - before).norm());
    before = now;
  }
  EXPECT_LT(largest, 0.0006);
}

TEST_F(MouseHandTest, LeapOfTheCursorDoesNotFlingTheHand) {
  rest(plane_object_, from_above(0.0, 0.0), 0.5);
  Vec3 before = palm_skin_of(hand_.update(plane_object_, from_above(0.0, 0.0), kStep_s));
  for (int i = 0; i < 30; ++i) {
    const Vec3 now = palm_skin_of(hand_.update(plane_object_, from_above(1.0, 0.0), kStep_s));
    EXPECT_LT((now - before).norm() / kStep_s, 2.6);
    before = now;
  }
}

TEST_F(MouseHandTest, BesideTheObjectTheHandIsFree) {
  const SphereSurface sphere(0.1);
  const Object ball(sphere);
  hand_.place(ball, {Vec3(0.0, 0.1, 0.0), Quat::Identity()});
  rest(ball, from_above(0.0, 0.0), 0.5);
  const HandPose pose = rest(ball, from_above(0.25, 0.0), 1.0);
  EXPECT_GT(palm_skin_of(pose).norm(), 0.13);
  EXPECT_TRUE(is_usable(pose));
}

TEST_F(MouseHandTest, CurlsSpreadsTiltsAndChangesSides) {
  const HandPose flat = rest(plane_object_, from_above(0.0, 0.0), 1.0);
  hand_.settings().shape.curl = 1.0;
  hand_.settings().tilt_rad = 20.0 * kDegree;
  const HandPose curled = rest(plane_object_, from_above(0.0, 0.0), 1.0);
  const auto bend = [](const HandPose& hand) {
    return measure_angles(hand)[index_of(Digit::middle)][1].flexion;
  };
  EXPECT_NEAR(bend(curled) - bend(flat), 27.0 * kDegree, 0.5 * kDegree);
  EXPECT_NEAR(curled.back().y(), std::cos(20.0 * kDegree), 1e-3);
  hand_.settings().side = Handedness::left;
  const HandPose left = rest(plane_object_, from_above(0.0, 0.0), 0.1);
  EXPECT_EQ(left.side, Handedness::left);
  EXPECT_TRUE(is_usable(left));
}

TEST_F(MouseHandTest, WildCursorsGiveUsableHands) {
  Result<LoadedObject> dog = load_object("dog");
  ASSERT_TRUE(dog.ok());
  const Object object = dog->placed();
  hand_.place(object, dog->place()->pose);
  Random random(7);
  for (int i = 0; i < 2'000; ++i) {
    Aim aim;
    const Vec3 direction(random.normal(), random.normal(), random.normal());
    if (i % 7 != 0) aim.ray = Ray{-1.5 * direction.normalized(), direction.normalized()};
    aim.viewer_ahead = direction.normalized();
    aim.viewer_up = direction.unitOrthogonal();
    ASSERT_TRUE(is_usable(hand_.update(object, aim, i % 3 == 0 ? 0.1 : 1e-4))) << i;
  }
}

/// Recordings in a folder of its own.
class RecordedTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = testing::TempDir() + "nade_viewer_XXXXXX";
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// A stroke of the object, which the header names; its frames are returned, too.
  std::vector<RecordedFrame> make_stroke(const std::string& name, const std::string& spec) const {
    const Result<LoadedObject> object = load_object(spec);
    SynthOptions options;
    options.duration_s = 1.0;
    Result<StrokeSynth> synth = StrokeSynth::create(*object, {}, relaxed_hand(), options);
    Result<RecordingWriter> writer = RecordingWriter::create(path(name), synth->header());
    std::vector<RecordedFrame> frames;
    while (std::optional<RecordedFrame> frame = synth->next()) {
      EXPECT_TRUE(writer->write(*frame).ok());
      frames.push_back(*frame);
    }
    EXPECT_TRUE(writer->finish().ok());
    return frames;
  }

  static Session::Setup session_setup() {
    Session::Setup setup;
    for (const Handedness side : {Handedness::left, Handedness::right}) {
      const std::string file =
          std::string(NADE_TEST_HANDS_DIR "/") + std::string(name_of(side)) + ".glb";
      setup.meshes[index_of(side)] = *load_hand_mesh(file, side);
    }
    setup.relaxed = relaxed_hand();
    setup.timing = Timing::none;
    return setup;
  }

  /// Until a recording that was opened is read and shown.
  static void begin(Session& session) {
    session.clip()->wait();
    session.advance(1e-6, {});
  }

  std::filesystem::path folder_;
};

TEST_F(RecordedTest, EveryFrameOfAClipIsTheRecordings) {
  const std::vector<RecordedFrame> frames = make_stroke("a.jsonl.gz", "plane");
  const Result<Clip> clip = Clip::open(path("a.jsonl.gz"));
  ASSERT_TRUE(clip.ok());
  clip->wait();
  EXPECT_FALSE(clip->failure());
  ASSERT_EQ(clip->size(), frames.size());
  for (const std::size_t i : {std::size_t{0}, frames.size() - 1, std::size_t{17}}) {
    const ClipFrame frame = clip->frame(i);
    EXPECT_EQ(frame.time_ns, frames[i].time_ns - frames[0].time_ns);
    EXPECT_FALSE(frame.hands[0]);
    ASSERT_TRUE(frame.hands[1]);
    for (std::size_t joint = 0; joint < kJointCount; ++joint) {
      EXPECT_LT(
          (frame.hands[1]->joints[joint].position - frames[i].hands[1]->pose.joints[joint].position)
              .norm(),
          1e-6);
    }
    EXPECT_EQ(clip->index_at(frame.time_ns), i);
  }
  EXPECT_EQ(clip->index_at(-5), 0U);
}

TEST_F(RecordedTest, ClipThatBreaksOffIsShownUpToThere) {
  make_stroke("a.jsonl", "plane");
  std::ofstream(path("a.jsonl"), std::ios::app) << "{\"t\":99999999999,\"right\":7}\n";
  const Result<Clip> clip = Clip::open(path("a.jsonl"));
  ASSERT_TRUE(clip.ok());
  clip->wait();
  EXPECT_EQ(clip->size(), 90U);
  ASSERT_TRUE(clip->failure());
  EXPECT_NE(clip->failure()->message.find("line 92"), std::string::npos);
}

TEST_F(RecordedTest, PlayingCorrectsAsTheCorrectorDoes) {
  const std::vector<RecordedFrame> frames = make_stroke("a.jsonl", "sphere");
  Session session(session_setup());
  ASSERT_TRUE(session.show_object("plane").ok());
  ASSERT_TRUE(session.open_clip(path("a.jsonl")).ok());
  begin(session);
  EXPECT_EQ(session.loaded().spec, "sphere") << "the header names it";
  session.playback().loop = false;
  const Result<LoadedObject> sphere = load_object("sphere");
  HandCorrector corrector(session.corrector());
  CorrectedHand last;
  for (const RecordedFrame& frame : frames) {
    last = corrector.update(frame.hands[1]->pose, sphere->placed(), frame.time_ns);
  }
  while (session.playback().playing) session.advance(kStep_s, {});
  ASSERT_TRUE(session.hands()[1]);
  EXPECT_EQ(session.playback().index, frames.size() - 1);
  for (std::size_t joint = 0; joint < kJointCount; ++joint) {
    EXPECT_LT(
        (session.hands()[1]->corrected.joints[joint].position - last.pose.joints[joint].position)
            .norm(),
        1e-4);
  }
}

TEST_F(RecordedTest, SeeksStepsAndLoops) {
  make_stroke("a.jsonl", "plane");
  Session session(session_setup());
  ASSERT_TRUE(session.show_object("plane").ok());
  ASSERT_TRUE(session.open_clip(path("a.jsonl")).ok());
  begin(session);
  session.seek(40);
  EXPECT_EQ(session.playback().index, 40U);
  session.step(-1);
  EXPECT_EQ(session.playback().index, 39U);
  EXPECT_FALSE(session.playback().playing);
  session.step(1);
  EXPECT_EQ(session.playback().index, 40U);
  session.seek(10'000);
  EXPECT_EQ(session.playback().index, 89U);
  session.playback().playing = true;
  session.advance(0.1, {});
  EXPECT_EQ(session.playback().index, 0U) << "from the end to the start";
  session.playback().speed = 0.1;
  session.advance(kStep_s, {});
  EXPECT_EQ(session.playback().index, 0U) << "a tenth of a frame";
}

TEST_F(RecordedTest, MethodsShowInTheFigures) {
  make_stroke("a.jsonl", "plane");
  Session session(session_setup());
  ASSERT_TRUE(session.show_object("plane").ok());
  ASSERT_TRUE(session.open_clip(path("a.jsonl")).ok());
  begin(session);
  const auto penetration = [&](Method method) {
    CorrectorOptions options = session.corrector();
    options.method = method;
    session.set_corrector(options);
    session.seek(45);
    return session.figures().of(Figure::penetration).last().value_or(-1.0);
  };
  const double none = penetration(Method::none);
  const double paper = penetration(Method::paper);
  EXPECT_GT(none, 20.0);
  EXPECT_LT(paper, 0.7 * none);
  EXPECT_GE(paper, 0.0);
}

TEST_F(RecordedTest, PressMovesTheObjectAgainstThePalms) {
  make_stroke("a.jsonl", "plane");
  Session session(session_setup());
  ASSERT_TRUE(session.show_object("plane").ok());
  ASSERT_TRUE(session.open_clip(path("a.jsonl")).ok());
  begin(session);
  EXPECT_FALSE(session.press_m()) << "stands as recorded";
  ASSERT_TRUE(session.press(0.035).ok());
  EXPECT_NEAR(median_depth(session.object(), session.clip()->palms().frames()), 0.035, 1e-3);
  ASSERT_TRUE(session.show_object("dog").ok());
  EXPECT_NEAR(median_depth(session.object(), session.clip()->palms().frames()), 0.035, 1e-3);
}

TEST_F(RecordedTest, WhatCannotBeOpenedLeavesEverythingAsItWas) {
  make_stroke("a.jsonl", "sphere");
  std::ofstream(path("bad.jsonl")) << "nonsense\n";
  std::ofstream(path("bad.obj")) << "v 0 0 0\n";
  Session session(session_setup());
  ASSERT_TRUE(session.show_object("sphere").ok());
  ASSERT_TRUE(session.open_any(path("a.jsonl")).ok());
  begin(session);
  session.seek(30);
  for (const char* const name : {"bad.jsonl", "bad.obj", "nothing.glb"}) {
    const Status opened = session.open_any(path(name));
    ASSERT_FALSE(opened.ok()) << name;
    EXPECT_NE(opened.error().message.find(name), std::string::npos) << opened.error().message;
    EXPECT_EQ(session.loaded().spec, "sphere");
    ASSERT_NE(session.clip(), nullptr);
    EXPECT_EQ(session.playback().index, 30U);
    EXPECT_TRUE(session.hands()[1]);
  }
}

TEST_F(RecordedTest, ADroppedFileIsWhatItsContentSays) {
  make_stroke("recording.obj", "plane");
  std::ofstream(path("pyramid.obj")) << "v -1 0 -1\nv 1 0 -1\nv 0 0 1\nv 0 1 0\n"
                                        "f 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n";
  Session session(session_setup());
  ASSERT_TRUE(session.show_object("plane").ok());
  ASSERT_TRUE(session.open_any(path("pyramid.obj")).ok());
  EXPECT_EQ(session.loaded().spec, path("pyramid.obj"));
  EXPECT_EQ(session.clip(), nullptr);
  ASSERT_TRUE(session.open_any(path("recording.obj")).ok());
  EXPECT_NE(session.clip(), nullptr);
}

TEST_F(RecordedTest, MouseHandIsBackWhenTheRecordingIsPutAway) {
  make_stroke("a.jsonl", "plane");
  Session session(session_setup());
  ASSERT_TRUE(session.show_object("sphere").ok());
  ASSERT_TRUE(session.open_clip(path("a.jsonl")).ok());
  begin(session);
  session.close_clip();
  EXPECT_EQ(session.clip(), nullptr);
  for (int i = 0; i < 30; ++i) session.advance(kStep_s, {});
  ASSERT_TRUE(session.hands()[1]);
  EXPECT_GT(session.figures().of(Figure::penetration).values().size(), 20U);
}

TEST(Script, SaysWhatHappensInWhichFrame) {
  const auto steps = parse_script(
      "# a stroke\n2 click method:none\n0 move 10 20\n1 glide 30 40 2  # right and down\n\n"
      "3 key ?\n3 wheel -2\n4 drop a file.jsonl\n",
      "x");
  ASSERT_TRUE(steps.ok());
  ASSERT_EQ(steps->size(), 8U);
  EXPECT_EQ(steps->at(1).frame, 1U);
  EXPECT_DOUBLE_EQ(std::get<Event>(steps->at(1).act).x, 20.0);
  EXPECT_DOUBLE_EQ(std::get<Event>(steps->at(3).act).y, 40.0);
  EXPECT_EQ(std::get<ScriptedClick>(steps->at(2).act).widget, "method:none");
  EXPECT_EQ(std::get<Event>(steps->back().act).path, "a file.jsonl");
}

TEST(Script, ErrorNamesTheLine) {
  for (const char* const bad : {"0 move 1", "x move 1 2", "0 dance", "0 key banana", "0 click a 2",
                                "0 down left foot", "0 glide 1 2 0", "-1 wheel 1", "0"}) {
    const auto steps = parse_script(std::string("\n") + bad, "moves.txt");
    ASSERT_FALSE(steps.ok()) << bad;
    EXPECT_EQ(steps.error().message.rfind("moves.txt: line 2: expected", 0), 0U)
        << steps.error().message;
  }
}

}  // namespace
}  // namespace nade::viewer
