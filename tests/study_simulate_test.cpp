#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "nade/study/check.h"
#include "nade/study/simulate.h"
#include "support/study_files.h"

namespace nade::study {
namespace {

class StudySimulateTest : public test::StudyFiles {
 protected:
  /// Mean answers by question and method.
  std::map<std::string, double> means(const std::string& folder) {
    std::map<std::string, double> sum;
    std::map<std::string, int> count;
    const auto folders = participant_folders(path(folder));
    EXPECT_TRUE(folders.ok());
    for (const std::string& one : *folders) {
      const Result<Participant> participant = read_participant(one);
      EXPECT_TRUE(participant.ok());
      for (const KeptAnswer& answer : answers_that_count(*participant)) {
        sum[answer.question + " " + answer.method] += answer.answer;
        ++count[answer.question + " " + answer.method];
      }
    }
    for (auto& [key, value] : sum) value /= count[key];
    return sum;
  }
  Status simulated(const std::string& folder, const std::string& effect, std::size_t participants) {
    SimulationOptions simulation;
    simulation.participants = participants;
    const Result<Effect> parsed = parse_effect(effect, quick_plan());
    EXPECT_TRUE(parsed.ok());
    simulation.effect = *parsed;
    return simulate_study(quick_plan(), path(folder), simulation);
  }
};

TEST_F(StudySimulateTest, AnswersBearTheEffectThatWasAskedFor) {
  ASSERT_TRUE(simulated("data", "Q1=2,Q3=1", 60).ok());
  std::map<std::string, double> mean = means("data");
  EXPECT_NEAR(mean["Q2 paper"] - mean["Q2 none"], 0.0, 0.3);
  EXPECT_NEAR(mean["Q3 paper"] - mean["Q3 none"], 1.4, 0.35);
  EXPECT_GT(mean["Q1 paper"] - mean["Q1 none"], mean["Q3 paper"] - mean["Q3 none"]);
  const Result<StudyCheck> check = check_study(path("data"));
  ASSERT_TRUE(check.ok());
  EXPECT_EQ(check->problems, std::vector<std::string>{});
  EXPECT_EQ(check->participants.size(), 60u);
}

TEST_F(StudySimulateTest, TheSameArgumentsGiveTheSameFiles) {
  ASSERT_TRUE(simulated("a", "all=1", 3).ok());
  ASSERT_TRUE(simulated("b", "all=1", 3).ok());
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path("a"))) {
    if (!entry.is_regular_file()) continue;
    const std::string name = std::filesystem::relative(entry.path(), path("a")).string();
    EXPECT_EQ(content_of("a/" + name), content_of("b/" + name)) << name;
    const std::string content = content_of("a/" + name);
    const bool says = content.find("SIMULATED") != std::string::npos ||
                      content.find("\"simulated\": true") != std::string::npos;
    EXPECT_TRUE(says) << name;
  }
}

TEST_F(StudySimulateTest, NeverMixesWithWhatIsThere) {
  std::filesystem::create_directory(path("data"));
  write("data/mine", "");
  EXPECT_FALSE(simulated("data", "", 1).ok());
}

TEST_F(StudySimulateTest, AnEffectThatCannotBeReadIsNamed) {
  const Result<Effect> effect = parse_effect("Q1=1,Q9=2", quick_plan());
  ASSERT_FALSE(effect.ok());
  EXPECT_NE(effect.error().message.find("found 'Q9=2'"), std::string::npos);
  EXPECT_FALSE(parse_effect("answer=0", quick_plan()).ok());
  EXPECT_FALSE(parse_effect("Q1", quick_plan()).ok());
  const Result<Effect> all = parse_effect("all=1,Q2=0.5,person=0", quick_plan());
  ASSERT_TRUE(all.ok());
  EXPECT_EQ(all->shift.at("Q1"), 1.0);
  EXPECT_EQ(all->shift.at("Q2"), 0.5);
  EXPECT_EQ(all->person_spread, 0.0);
}

TEST_F(StudySimulateTest, MotionMayBeInventedToo) {
  Plan plan = quick_plan();
  plan.objects = {{"plane", "plane"}};
  SimulationOptions simulation;
  simulation.participants = 1;
  simulation.motion_s = 1.0;
  const Status done = simulate_study(plan, path("data"), simulation);
  if (!done && done.error().code == ErrorCode::not_found) GTEST_SKIP() << done.error().message;
  ASSERT_TRUE(done.ok()) << done.error().message;
  const Result<StudyCheck> check = check_study(path("data"));
  ASSERT_TRUE(check.ok());
  EXPECT_EQ(check->problems, std::vector<std::string>{});
  EXPECT_NEAR(check->participants[0].motion_s, 2.0, 0.1);
}

}  // namespace
}  // namespace nade::study
