#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "clip.h"
#include "nade/eval/synth.h"
#include "nade/io/hand_file.h"
#include "script.h"
#include "session.h"
#include "support/files.h"
#include "support/scratch_folder.h"
#include "support/viewer_assets.h"

namespace nade::viewer {
namespace {

constexpr double kPicture_s = 1.0 / 60.0;

/// Recordings in a folder of its own.
class RecordedTest : public test::FolderTest {
 protected:
  /// A stroke of the object, which the header names, by a hand `size` times the generic one; its
  /// frames are returned, too.
  std::vector<RecordedFrame> make_stroke(const std::string& name, const std::string& spec,
                                         double size = 1.0) const {
    const Result<LoadedObject> object = load_object(spec);
    SynthOptions options;
    options.duration_s = 1.0;
    Result<StrokeSynth> synth = StrokeSynth::create(*object, {}, test::relaxed_hand(), options);
    Result<RecordingWriter> writer = RecordingWriter::create(path(name), synth->header());
    std::vector<RecordedFrame> frames;
    while (std::optional<RecordedFrame> frame = synth->next()) {
      HandPose& hand = frame->hands[1]->pose;
      const Vec3 palm = hand[Joint::palm].position;
      for (Pose& joint : hand.joints) joint.position = palm + size * (joint.position - palm);
      EXPECT_TRUE(writer->write(*frame).ok());
      frames.push_back(*frame);
    }
    EXPECT_TRUE(writer->finish().ok());
    return frames;
  }

  /// As if what `from` has were corrected already; `keys` are the header's, too.
  void call_corrected(const std::string& from, const std::string& to,
                      const std::string& keys = "") const {
    std::string text = test::read_file(path(from));
    text.insert(text.find('\n') - 1, ",\"method\":\"nade\"" + keys);
    test::write_file(path(to), text);
  }

  static Session::Setup session_setup() {
    Session::Setup setup;
    for (const Handedness side : {Handedness::left, Handedness::right}) {
      const std::string file =
          std::string(NADE_TEST_HANDS_DIR "/") + std::string(name_of(side)) + ".glb";
      setup.meshes[index_of(side)] = *load_hand_mesh(file, side);
    }
    setup.relaxed = test::relaxed_hand();
    setup.timing = Timing::none;
    return setup;
  }

  /// Until a recording that was opened is read and shown.
  static void begin(Session& session) {
    session.clip()->wait();
    session.advance(1e-6, {});
  }

  /// With a plane until the recording names another object.
  void play(Session& session, const std::string& name) {
    ASSERT_TRUE(session.show_object("plane").ok());
    ASSERT_TRUE(session.open_clip(path(name)).ok());
    begin(session);
  }
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
  ASSERT_NO_FATAL_FAILURE(play(session, "a.jsonl"));
  EXPECT_EQ(session.loaded().spec, "sphere") << "the header names it";
  session.playback().loop = false;
  const Result<LoadedObject> sphere = load_object("sphere");
  HandCorrector corrector(session.corrector());
  CorrectedHand last;
  for (const RecordedFrame& frame : frames) {
    last = corrector.update(frame.hands[1]->pose, sphere->placed(), frame.time_ns);
  }
  while (session.playback().playing) session.advance(kPicture_s, {});
  ASSERT_TRUE(session.hands()[1]);
  EXPECT_EQ(session.playback().index, frames.size() - 1);
  for (std::size_t joint = 0; joint < kJointCount; ++joint) {
    EXPECT_LT(
        (session.hands()[1]->corrected.joints[joint].position - last.pose.joints[joint].position)
            .norm(),
        1e-4);
  }
}

TEST_F(RecordedTest, ALivingObjectMovesWithTheRecording) {
  make_stroke("a.jsonl", "dog:alive");
  Session session(session_setup());
  ASSERT_NO_FATAL_FAILURE(play(session, "a.jsonl"));
  session.playback().loop = false;
  while (session.playback().playing) session.advance(kPicture_s, {});
  Result<LoadedObject> dog = load_object("dog:alive");
  ASSERT_TRUE(dog.ok());
  for (const std::size_t index : {session.playback().index, std::size_t{40}}) {
    session.seek(index);
    dog->move_to(1e-9 * static_cast<double>(session.clip()->time_ns(index)));
    EXPECT_TRUE(session.loaded().soup->vertices == dog->soup->vertices) << index;
  }
  session.close_clip();
  const auto before = session.loaded().soup->vertices;
  session.advance(kPicture_s, {});
  EXPECT_FALSE(session.loaded().soup->vertices == before) << "with the mouse's hand, too";
}

TEST_F(RecordedTest, SeeksStepsAndLoops) {
  make_stroke("a.jsonl", "plane");
  Session session(session_setup());
  ASSERT_NO_FATAL_FAILURE(play(session, "a.jsonl"));
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
  session.advance(kPicture_s, {});
  EXPECT_EQ(session.playback().index, 0U) << "a tenth of a frame";
}

TEST_F(RecordedTest, PlaysAnewFromTheEnd) {
  make_stroke("a.jsonl", "plane");
  Session session(session_setup());
  ASSERT_NO_FATAL_FAILURE(play(session, "a.jsonl"));
  session.playback().loop = false;
  while (session.playback().playing) session.advance(kPicture_s, {});
  session.play_or_pause();
  session.advance(kPicture_s, {});
  EXPECT_TRUE(session.playback().playing);
  EXPECT_LT(session.playback().index, 5U);
  session.play_or_pause();
  EXPECT_FALSE(session.playback().playing);
}

TEST_F(RecordedTest, MethodsShowInTheFigures) {
  make_stroke("a.jsonl", "plane");
  Session session(session_setup());
  ASSERT_NO_FATAL_FAILURE(play(session, "a.jsonl"));
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
  ASSERT_NO_FATAL_FAILURE(play(session, "a.jsonl"));
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

TEST_F(RecordedTest, RecordingWithoutFramesGivesWayToTheOneBefore) {
  make_stroke("a.jsonl", "plane");
  std::ofstream(path("empty.jsonl")) << "{\"format\":\"nade-recording\",\"version\":1}\n";
  Session session(session_setup());
  ASSERT_TRUE(session.show_object("plane").ok());
  ASSERT_TRUE(session.open_any(path("empty.jsonl")).ok());
  begin(session);
  EXPECT_EQ(session.clip(), nullptr) << "there was none: the mouse's hand";
  ASSERT_EQ(session.take_notices().size(), 1U);
}

TEST_F(RecordedTest, ABrokenRecordingLeavesTheOneBeforeWhereItWas) {
  make_stroke("a.jsonl", "plane");
  make_stroke("bad.jsonl", "sphere");
  std::ofstream(path("bad.jsonl"), std::ios::app) << "{\"t\":99999999999,\"right\":7}\n";
  std::ofstream(path("empty.jsonl")) << "{\"format\":\"nade-recording\",\"version\":1}\n";
  Session session(session_setup());
  ASSERT_TRUE(session.show_object("plane").ok());
  ASSERT_TRUE(session.open_any(path("a.jsonl")).ok());
  begin(session);
  session.step(30);
  const Vec3 drawn = session.hands()[1]->corrected[Joint::palm].position;
  const std::size_t measured = session.figures().of(Figure::penetration).values().size();
  for (const char* const name : {"empty.jsonl", "bad.jsonl"}) {
    ASSERT_TRUE(session.open_any(path(name)).ok());
    begin(session);
    const std::vector<std::string> notices = session.take_notices();
    ASSERT_EQ(notices.size(), 1U);
    EXPECT_NE(notices[0].find(name), std::string::npos) << notices[0];
    ASSERT_NE(session.clip(), nullptr);
    EXPECT_EQ(session.clip()->path(), path("a.jsonl"));
    EXPECT_EQ(session.loaded().spec, "plane");
    EXPECT_EQ(session.playback().index, 30U);
    EXPECT_FALSE(session.playback().playing);
    ASSERT_TRUE(session.hands()[1]);
    EXPECT_EQ(session.hands()[1]->corrected[Joint::palm].position, drawn);
    EXPECT_EQ(session.figures().of(Figure::penetration).values().size(), measured);
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

TEST_F(RecordedTest, ADroppedMeshThatIsBrokenSaysWhatIsWrongWithTheMesh) {
  std::ofstream(path("BROKEN.OBJ")) << "v 0 0 0\n";
  Session session(session_setup());
  ASSERT_TRUE(session.show_object("plane").ok());
  const Status opened = session.open_any(path("BROKEN.OBJ"));
  ASSERT_FALSE(opened.ok());
  EXPECT_NE(opened.error().message.find("expected triangles"), std::string::npos)
      << opened.error().message;
}

TEST_F(RecordedTest, MouseHandIsBackWhenTheRecordingIsPutAway) {
  make_stroke("a.jsonl", "plane");
  Session session(session_setup());
  ASSERT_TRUE(session.show_object("sphere").ok());
  ASSERT_TRUE(session.open_clip(path("a.jsonl")).ok());
  begin(session);
  session.close_clip();
  EXPECT_EQ(session.clip(), nullptr);
  for (int i = 0; i < 30; ++i) session.advance(kPicture_s, {});
  ASSERT_TRUE(session.hands()[1]);
  EXPECT_GT(session.figures().of(Figure::penetration).values().size(), 20U);
}

TEST_F(RecordedTest, MouseHandIsNoChildsAfterAChildsRecording) {
  make_stroke("a.jsonl", "plane", 0.6);
  Session session(session_setup());
  ASSERT_TRUE(session.show_object("plane").ok());
  session.advance(kPicture_s, {});
  ASSERT_TRUE(session.hands()[1]);
  const double own_scale = session.hands()[1]->scale.value_or(0.0);
  ASSERT_TRUE(session.open_clip(path("a.jsonl")).ok());
  begin(session);
  ASSERT_TRUE(session.hands()[1]);
  EXPECT_NEAR(session.hands()[1]->scale.value_or(0.0), 0.6 * own_scale, 1e-3);
  session.close_clip();
  session.advance(kPicture_s, {});
  ASSERT_TRUE(session.hands()[1]);
  EXPECT_EQ(session.hands()[1]->scale, own_scale);
}

TEST_F(RecordedTest, ACorrectedRecordingSetsTheMethodAsideForAWhile) {
  make_stroke("a.jsonl", "plane");
  call_corrected("a.jsonl", "c.jsonl");
  Session session(session_setup());
  ASSERT_TRUE(session.show_object("plane").ok());
  const auto method_under = [&](const char* name) {
    EXPECT_TRUE(session.open_clip(path(name)).ok());
    begin(session);
    return session.corrector().method;
  };
  EXPECT_EQ(method_under("c.jsonl"), Method::none);
  EXPECT_EQ(method_under("a.jsonl"), Method::nade);
  EXPECT_EQ(method_under("c.jsonl"), Method::none);
  session.close_clip();
  EXPECT_EQ(session.corrector().method, Method::nade);
  EXPECT_EQ(method_under("c.jsonl"), Method::none);
  CorrectorOptions chosen = session.corrector();
  chosen.method = Method::paper;
  session.set_corrector(chosen);
  EXPECT_EQ(method_under("a.jsonl"), Method::paper) << "chosen by hand meanwhile";
}

TEST_F(RecordedTest, ACorrectedRecordingsObjectIsAsSoftAndAsFarOnAsItWas) {
  make_stroke("a.jsonl", "dog:alive");
  call_corrected("a.jsonl", "c.jsonl", ",\"softness\":0.006,\"animation_start\":-500000000");
  Session session(session_setup());
  ASSERT_NO_FATAL_FAILURE(play(session, "c.jsonl"));
  EXPECT_EQ(session.softness_m(), 0.006);
  session.seek(40);
  const std::int64_t time_ns = session.clip()->start_ns() + session.clip()->time_ns(40);
  Result<LoadedObject> dog = load_object("dog:alive");
  dog->move_to(1e-9 * static_cast<double>(time_ns + 500'000'000));
  EXPECT_TRUE(session.loaded().soup->vertices == dog->soup->vertices);
  session.close_clip();
  EXPECT_EQ(session.softness_m(), 0.0);
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
