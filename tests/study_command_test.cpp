// `nade study` as it is typed.

#include <gtest/gtest.h>

#include "support/cli_run.h"

namespace nade {
namespace {

using test::Ran;
using test::read_file;

class StudyCommand : public test::CliTest {
 protected:
  void invent(const std::string& options = "") {
    ASSERT_EQ(nade("study plan -o plan.json").status, 0);
    const Ran ran = nade("study simulate plan.json -d data --participants 3 " + options);
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_EQ(ran.out + ran.err, "");  // silent in a pipe
  }
};

TEST_F(StudyCommand, PlansTheExperiment) {
  const Ran ran = nade("study plan -o - --method nade --language ja --order latin --seed 5");
  EXPECT_EQ(ran.status, 0) << ran.err;
  for (const char* part :
       {"\"nade-study-plan\"", "\"seed\": 5", "\"ja\"", "\"latin\"", "\"nade\""}) {
    EXPECT_NE(ran.out.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(nade("study plan -o - --method best").status, 2);
}

TEST_F(StudyCommand, ChecksAStudyAndNamesDamage) {
  invent();
  const Ran whole = nade("study check data");
  EXPECT_EQ(whole.status, 0) << whole.err;
  EXPECT_EQ(whole.err, "");
  EXPECT_NE(whole.out.find("P03               6 of 6        0       18"), std::string::npos)
      << whole.out;
  EXPECT_NE(whole.out.find("SIMULATED"), std::string::npos);
  ASSERT_EQ(shell("awk -F, -v OFS=, 'NR == 5 { $7 = 9 } 1' data/P02/answers.csv >x && mv x "
                  "data/P02/answers.csv")
                .status,
            0);
  const Ran damaged = nade("study check data");
  EXPECT_EQ(damaged.status, 1);
  EXPECT_EQ(damaged.err, "nade: data: expected a whole study, found 2 problems\n");
  EXPECT_NE(damaged.out.find("problem: data/P02/answers.csv: line 5: answer: expected 1 to 7"),
            std::string::npos)
      << damaged.out;
  expect_failure(nade("study export data -o out"), "data/P02/answers.csv: line 5");
  EXPECT_EQ(files(), (std::vector<std::string>{"data", "plan.json"}));
  expect_failure(nade("study check nowhere"), "nowhere: expected a study's folder");
}

TEST_F(StudyCommand, ExportsOneTable) {
  invent();
  const Ran ran = nade("study export data -o out");
  EXPECT_EQ(ran.status, 0) << ran.err;
  const std::string table = read_file(path("out/answers.csv"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 3 * 18);
}

TEST_F(StudyCommand, NothingIsWrittenAmongTheData) {
  invent();
  for (const char* out : {"data/e", "data", "./data/../data/P01/e"}) {
    expect_misuse(nade(std::string("study export data -o ") + out),
                  "--output: expected a folder outside the study data, found ");
  }
  expect_misuse(nade("study analyse data -o data/P01/report"),
                "--output: expected a folder outside data/P01, found data/P01/report");
  expect_misuse(nade("study analyse data/P01 -o data/P01"), "expected a folder outside data/P01");
  EXPECT_EQ(nade("study check data").status, 0);
  EXPECT_EQ(nade("study analyse data -o data/report").status, 0);
  EXPECT_EQ(nade("study export data -o database").status, 0);
}

TEST_F(StudyCommand, NumbersBeyondADoubleAreNamed) {
  ASSERT_EQ(nade("study plan -o plan.json").status, 0);
  const std::string plan = read_file(path("plan.json"));
  for (const std::string key : {"\"seed\": 2023", "\"trial_s\": 30.0", "\"points\": 7"}) {
    for (const char* number : {"1e999", "-1e999"}) {
      std::string changed = plan;
      ASSERT_NE(changed.find(key), std::string::npos) << key;
      changed.replace(changed.find(key), key.size(), key.substr(0, key.find(':') + 1) + number);
      test::write_file(path("large.json"), changed);
      expect_failure(nade("study simulate large.json -d other"),
                     "expected numbers that a double can hold");
    }
  }
}

TEST_F(StudyCommand, MisuseIsNamed) {
  invent();
  const Ran effect = nade("study simulate plan.json -d other --effect Q7=1");
  EXPECT_EQ(effect.status, 2);
  EXPECT_NE(effect.err.find("found 'Q7=1'"), std::string::npos) << effect.err;
  expect_failure(nade("study simulate plan.json -d data"), "expected an empty folder");
  expect_failure(nade("study simulate nothing.json -d other"), "nothing.json: expected a study's");
  expect_misuse(nade("study plan -o other.json --seed -1"), "--seed: expected a whole number");
  expect_misuse(nade("study run plan.json --participant P9 --headless --speed nan"),
                "--speed: expected a number from 0.1 to 100, found 'nan'");
  expect_misuse(nade("study simulate plan.json -d other --motion nan"), "--motion: expected");
  EXPECT_EQ(nade("study").status, 2);
  EXPECT_EQ(nade("study run plan.json").status, 2);
  ASSERT_EQ(shell("sed -i 's/\"trial_s\": 30.0/\"trial_s\": -1/' plan.json").status, 0);
  expect_failure(nade("study simulate plan.json -d other"),
                 "plan.json: trial_s: expected a number from 1 to 3600, found -1");
}

}  // namespace
}  // namespace nade
