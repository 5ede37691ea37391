#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "nade/io/object_file.h"
#include "nade/study/store.h"
#include "support/recording_files.h"
#include "support/study_files.h"

namespace nade::study {
namespace {

using test::contains;
using test::kSecond_ns;
using test::read_whole;
using test::Stroker;
using test::WholeRecording;

class StudyStoreTest : public test::StudyFiles {
 protected:
  std::unique_ptr<StudyRun> opened(const Plan& plan, const RunOptions& run_options) {
    Result<std::unique_ptr<StudyRun>> run = StudyRun::open(plan, run_options);
    EXPECT_TRUE(run.ok()) << (run.ok() ? "" : run.error().message);
    return run.ok() ? std::move(run).value() : nullptr;
  }
  std::string refusal(const Plan& plan, const RunOptions& run_options) {
    const Result<std::unique_ptr<StudyRun>> run = StudyRun::open(plan, run_options);
    return run.ok() ? "" : run.error().message;
  }
  /// Runs until the first question of trial `trial`.
  void run_into(std::size_t trial) {
    const auto run = opened(quick_plan(), options());
    Stroker person(*run);
    while (run->scene().trial < trial) person.go_on();
    person.go_to(StudyState::question);
  }
};

TEST_F(StudyStoreTest, KeepsAWholeStudy) {
  {
    const auto run = opened(quick_plan(), options());
    Stroker person(*run);
    person.go_to(StudyState::thanks);
    EXPECT_TRUE(run->status().ok());
    EXPECT_EQ(run->dropped_frames(), 0u);
  }
  const Result<Participant> kept = read_participant(path("data/P01"));
  ASSERT_TRUE(kept.ok()) << kept.error().message;
  EXPECT_EQ(kept->problems, std::vector<std::string>{});
  EXPECT_EQ(kept->head.plan, quick_plan());
  EXPECT_EQ(answers_that_count(*kept).size(), 18u);
  const std::string answers = content_of("data/P01/answers.csv");
  EXPECT_TRUE(answers.starts_with(
      "participant,trial,order,object,method,question,answer,response_time_s,attempt,status\n"
      "P01,1,1,"));
  EXPECT_TRUE(contains(answers, ",Q1,4,0.500,1,given\n"));
  EXPECT_TRUE(contains(content_of("data/P01/log.jsonl"), R"("event":"completed")"));
}

TEST_F(StudyStoreTest, RecordsTheMotionOfEachTrial) {
  Plan plan = quick_plan();
  plan.objects = {{"ball", "sphere:0.1"}};
  plan.methods = {Method::paper};
  {
    const auto run = opened(plan, options());
    Stroker person(*run);
    person.go_to(StudyState::thanks);
  }
  const WholeRecording tracked = read_whole(path("data/P01/trial-01-ball-paper.tracked.jsonl.gz"));
  const WholeRecording corrected =
      read_whole(path("data/P01/trial-01-ball-paper.corrected.jsonl.gz"));
  EXPECT_EQ(tracked.error, "");
  EXPECT_TRUE(tracked.warnings.empty());
  ASSERT_EQ(tracked.frames.size(), 40u);
  ASSERT_EQ(corrected.frames.size(), 40u);
  EXPECT_EQ(tracked.frames.front().time_ns, 0);
  EXPECT_EQ(tracked.frames.back().time_ns, 39 * kSecond_ns / 20);
  ASSERT_TRUE(tracked.frames[7].hands[1]);
  EXPECT_FALSE(tracked.frames[7].hands[0]);
  EXPECT_EQ(tracked.frames[7].head->position.y(), 1.6);
  EXPECT_EQ(corrected.frames[7].hands[1]->status, HandStatus::corrected);
  EXPECT_EQ(corrected.header.source, "mouse");
  EXPECT_TRUE(contains(corrected.header.unknown_json, R"("method":"paper")"));
  EXPECT_TRUE(contains(corrected.header.unknown_json, R"("participant":"P01")"));
  const auto placing = placing_from(corrected.header.unknown_json, "corrected");
  ASSERT_TRUE(placing.ok());
  EXPECT_EQ((*placing)->object, "sphere:0.1");
}

TEST_F(StudyStoreTest, GoesOnAtTheFirstUnfinishedTrial) {
  run_into(3);
  {  // what is recorded is all on disk when the run has ended
    const auto run = opened(quick_plan(), options());
    EXPECT_EQ(run->view().heading, "Trial 3 of 6");
    Stroker person(*run);
    person.answer = 6;
    person.go_to(StudyState::thanks);
  }
  const Result<Participant> kept = read_participant(path("data/P01"));
  ASSERT_TRUE(kept.ok());
  EXPECT_EQ(kept->problems, std::vector<std::string>{});
  const std::vector<KeptAnswer> answers = answers_that_count(*kept);
  ASSERT_EQ(answers.size(), 18u);
  EXPECT_EQ(answers[5].answer, 4);
  EXPECT_EQ(answers[6].answer, 6);
  EXPECT_EQ(answers[6].attempt, 2u);
  EXPECT_TRUE(contains(content_of("data/P01/log.jsonl"), R"("event":"interrupted")"));
  int again = 0;
  for (const auto& entry : std::filesystem::directory_iterator(path("data/P01"))) {
    again += contains(entry.path().string(), "-attempt-2.") ? 1 : 0;
  }
  EXPECT_EQ(again, 2);
}

TEST_F(StudyStoreTest, ADoneStudyStaysDone) {
  {
    const auto run = opened(quick_plan(), options());
    Stroker person(*run);
    person.go_to(StudyState::thanks);
  }
  const std::string answers = content_of("data/P01/answers.csv");
  const auto run = opened(quick_plan(), options());
  EXPECT_EQ(run->state(), StudyState::thanks);
  EXPECT_EQ(content_of("data/P01/answers.csv"), answers);
}

TEST_F(StudyStoreTest, ATornLineIsCutAwayAndNamed) {
  run_into(2);
  add("data/P01/answers.csv", "P01,2,2,do");
  add("data/P01/log.jsonl", R"({"at":"20)");
  const auto run = opened(quick_plan(), options());
  ASSERT_EQ(run->store().notes().size(), 2u);
  EXPECT_TRUE(contains(run->store().notes()[1], "answers.csv: line 5 was cut off"));
  const std::string answers = content_of("data/P01/answers.csv");
  EXPECT_EQ(answers.back(), '\n');
  EXPECT_FALSE(contains(answers, "P01,2,2,do"));
  EXPECT_TRUE(contains(content_of("data/P01/log.jsonl"), R"("event":"mended")"));
  EXPECT_EQ(run->view().heading, "Trial 2 of 6");
}

TEST_F(StudyStoreTest, RefusesWhatDoesNotFit) {
  run_into(1);
  Plan longer = quick_plan();
  longer.trial_s = 3.0;
  EXPECT_TRUE(contains(refusal(longer, options()),
                       "P01/plan.json: the participant began with another plan: expected the same "
                       "\"trial_s\" in both"));
  RunOptions faster = options();
  faster.store.speed = 10.0;
  EXPECT_TRUE(contains(refusal(quick_plan(), faster), "began at speed 1"));
  EXPECT_TRUE(contains(refusal(quick_plan(), options("Ann Smith")), "participant 'Ann Smith'"));
  add("data/P01/answers.csv", "P01,1,1,dog,none,Q1,9,0.5,1,given\n");
  EXPECT_TRUE(contains(refusal(quick_plan(), options()), "answers.csv: line 2: "));
}

TEST_F(StudyStoreTest, RefusesWhereAFileWasLost) {
  run_into(2);
  for (const char* file : {"plan.json", "answers.csv", "log.jsonl"}) {
    const std::string kept = path(std::string("data/P01/") + file);
    std::filesystem::rename(kept, path("aside"));
    EXPECT_TRUE(contains(refusal(quick_plan(), options()),
                         std::string("data/P01/") + file + ": expected it beside "))
        << refusal(quick_plan(), options());
    EXPECT_FALSE(std::filesystem::exists(kept));
    std::filesystem::rename(path("aside"), kept);
  }
  // The recordings alone tell it, too.
  for (const char* file : {"plan.json", "answers.csv", "log.jsonl"}) {
    std::filesystem::remove(path(std::string("data/P01/") + file));
  }
  EXPECT_TRUE(
      contains(refusal(quick_plan(), options()), "P01/plan.json: expected it beside trial-"));
}

TEST_F(StudyStoreTest, WhatWasKilledBeforeItsPlanBeginsAnew) {
  std::filesystem::create_directories(path("data/P01"));
  write("data/P01/answers.csv", "");
  write("data/P01/log.jsonl", "");
  EXPECT_EQ(refusal(quick_plan(), options()), "");
}

TEST_F(StudyStoreTest, ARunThatCouldNotBeShownIsTakenBack) {
  EXPECT_TRUE(opened(quick_plan(), options())->withdraw());
  EXPECT_FALSE(std::filesystem::exists(path("data")));
  std::filesystem::create_directories(path("data"));
  write("data/notes.txt", "mine");
  EXPECT_TRUE(opened(quick_plan(), options())->withdraw());
  EXPECT_FALSE(std::filesystem::exists(path("data/P01")));
  EXPECT_EQ(content_of("data/notes.txt"), "mine");
  run_into(2);
  const std::string answers = content_of("data/P01/answers.csv");
  EXPECT_FALSE(opened(quick_plan(), options())->withdraw());
  EXPECT_EQ(content_of("data/P01/answers.csv"), answers);
  const auto begun = opened(quick_plan(), options("P02"));
  Stroker person(*begun);
  person.go_to(StudyState::stroking);
  EXPECT_FALSE(begun->withdraw());
  EXPECT_TRUE(std::filesystem::exists(path("data/P02/plan.json")));
}

TEST_F(StudyStoreTest, OneProgramAtATime) {
  const auto run = opened(quick_plan(), options());
  EXPECT_TRUE(contains(refusal(quick_plan(), options()), "the only program"));
  EXPECT_EQ(refusal(quick_plan(), options("P02")), "");
}

TEST_F(StudyStoreTest, WhatTheOperatorSkipsStaysSkipped) {
  {
    const auto run = opened(quick_plan(), options());
    Stroker person(*run);
    person.go_to(StudyState::stroking);
    run->skip("tracking lost", person.now_ns);
    person.go_to(StudyState::question);
  }
  const auto run = opened(quick_plan(), options());
  EXPECT_EQ(run->view().heading, "Trial 2 of 6");
  EXPECT_TRUE(contains(content_of("data/P01/log.jsonl"),
                       R"("event":"skipped","trial":1,"attempt":1,"reason":"tracking lost")"));
}

TEST_F(StudyStoreTest, AChangedAnswerTakesThePlaceOfTheEarlierOne) {
  {
    const auto run = opened(quick_plan(), options());
    Stroker person(*run);
    person.go_to(StudyState::question);
    person.go_on();
    person.press(kBackButton);
    person.answer = 7;
    person.go_to(StudyState::ready);
  }
  const Result<Participant> kept = read_participant(path("data/P01"));
  ASSERT_TRUE(kept.ok());
  EXPECT_EQ(kept->problems, std::vector<std::string>{});
  ASSERT_EQ(kept->answers.size(), 4u);
  EXPECT_EQ(kept->answers[0].answer, 4);
  EXPECT_TRUE(kept->answers[1].changed);
  const std::vector<KeptAnswer> counting = answers_that_count(*kept);
  ASSERT_EQ(counting.size(), 3u);
  EXPECT_EQ(counting[0].answer, 7);
}

TEST_F(StudyStoreTest, APausedStrokeIsRecordedAgain) {
  {
    const auto run = opened(quick_plan(), options());
    Stroker person(*run);
    person.go_to(StudyState::stroking);
    for (int i = 0; i < 10; ++i) person.step();
    run->pause(person.now_ns);
    run->resume(person.now_ns);
    person.go_to(StudyState::question);
  }
  const auto trial = trials_of(quick_plan(), "P01").front();
  const std::string first = path("data/P01/" + recording_stem(trial, 1) + ".tracked.jsonl.gz");
  const std::string second = path("data/P01/" + recording_stem(trial, 2) + ".tracked.jsonl.gz");
  EXPECT_EQ(read_whole(first).frames.size(), 11u);
  EXPECT_EQ(read_whole(second).frames.size(), 40u);
}

TEST_F(StudyStoreTest, WhatCannotBeKeptEndsTheStudyOnThePanel) {
  const auto run = opened(quick_plan(), options());
  Stroker person(*run);
  const auto trial = trials_of(quick_plan(), "P01").front();
  // Somebody else's file stands where the motion is to go.
  write("data/P01/" + recording_stem(trial, 1) + ".tracked.jsonl.gz", "mine");
  person.go_to(StudyState::question);
  // The file is opened off the frame loop.
  for (int i = 0; i < 500 && !run->over(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    person.step();
  }
  EXPECT_EQ(run->state(), StudyState::failed);
  EXPECT_FALSE(run->status().ok());
  ASSERT_EQ(run->view().lines.size(), 1u);
  EXPECT_TRUE(contains(run->view().lines[0], recording_stem(trial, 1)));
}

}  // namespace
}  // namespace nade::study
