// What hands do beside strokes: the files of tests/scenes, and what becomes of them.

#include "nade/eval/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>

#include "nade/eval/compare.h"
#include "nade/eval/suite.h"
#include "support/hand_checks.h"
#include "support/sanitized.h"
#include "support/scratch_folder.h"

namespace {

using namespace nade;

class Scenes : public testing::Test {
 protected:
  /// Where the hands and the dog were built.
  static void SetUpTestSuite() {
    const std::string hands = NADE_TEST_HANDS_DIR;
    ::setenv("NADE_ASSETS", hands.substr(0, hands.rfind('/')).c_str(), 1);
  }

  /// The scene of a file of these words; the error names the file.
  Result<BenchScene> read(const std::string& words) {
    const std::string path = folder_.path("scene.json");
    std::ofstream(path) << words;
    return read_scene(path);
  }
  /// A scene as a recording of its hand and what it touches.
  struct Played {
    SuiteObject object;
    CaseRecording recording;
  };
  static Played play(const BenchScene& scene) {
    Result<SuiteObject> object = load_scene_object(scene);
    EXPECT_TRUE(object.ok()) << object.error().message;
    Result<CaseRecording> recording = make_scene_recording(scene, *object);
    EXPECT_TRUE(recording.ok()) << recording.error().message;
    return {std::move(object).value(), std::move(recording).value()};
  }

  test::ScratchFolder folder_;
};

const HandPose& right_hand(const RecordedFrame& frame) { return frame.hands[1]->pose; }

/// `nade` over every scene gives hands that can be drawn, and the tracked hand is where the scene
/// has it: not beside the object, nor deeper in it than meant.
TEST_F(Scenes, EveryFileIsPlayed) {
  const auto scenes = read_scenes(NADE_TEST_SCENES_DIR);
  ASSERT_TRUE(scenes.ok()) << scenes.error().message;
  EXPECT_GE(scenes->size(), 45u);
  const Result<DrawnHands> hands = load_drawn_hands();
  ASSERT_TRUE(hands.ok()) << hands.error().message;
  const std::vector<ComparedMethod> methods = library_methods();
  const auto none = std::ranges::find(methods, "none", &ComparedMethod::name);
  const auto nade = std::ranges::find(methods, "nade", &ComparedMethod::name);
  for (const std::shared_ptr<const BenchScene>& scene : *scenes) {
    SCOPED_TRACE(scene->name);
    EXPECT_FALSE(scene->what.empty());
    if (test::kSanitized && scene->object == "dog") continue;  // as the others, and slow
    const Played played = play(*scene);
    const CorrectedRecording tracked = correct(played.recording, played.object, *hands, *none);
    const Metrics metrics = measure(played.recording, played.object, *hands, tracked);
    const double deepest_mm = metrics.penetration_max_mm.value_or(0.0);
    EXPECT_GE(deepest_mm, 1e3 * scene->depth_least_m);
    EXPECT_LE(deepest_mm, 1e3 * scene->depth_most_m);
    const CorrectedRecording drawn = correct(played.recording, played.object, *hands, *nade);
    for (const RecordedFrame& frame : drawn.frames) {
      for (const auto& hand : frame.hands) {
        if (!hand) continue;
        ASSERT_TRUE(test::all_finite(hand->pose)) << frame.time_ns;
      }
    }
  }
}

/// They went through each other by 5 to 13 mm.
TEST_F(Scenes, FingersKeepOutOfEachOther) {
  const Result<DrawnHands> hands = load_drawn_hands();
  ASSERT_TRUE(hands.ok()) << hands.error().message;
  const std::vector<ComparedMethod> methods = library_methods();
  const auto nade = std::ranges::find(methods, "nade", &ComparedMethod::name);
  for (const std::string name : {"wrap_pole", "fist_on_table"}) {
    SCOPED_TRACE(name);
    const Result<BenchScene> scene = read_scene(NADE_TEST_SCENES_DIR "/" + name + ".json");
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    const Played played = play(*scene);
    const CorrectedRecording drawn = correct(played.recording, played.object, *hands, *nade);
    const Metrics metrics = measure(played.recording, played.object, *hands, drawn);
    EXPECT_LT(metrics.overlap_p99_mm.value_or(1e3), 2.0);
  }
}

TEST_F(Scenes, TheSuiteHasThem) {
  const auto scenes = read_scenes(NADE_TEST_SCENES_DIR);
  ASSERT_TRUE(scenes.ok()) << scenes.error().message;
  const std::vector<SuiteCase> without = suite_cases({});
  const std::vector<SuiteCase> with = suite_cases({.scenes = *scenes});
  EXPECT_EQ(with.size(), without.size() + scenes->size());
  EXPECT_EQ(with.back().name(), "scene/" + scenes->back()->name);
  EXPECT_FALSE(with.back().is_held_out());
  EXPECT_FALSE(with.back().is_flat());
  const std::size_t quick = suite_cases({.size = SuiteSize::quick}).size();
  EXPECT_EQ(suite_cases({.size = SuiteSize::quick, .scenes = *scenes}).size(), quick);
}

TEST_F(Scenes, KeysPutAnchorsWhereTheySay) {
  const Result<BenchScene> scene = read(R"({"object": "plane", "depth": [0, 1], "path": [
    {"t": 0, "at": [0, 0.05, 0.1]},
    {"t": 1, "at": [0.1, 0.02, 0], "of": "index_tip", "turn": [-30, 0, 0]},
    {"t": 2, "at": [0, -0.01, 0], "of": "lowest", "gesture": "fist"}]})");
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  const Played played = play(*scene);
  ASSERT_EQ(played.recording.frames.size(), 181u);
  const HandPose& first = right_hand(played.recording.frames.front());
  EXPECT_NEAR(first[Joint::palm].position.z(), 0.1, 1e-9);
  EXPECT_GT(first[Joint::palm].position.y(), 0.05) << "its skin is at 50 mm";
  const HandPose& second = right_hand(played.recording.frames[90]);
  EXPECT_LT((second[Joint::index_tip].position - Vec3(0.1, 0.02, 0.0)).norm(), 1e-9);
  EXPECT_LT((second[Joint::palm].rotation * -Vec3::UnitZ()).y(), -0.4) << "fingertips down";
  const Result<DrawnHands> hands = load_drawn_hands();
  ASSERT_TRUE(hands.ok()) << hands.error().message;
  const HandPose& last = right_hand(played.recording.frames.back());
  EXPECT_NEAR(test::lowest_skin(last, played.object.loaded.placed(), 0.3), -0.01, 0.001);
  EXPECT_GT(curl_of(measure_angles(last)), 100.0 * kDegree);
}

TEST_F(Scenes, RepeatsAndLeftHands) {
  const std::string path = R"("object": "plane", "depth": [0, 1], "rate": 30, "path": [
    {"t": 0, "at": [0.2, 0.1, 0]}, {"t": 0.5, "at": [0.2, 0.05, 0]},
    {"t": 1, "at": [0.2, 0.1, 0], "from": 0, "repeat": 3}, {"t": 4, "at": [0.2, 0.3, 0]}]})";
  const Result<BenchScene> right = read("{" + path);
  const Result<BenchScene> left = read(R"({"hand": "left", )" + path);
  ASSERT_TRUE(right.ok()) << right.error().message;
  ASSERT_TRUE(left.ok()) << left.error().message;
  EXPECT_EQ(right->path.size(), 8u);
  const Played played = play(*right);
  EXPECT_EQ(played.recording.frames.size(), 121u);
  const auto height = [&](std::size_t frame) {
    return right_hand(played.recording.frames[frame])[Joint::palm].position.y();
  };
  EXPECT_NEAR(height(15), height(45), 1e-9);
  EXPECT_NEAR(height(15), height(75), 1e-9);
  EXPECT_NEAR(height(90) - height(15), 0.05, 1e-9);
  const Played mirror = play(*left);
  const auto& hand = mirror.recording.frames[40].hands;
  ASSERT_TRUE(hand[0] && !hand[1]);
  const HandPose back = mirrored(hand[0]->pose);
  const HandPose& own = right_hand(played.recording.frames[40]);
  for (std::size_t i = 0; i < kJointCount; ++i) {
    EXPECT_LT((back.joints[i].position - own.joints[i].position).norm(), 1e-9);
  }
}

TEST_F(Scenes, TrackersErr) {
  const Result<BenchScene> scene = read(R"({"object": "plane", "hand": "right", "depth": [0, 1],
    "path": [{"t": 0, "at": [0.2, 0.1, 0]}, {"t": 2, "at": [0.2, 0.1, 0]}],
    "faults": [{"t": 0.5, "lost_ms": 40}, {"t": 1, "swapped_ms": 100},
               {"t": 1.5, "glitch_frames": 3, "shift": [0, 0.2, 0]}]})");
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  const std::vector<RecordedFrame> frames = play(*scene).recording.frames;
  std::size_t lost = 0;
  std::size_t left = 0;
  std::size_t high = 0;
  for (const RecordedFrame& frame : frames) {
    if (!frame.hands[0] && !frame.hands[1]) ++lost;
    if (frame.hands[0]) {
      ++left;
      EXPECT_NEAR(frame.hands[0]->pose[Joint::palm].position.x(), 0.2, 1e-9) << "where it was";
    }
    if (frame.hands[1] && right_hand(frame)[Joint::palm].position.y() > 0.2) ++high;
  }
  EXPECT_EQ(lost, 4u);
  EXPECT_EQ(left, 9u);
  EXPECT_EQ(high, 3u);
}

TEST_F(Scenes, ObjectsMoveAndBreathe) {
  const Result<BenchScene> scene = read(R"({"object": [{"box": [0.2, 0.1, 0.2]}], "depth": [0, 1],
    "path": [{"t": 0, "at": [0, 0.3, 0]}, {"t": 2, "at": [0, 0.3, 0]}],
    "motion": [{"t": 0, "at": [0, 0, 0]}, {"t": 1, "stretch": [1, 2, 1]},
               {"t": 2, "at": [0.5, 0, 0], "stretch": [1, 1, 1]}]})");
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  const Played played = play(*scene);
  ObjectPlayer player(played.recording, played.object);
  SurfaceHint hint;
  const auto height_of = [&](std::size_t frame, double x) {
    return player.at(frame).closest_point({x, 0.3, 0.0}, 1.0, hint)->signed_distance;
  };
  EXPECT_NEAR(height_of(0, 0.0), 0.25, 1e-6);
  EXPECT_NEAR(height_of(90, 0.0), 0.2, 1e-6);
  EXPECT_NEAR(height_of(180, 0.5), 0.25, 1e-6);
}

TEST_F(Scenes, MistakesAreNamed) {
  const auto says = [&](const std::string& words, const std::string& part) {
    const Result<BenchScene> scene = read(words);
    ASSERT_FALSE(scene.ok()) << words;
    EXPECT_NE(scene.error().message.find("scene.json"), std::string::npos);
    EXPECT_NE(scene.error().message.find(part), std::string::npos) << scene.error().message;
  };
  const std::string rest = R"("object": "plane", "depth": [0, 1])";
  says("{", "expected JSON");
  says("{" + rest + "}", "path: expected a list of keys");
  says("{" + rest + R"(, "path": [{"t": 1}]})", "path[0].t: expected times");
  says("{" + rest + R"(, "path": [{"t": 0, "gesture": "wave"}]})", "path[0].gesture: expected");
  says("{" + rest + R"(, "path": [{"t": 0, "hight": 1}]})", "path[0]: expected no key 'hight'");
  says("{" + rest + R"(, "path": [{"t": 0}], "rate": 1})", "rate: expected a number from 5");
  says(R"({"object": [{"cube": 1}], "path": [{"t": 0}], "depth": [0, 1]})", "no key 'cube'");
  EXPECT_FALSE(read_scenes(folder_.path("nowhere")).ok());
}

}  // namespace
