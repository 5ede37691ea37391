// The physics hand that `nade bench` compares with: fair means that it works.

#include "physics_hand.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "nade/correction.h"
#include "nade/eval/suite.h"

namespace {

using namespace nade;

class PhysicsHandTest : public testing::Test {
 protected:
  void SetUp() override {
    const std::string folder = NADE_TEST_HANDS_DIR;
    ::setenv("NADE_ASSETS", folder.substr(0, folder.rfind('/')).c_str(), 1);
    Result<DrawnHands> loaded = load_drawn_hands();
    ASSERT_TRUE(loaded.ok()) << loaded.error().message;
    hands_ = std::move(loaded).value();
  }

  /// A short stroke on an object, and what became of it.
  struct Stroked {
    CaseRecording tracked;
    CorrectedRecording corrected;
    CaseScore score;
  };
  [[nodiscard]] Stroked stroke(const std::string& object_name, const SynthOptions& synth) const {
    SuiteCase suite_case;
    suite_case.object = object_name;
    suite_case.synth = synth;
    Result<SuiteObject> object = load_suite_object(object_name);
    Result<CaseRecording> tracked = make_recording(suite_case, *object);
    const ComparedMethod physics = cli::physics_method();
    CorrectedRecording corrected = correct(*tracked, *object, hands_, physics);
    CaseScore scored{measure(*tracked, *object, hands_, corrected), {}, {}};
    return {std::move(tracked).value(), std::move(corrected), scored};
  }

  DrawnHands hands_;
};

TEST_F(PhysicsHandTest, FollowsAHandInTheAir) {
  SynthOptions synth;
  synth.stroke = Stroke::curl;
  synth.speed_m_per_s = 0.5;
  synth.depth_m = 0.0;
  synth.tilt_rad = 1.2;  // fingers up and away
  synth.duration_s = 2.0;
  SuiteCase suite_case;
  suite_case.object = "plane";
  suite_case.synth = synth;
  const Result<SuiteObject> object = load_suite_object("plane");
  Result<CaseRecording> tracked = make_recording(suite_case, *object);
  for (RecordedFrame& frame : tracked->frames) {
    auto& pose = frame.hands[1]->pose;
    pose = moved(pose, {Vec3(0.0, 0.4, 0.0), Quat::Identity()});
  }
  const CorrectedRecording followed = correct(*tracked, *object, hands_, cli::physics_method());
  double farthest = 0.0;
  for (std::size_t i = 0; i < followed.frames.size(); ++i) {
    farthest = std::max(farthest, largest_motion(tracked->frames[i].hands[1]->pose,
                                                 followed.frames[i].hands[1]->pose));
  }
  EXPECT_LT(farthest, 0.005);
}

TEST_F(PhysicsHandTest, RestsOnWhatItStrokes) {
  for (const char* const object : {"plane", "sphere:0.15", "board", "dog"}) {
    SynthOptions synth;
    synth.duration_s = 2.0;
    const Stroked stroked = stroke(object, synth);
    const Metrics& metrics = stroked.score.metrics;
    EXPECT_LT(metrics.penetration_max_mm.value_or(99.0), 6.0) << object;
    EXPECT_GT(metrics.contact_ratio.value_or(0.0), 0.95) << object;
    EXPECT_LT(metrics.pop_max_mm.value_or(99.0), 15.0) << object;
  }
}

TEST_F(PhysicsHandTest, TheSameTwice) {
  SynthOptions synth;
  synth.duration_s = 1.0;
  synth.noise = NoiseModel::quest;
  const Stroked one = stroke("box", synth);
  const Stroked two = stroke("box", synth);
  const HandPose& a = one.corrected.frames.back().hands[1]->pose;
  const HandPose& b = two.corrected.frames.back().hands[1]->pose;
  EXPECT_EQ(largest_motion(a, b), 0.0);
}

}  // namespace
