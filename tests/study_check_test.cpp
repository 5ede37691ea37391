#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "nade/study/check.h"
#include "support/study_files.h"

namespace nade::study {
namespace {

using test::Stroker;

class StudyCheckTest : public test::StudyFiles {
 protected:
  void SetUp() override {
    StudyFiles::SetUp();
    run("P1");
    run("P2");
  }
  void run(const std::string& id, const Plan& plan = quick_plan()) {
    auto opened = StudyRun::open(plan, options(id));
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    Stroker person(**opened);
    person.go_to(StudyState::thanks);
  }
  StudyCheck checked() {
    const Result<StudyCheck> check = check_study(path("data"));
    EXPECT_TRUE(check.ok());
    return check.ok() ? *check : StudyCheck{};
  }
  std::string problem() {
    const StudyCheck check = checked();
    std::string all;
    for (const std::string& sentence : check.problems) all += sentence + "\n";
    return all;
  }
  [[nodiscard]] std::string recording(std::size_t trial, const std::string& kind) const {
    const Trial one = trials_of(quick_plan(), "P2")[trial - 1];
    return "data/P2/" + recording_stem(one, 1) + "." + kind + ".jsonl.gz";
  }
  void replace_line(const std::string& name, std::size_t line, const std::string& with) {
    std::string content = content_of(name);
    std::size_t at = 0;
    for (std::size_t i = 1; i < line; ++i) at = content.find('\n', at) + 1;
    write(name, content.replace(at, content.find('\n', at) - at, with));
  }
};

bool says(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return true;
  std::printf("in: %s", text.c_str());
  return false;
}

TEST_F(StudyCheckTest, AWholeStudyHasNoProblems) {
  const StudyCheck check = checked();
  EXPECT_EQ(check.problems, std::vector<std::string>{});
  EXPECT_EQ(check.notes, std::vector<std::string>{});
  ASSERT_EQ(check.participants.size(), 2u);
  EXPECT_EQ(check.participants[1].participant, "P2");
  EXPECT_EQ(check.participants[1].finished, 6u);
  EXPECT_EQ(check.participants[1].answers, 18u);
  EXPECT_NEAR(check.participants[1].motion_s, 6 * 1.95, 0.01);
}

TEST_F(StudyCheckTest, AnAnswerOutOfRangeIsNamed) {
  const Trial trial = trials_of(quick_plan(), "P2").front();
  replace_line(
      "data/P2/answers.csv", 2,
      "P2,1,1," + trial.object + "," + std::string(name_of(trial.method)) + ",Q1,8,0.5,1,given");
  EXPECT_TRUE(says(problem(), "P2/answers.csv: line 2: answer: expected 1 to 7, found '8'"));
}

TEST_F(StudyCheckTest, AnAnswerGivenTwiceIsNamed) {
  const std::string content = content_of("data/P2/answers.csv");
  const std::size_t at = content.find('\n') + 1;
  add("data/P2/answers.csv", content.substr(at, content.find('\n', at) + 1 - at));
  EXPECT_TRUE(says(problem(), "answers.csv: line 20: expected one given answer to Q1 of trial 1"));
}

TEST_F(StudyCheckTest, AMissingAnswerIsNamed) {
  const std::string content = content_of("data/P2/answers.csv");
  write("data/P2/answers.csv", content.substr(0, content.rfind("P2,")));
  EXPECT_TRUE(says(problem(), "P2/answers.csv: expected answers to all of 6 trials"));
}

TEST_F(StudyCheckTest, ACutTableIsNamed) {
  add("data/P2/answers.csv", "P2,6");
  EXPECT_TRUE(says(problem(), "P2/answers.csv: cut off in its last line"));
}

TEST_F(StudyCheckTest, ADamagedLogIsNamed) {
  replace_line("data/P2/log.jsonl", 3, "{]");
  EXPECT_TRUE(says(problem(), "P2/log.jsonl: line 3: expected an object with an \"event\""));
}

TEST_F(StudyCheckTest, ADamagedPlanIsNamed) {
  replace_line("data/P2/plan.json", 2, "\"format\": 7,");
  EXPECT_TRUE(
      says(problem(), "P2/plan.json: format: expected \"nade-study-participant\", found 7"));
  EXPECT_EQ(checked().participants.size(), 2u);
}

TEST_F(StudyCheckTest, ACutRecordingIsNamed) {
  const std::string name = recording(3, "corrected");
  const std::string content = content_of(name);
  write(name, content.substr(0, content.size() - 300));
  EXPECT_TRUE(says(problem(), "cut off"));
  EXPECT_TRUE(says(problem(), "-attempt") || says(problem(), "corrected.jsonl.gz"));
}

TEST_F(StudyCheckTest, DamagedGzipIsNamed) {
  const std::string name = recording(2, "tracked");
  std::string content = content_of(name);
  content[content.size() / 2] = static_cast<char>(~content[content.size() / 2]);
  write(name, content);
  EXPECT_TRUE(says(problem(), "tracked.jsonl.gz: "));
}

TEST_F(StudyCheckTest, AMissingRecordingIsNamed) {
  std::filesystem::remove(path(recording(1, "tracked")));
  EXPECT_TRUE(says(problem(), "tracked.jsonl.gz: expected a recording, found no such file"));
}

TEST_F(StudyCheckTest, AShortRecordingIsNamed) {
  std::filesystem::copy_file(path(recording(2, "tracked")), path("long"));
  Plan longer = quick_plan();
  longer.trial_s = 4.0;
  std::filesystem::remove_all(path("data"));
  run("P2", longer);
  std::filesystem::copy_file(path("long"), path(recording(2, "tracked")),
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_TRUE(says(problem(), "expected 4 s of motion, found 1.95"));
}

TEST_F(StudyCheckTest, PlansThatDifferAreNamed) {
  Plan other = quick_plan();
  other.scale.points = 5;
  run("P3", other);
  EXPECT_TRUE(says(problem(), "P3/plan.json: plan.scale: expected the same as P1's"));
}

TEST_F(StudyCheckTest, AnUnfinishedStudyIsNoDamage) {
  {
    auto opened = StudyRun::open(quick_plan(), options("P9"));
    ASSERT_TRUE(opened.ok());
    Stroker person(**opened);
    person.go_to(StudyState::question);
    person.go_to(StudyState::stroking);
  }
  const StudyCheck check = checked();
  EXPECT_EQ(check.problems, std::vector<std::string>{});
  EXPECT_EQ(check.notes.size(), 5u);
  EXPECT_EQ(check.participants[2].finished, 1u);
}

TEST_F(StudyCheckTest, StrangeFilesAreNoted) {
  write("data/P1/notes.txt", "he was tired");
  std::filesystem::create_directory(path("data/analysis"));
  const StudyCheck check = checked();
  EXPECT_EQ(check.problems, std::vector<std::string>{});
  ASSERT_EQ(check.notes.size(), 1u);
  EXPECT_TRUE(says(check.notes[0], "P1/notes.txt: is none of the study's files"));
}

TEST_F(StudyCheckTest, WhatIsNoStudyIsAnError) {
  EXPECT_TRUE(says(check_study(path("nowhere")).error().message, "expected a study's folder"));
  std::filesystem::create_directory(path("empty"));
  EXPECT_TRUE(says(check_study(path("empty")).error().message, "expected a folder for each"));
}

}  // namespace
}  // namespace nade::study
