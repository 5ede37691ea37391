#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "nade/study/run.h"
#include "support/files.h"
#include "support/sample_hand.h"
#include "support/scratch_folder.h"

namespace nade::test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// Tests that keep studies, each in an empty folder of its own.
class StudyFiles : public FolderTest {
 protected:
  [[nodiscard]] std::string content_of(const std::string& name) const {
    return read_file(path(name));
  }
  void write(const std::string& name, const std::string& content) const {
    write_file(path(name), content);
  }
  void add(const std::string& name, const std::string& content) const {
    std::ofstream(path(name), std::ios::binary | std::ios::app) << content;
  }

  /// The paper's conditions in seconds instead of minutes.
  [[nodiscard]] static study::Plan quick_plan() {
    study::Plan plan = study::default_plan();
    plan.trial_s = 2.0;
    plan.countdown_s = 0.5;
    plan.practice.reset();
    plan.rest.reset();
    return plan;
  }
  [[nodiscard]] study::RunOptions options(const std::string& participant = "P01") const {
    study::RunOptions run;
    run.store.folder = path("data");
    run.store.participant = participant;
    run.store.tool = "nade test";
    run.store.wall_clock = [] { return std::string("2026-11-21T02:40:00Z"); };
    return run;
  }
};

/// A person who does what the panel asks, as fast as it lets them.
class Stroker {
 public:
  explicit Stroker(study::StudyRun& run) : run_(&run), tracked_(sample_hand()) {
    corrected_.status = HandStatus::corrected;
  }

  /// One frame, `step_ns` after the one before; presses what is to be pressed.
  void step(std::int64_t step_ns = kSecond_ns / 20) {
    now_ns += step_ns;
    tracked_[Joint::palm].position.x() = 1e-9 * static_cast<double>(now_ns % kSecond_ns) * 0.01;
    corrected_.pose = tracked_;
    study::RunFrame frame;
    frame.now_ns = now_ns;
    frame.tracked[1] = &tracked_;
    frame.corrected[1] = &corrected_;
    frame.head = Pose{{0.0, 1.6, 0.3}, Quat::Identity()};
    run_->frame(frame);
  }
  void press(int button) {
    now_ns += kSecond_ns / 4;
    run_->press(button, now_ns);
  }
  /// Until the study is over or `state` is reached.
  void go_to(study::StudyState state) {
    while (!run_->over() && run_->state() != state) go_on();
  }
  void go_on() {
    switch (run_->state()) {
      case study::StudyState::instructions:
      case study::StudyState::rest:
        step();
        press(study::kContinueButton);
        break;
      case study::StudyState::ready:
        press(study::kStartButton);
        break;
      case study::StudyState::question:
        press(study::kAnswerButton + answer);
        press(study::kConfirmButton);
        break;
      default:
        step();
    }
  }

  std::int64_t now_ns = 5 * kSecond_ns;
  int answer = 4;

 private:
  study::StudyRun* run_;
  HandPose tracked_;
  CorrectedHand corrected_;
};

}  // namespace nade::test
