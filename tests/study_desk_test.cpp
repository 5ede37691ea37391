#include "study_desk.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "headless.h"
#include "nade/eval/synth.h"
#include "nade/io/hand_file.h"
#include "support/recording_files.h"
#include "support/study_files.h"
#include "support/viewer_assets.h"

namespace nade::viewer {
namespace {

using study::StudyState;

/// The study in the viewer, without a display and with nothing drawn but the panel.
class StudyDeskTest : public test::StudyFiles {
 protected:
  static study::Plan plan() {
    study::Plan plan = quick_plan();
    plan.objects = {{"sphere", "sphere"}};
    plan.trial_s = 1.0;
    plan.questions.resize(1);
    return plan;
  }

  void open(const std::string& spec = "sphere") {
    study::Plan with = plan();
    with.objects.front().spec = spec;
    auto run = study::StudyRun::open(with, options());
    ASSERT_TRUE(run.ok()) << run.error().message;
    desk_ = std::make_shared<StudyDesk>(std::move(run).value(), 1.0);
    ViewerSetup setup;
    setup.object = "sphere";
    setup.study = desk_;
    for (const Handedness side : {Handedness::left, Handedness::right}) {
      const std::string file =
          std::string(NADE_TEST_HANDS_DIR "/") + std::string(name_of(side)) + ".glb";
      auto mesh = load_hand_mesh(file, side);
      ASSERT_TRUE(mesh.ok()) << mesh.error().message;
      setup.session.meshes[index_of(side)] = std::move(mesh).value();
    }
    const Result<HandPose> relaxed = load_relaxed_hand(Handedness::right);
    ASSERT_TRUE(relaxed.ok());
    setup.session.relaxed = *relaxed;
    auto viewer = HeadlessViewer::create(std::move(setup), 640, 480);
    if (!viewer) GTEST_SKIP() << viewer.error().message;
    viewer_.emplace(std::move(viewer).value());
    frames(2);
    click("study:4");  // the instructions
  }

  void frames(int count, const std::vector<Event>& events = {}) {
    for (int i = 0; i < count; ++i) {
      viewer_->frame(i == 0 ? events : std::vector<Event>{}, Drawing::controls);
    }
  }
  void key(Key key) {
    Event event;
    event.kind = Event::Kind::key;
    event.key = key;
    frames(1, {event});
    event.change = Change::up;
    frames(1, {event});
  }
  void click(const std::string& widget) {
    frames(15);  // until the view counts as seen
    const Widget* const found = viewer_->viewer().ui().find(widget);
    ASSERT_NE(found, nullptr) << widget;
    Event event;
    event.x = 0.5 * (found->left + found->right);
    event.y = 0.5 * (found->top + found->bottom);
    frames(1, {event});
    event.kind = Event::Kind::button;
    frames(1, {event});
    event.change = Change::up;
    frames(2, {event});
  }
  /// Moves the mouse over the object while it is there.
  void stroke() {
    for (int i = 0; i < 600 && desk_->run().state() != StudyState::question; ++i) {
      Event event;
      event.x = 320.0 + 40.0 * std::sin(0.1 * i);
      event.y = 260.0;
      frames(1, {event});
    }
  }
  [[nodiscard]] const study::StudyRun& run() const { return desk_->run(); }

  std::shared_ptr<StudyDesk> desk_;
  std::optional<HeadlessViewer> viewer_;
};

TEST_F(StudyDeskTest, RunsByMouseFromStartToThanks) {
  open();
  if (IsSkipped()) return;
  for (const int answer : {3, 6}) {
    ASSERT_EQ(run().state(), StudyState::ready);
    EXPECT_FALSE(desk_->shows_object());
    click("study:1");
    ASSERT_EQ(run().state(), StudyState::countdown);
    EXPECT_TRUE(desk_->shows_object());
    stroke();
    ASSERT_EQ(run().state(), StudyState::question);
    click("study:" + std::to_string(study::kAnswerButton + answer));
    click("study:2");
  }
  EXPECT_EQ(run().state(), StudyState::thanks);
  EXPECT_FALSE(desk_->closed());
  key(Key::escape);
  EXPECT_TRUE(desk_->closed());
  viewer_.reset();
  desk_.reset();
  const auto kept = study::read_participant(path("data/P01"));
  ASSERT_TRUE(kept.ok());
  EXPECT_EQ(kept->problems, std::vector<std::string>{});
  ASSERT_EQ(kept->answers.size(), 2u);
  EXPECT_EQ(kept->answers[0].answer, 3);
  EXPECT_EQ(kept->answers[1].answer, 6);
  for (const study::Trial& trial : kept->head.trials) {
    const std::string stem = path("data/P01/" + study::recording_stem(trial, 1));
    const auto tracked = test::read_whole(stem + ".tracked.jsonl.gz");
    const auto corrected = test::read_whole(stem + ".corrected.jsonl.gz");
    ASSERT_GE(tracked.frames.size(), 59u);
    ASSERT_EQ(tracked.frames.size(), corrected.frames.size());
    ASSERT_TRUE(tracked.frames[40].hands[1]);
    ASSERT_TRUE(tracked.frames[40].head);
    const bool moved = (tracked.frames[40].hands[1]->pose[Joint::palm].position -
                        corrected.frames[40].hands[1]->pose[Joint::palm].position)
                           .norm() > 0.005;
    EXPECT_EQ(moved, trial.method != Method::none) << name_of(trial.method);
  }
}

TEST_F(StudyDeskTest, RecordsSinceWhenALivingObjectMoves) {
  open("dog:alive");
  if (IsSkipped()) return;
  click("study:1");
  while (run().state() != StudyState::stroking) frames(1);
  const std::int64_t moved_ns = viewer_->viewer().session().mouse_time_ns();
  stroke();
  const study::Trial& trial = run().session().trials().front();
  const std::string stem = path("data/P01/" + study::recording_stem(trial, 1));
  viewer_.reset();
  desk_.reset();
  const auto recorded = test::read_whole(stem + ".corrected.jsonl.gz");
  const auto placing = placing_from(recorded.header.unknown_json, stem);
  ASSERT_TRUE(placing.ok() && *placing && (*placing)->animation_start_ns);
  EXPECT_GT(moved_ns, 400'000'000) << "it moves while the seconds are counted down";
  EXPECT_EQ(*(*placing)->animation_start_ns, recorded.frames.front().time_ns - moved_ns);
}

TEST_F(StudyDeskTest, TheOperatorHasKeys) {
  open();
  if (IsSkipped()) return;
  click("study:1");
  frames(40);
  ASSERT_EQ(run().state(), StudyState::stroking);
  key(Key::p);
  EXPECT_EQ(run().state(), StudyState::paused);
  key(Key::p);
  EXPECT_EQ(run().state(), StudyState::ready);
  click("study:1");
  stroke();
  key(Key::r);
  EXPECT_EQ(run().state(), StudyState::ready);
  EXPECT_EQ(run().scene().trial, 1u);
  key(Key::s);
  click("skip:tracking");
  EXPECT_EQ(run().scene().trial, 2u);
  EXPECT_NE(content_of("data/P01/log.jsonl").find(R"("reason":"tracking failed")"),
            std::string::npos);
  key(Key::escape);
  EXPECT_EQ(run().state(), StudyState::stopped);
}

}  // namespace
}  // namespace nade::viewer
