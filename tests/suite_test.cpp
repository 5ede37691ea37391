// The suite on which methods are compared: its cases, its shapes, and the wrist offset.

#include "nade/eval/suite.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <string>

#include "nade/eval/compare.h"
#include "nade/eval/shapes.h"
#include "nade/eval/wrist_offset.h"
#include "nade/io/object_file.h"

namespace {

using namespace nade;

/// Where the hands and the dog were built.
void use_built_assets() {
  const std::string hands = NADE_TEST_HANDS_DIR;
  ::setenv("NADE_ASSETS", hands.substr(0, hands.rfind('/')).c_str(), 1);
}

/// A case as a method does it.
Result<CaseScore> score_of(const SuiteCase& suite_case, const DrawnHands& hands,
                           const ComparedMethod& method) {
  const Result<SuiteObject> object = load_suite_object(suite_case.object);
  if (!object) return object.error();
  const Result<CaseRecording> recording = make_recording(suite_case, *object);
  if (!recording) return recording.error();
  return score(suite_case, *recording, *object, hands, method);
}

/// What `nade` makes of a case of the suite.
Metrics metrics_of_nade(const std::string& case_name) {
  use_built_assets();
  const Result<DrawnHands> hands = load_drawn_hands();
  const std::vector<ComparedMethod> methods = library_methods();
  const auto nade = std::ranges::find(methods, "nade", &ComparedMethod::name);
  const std::vector<SuiteCase> cases = suite_cases({});
  const auto stroke = std::ranges::find(cases, case_name, &SuiteCase::name);
  if (!hands) {
    ADD_FAILURE() << hands.error().message;
    return {};
  }
  if (nade == methods.end() || stroke == cases.end()) {
    ADD_FAILURE() << "no method nade, or no case " << case_name;
    return {};
  }
  const Result<CaseScore> scored = score_of(*stroke, *hands, *nade);
  if (!scored) {
    ADD_FAILURE() << scored.error().message;
    return {};
  }
  return scored->metrics;
}

TEST(Suite, SizesAndNames) {
  for (const SuiteSize size : {SuiteSize::quick, SuiteSize::normal, SuiteSize::full}) {
    const std::vector<SuiteCase> cases = suite_cases({.size = size});
    std::set<std::string> names;
    for (const SuiteCase& suite_case : cases) names.insert(suite_case.name());
    EXPECT_EQ(names.size(), cases.size()) << "two cases of one name";
    const std::size_t least = size == SuiteSize::quick ? 10 : size == SuiteSize::normal ? 110 : 300;
    EXPECT_GE(cases.size(), least);
  }
  EXPECT_EQ(suite_cases({}).front().name(), "plane line 0.1 m/s 20 mm");
}

TEST(Suite, TheSameEveryTime) {
  const std::vector<SuiteCase> once = suite_cases({});
  const std::vector<SuiteCase> twice = suite_cases({.mesh_files = {"other.obj"}});
  EXPECT_EQ(once.size() + 1, twice.size());
  EXPECT_EQ(once.back().name(), twice.back().name());
}

/// A third of the drawn seeds; never the strokes that everyone looks at.
TEST(Suite, AThirdOfTheSeedsIsHeldOut) {
  std::size_t drawn = 0;
  std::size_t held_out = 0;
  for (const SuiteCase& suite_case : suite_cases({.size = SuiteSize::full})) {
    const bool is_drawn = suite_case.synth.seed != SynthOptions{}.seed;
    if (is_drawn) ++drawn;
    if (!suite_case.is_held_out()) continue;
    ++held_out;
    EXPECT_TRUE(is_drawn) << suite_case.name();
  }
  EXPECT_NEAR(static_cast<double>(held_out), static_cast<double>(drawn) / 3.0,
              0.1 * static_cast<double>(drawn));
}

TEST(Suite, WhereAPalmCouldLieFlat) {
  const auto is_flat = [](const char* object, double depth_m) {
    SuiteCase stroke;
    stroke.object = object;
    stroke.synth.depth_m = depth_m;
    return stroke.is_flat();
  };
  EXPECT_TRUE(is_flat("plane", 0.02));
  EXPECT_TRUE(is_flat("sphere", 0.02));
  EXPECT_TRUE(is_flat("sphere:0.15", 0.01));
  EXPECT_FALSE(is_flat("sphere:0.1", 0.02));
  EXPECT_FALSE(is_flat("plane", 0.005));
  EXPECT_FALSE(is_flat("dog", 0.02));
}

TEST(Suite, CoversWhatHandsDo) {
  std::set<Stroke> strokes;
  std::set<NoiseModel> noises;
  std::set<std::string> objects;
  bool left = false;
  for (const SuiteCase& suite_case : suite_cases({})) {
    strokes.insert(suite_case.synth.stroke);
    noises.insert(suite_case.synth.noise);
    objects.insert(suite_case.object);
    left |= suite_case.synth.side == Handedness::left;
  }
  EXPECT_EQ(strokes.size(), 5u);
  EXPECT_EQ(noises.size(), 3u);
  EXPECT_EQ(objects.size(), 8u);
  EXPECT_TRUE(left);
}

TEST(Suite, EveryCaseOfTheQuickSuitePresses) {
  use_built_assets();
  const Result<DrawnHands> hands = load_drawn_hands();
  ASSERT_TRUE(hands.ok()) << hands.error().message;
  const std::vector<ComparedMethod> methods = library_methods();
  for (const SuiteCase& suite_case : suite_cases({.size = SuiteSize::quick})) {
    const Result<CaseScore> none = score_of(suite_case, *hands, methods.front());
    ASSERT_TRUE(none.ok()) << none.error().message;
    EXPECT_GT(none->metrics.pressing_frames, 40u) << suite_case.name();
    EXPECT_GT(none->metrics.penetration_max_mm.value_or(0.0), 3.0) << suite_case.name();
    EXPECT_EQ(none->metrics.jitter_ratio, 1.0) << suite_case.name();
  }
}

/// At the end of this stroke the tracked heel is out of the ball already and the thumb still in it.
/// The drawn hand rests on the heel, whose cushion must not lift it off before the thumb is out.
TEST(Suite, TheHandLeavesTheSmallestBallNoSoonerThanThePersonsOwn) {
  EXPECT_EQ(metrics_of_nade("sphere:0.06 line 0.1 m/s 20 mm").contact_ratio, 1.0);
}

/// The hand slides off the edge faster than it falls: for every sixteenth pressing frame it
/// hovered.
TEST(Suite, AFastHandTouchesWhatItSlidesOff) {
  EXPECT_GT(metrics_of_nade("box/across line 0.5 m/s 20 mm").contact_ratio.value(), 0.95);
}

/// From above a tilted hand the dog's back leans more than it does: the hand was shifted 14 mm
/// aside while it came down, ahead of the person's own (a lag of -2.3 ms).
TEST(Suite, ATiltedHandGoesAlongTheDogAsThePersonsOwn) {
  EXPECT_NEAR(metrics_of_nade("dog/back line 0.1 m/s 20 mm tilt +30").linkage_lag_ms.value(), 0.0,
              1.6);
}

TEST(Suite, UnknownObjectsAndClipsAreNamed) {
  EXPECT_FALSE(load_suite_object("cat").ok());
  SuiteCase clip;
  clip.object = "plane";
  clip.clip = "nowhere.json";
  EXPECT_EQ(clip.name(), "plane nowhere pressed 30 mm");
  const Result<SuiteObject> plane = load_suite_object("plane");
  const Result<CaseRecording> recording = make_recording(clip, *plane);
  ASSERT_FALSE(recording.ok());
  EXPECT_NE(recording.error().message.find("nowhere.json"), std::string::npos);
}

TEST(Shapes, AreClosedAndSolidWhereTheyShouldBe) {
  struct Probe {
    const char* name;
    Vec3 inside;
    Vec3 outside;
  };
  for (const Probe& probe : {Probe{"bowl", {0.0, -0.004, 0.0}, {0.0, 0.05, 0.0}},
                             Probe{"bowl", {0.154, 0.149, 0.0}, {0.154, 0.151, 0.0}},
                             Probe{"board", {0.1, -0.009, 0.1}, {0.1, -0.011, 0.1}},
                             Probe{"box", {0.0, -0.01, 0.01}, {0.0, -0.01, -0.01}}}) {
    const Result<SuiteObject> object = load_suite_object(probe.name);
    ASSERT_TRUE(object.ok()) << object.error().message;
    const auto* mesh = dynamic_cast<const MeshSurface*>(object->loaded.surface.get());
    ASSERT_NE(mesh, nullptr);
    EXPECT_EQ(mesh->report().solid, MeshSolid::closed);
    EXPECT_EQ(mesh->report().triangles_turned, 0u) << probe.name;
    SurfaceHint hint;
    const Object placed = object->loaded.placed();
    EXPECT_LT(placed.closest_point(probe.inside, 1.0, hint)->signed_distance, 0.0) << probe.name;
    EXPECT_GT(placed.closest_point(probe.outside, 1.0, hint)->signed_distance, 0.0) << probe.name;
    for (const MeshPlace& place : object->loaded.places) {
      const auto nearest = placed.closest_point(place.pose.position, 0.1, hint);
      EXPECT_NEAR(nearest->signed_distance, 0.0, 1e-4) << probe.name << " " << place.name;
    }
  }
}

TEST(WristOffset, LiftsTheHandAndKeepsItsFingers) {
  use_built_assets();
  const Result<DrawnHands> hands = load_drawn_hands();
  ASSERT_TRUE(hands.ok()) << hands.error().message;
  const Result<SuiteObject> plane = load_suite_object("plane");
  const Object object = plane->loaded.placed();
  HandPose hand = hands->meshes[1].bind;
  hand = moved(hand, {Vec3(0.0, -0.03, 0.0) - hand[Joint::palm].position, Quat::Identity()});
  WristOffset offset(hands->flesh[1], 1.0);
  const HandPose lifted = offset.update(hand, object);
  const Vec3 shift = lifted[Joint::palm].position - hand[Joint::palm].position;
  EXPECT_GT(shift.y(), 0.03);
  EXPECT_NEAR(shift.x(), 0.0, 1e-9);
  for (std::size_t i = 0; i < kJointCount; ++i) {
    EXPECT_TRUE((lifted.joints[i].position - hand.joints[i].position).isApprox(shift, 1e-9));
    EXPECT_LT(lifted.joints[i].rotation.angularDistance(hand.joints[i].rotation), 1e-6);
  }
  const HandPose above = moved(hand, {Vec3(0.0, 0.3, 0.0), Quat::Identity()});
  EXPECT_EQ(offset.update(above, object)[Joint::palm].position, above[Joint::palm].position);
}

TEST(WristOffset, IsNotPushedThroughABoard) {
  use_built_assets();
  const Result<DrawnHands> hands = load_drawn_hands();
  ASSERT_TRUE(hands.ok()) << hands.error().message;
  const Result<SuiteObject> board = load_suite_object("board");
  const Object object = board->loaded.placed();
  HandPose hand = hands->meshes[1].bind;
  WristOffset offset(hands->flesh[1], 1.0);
  for (int step = 0; step <= 100; ++step) {
    const double height = 0.05 - 0.001 * step;
    hand = moved(hand, {Vec3(0.0, height, 0.0) - hand[Joint::palm].position, Quat::Identity()});
    EXPECT_GT(offset.update(hand, object)[Joint::palm].position.y(), 0.0) << height;
  }
}

}  // namespace
