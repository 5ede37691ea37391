// `nade study analyse` as a person meets it: what it writes, what it measures, what it refuses.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/cli_run.h"

namespace {

using nade::test::CliTest;
using nade::test::Ran;
using nade::test::read_file;
using nade::test::write_file;

std::vector<std::string> split(const std::string& text, char separator) {
  std::istringstream stream(text);
  std::vector<std::string> parts;
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

class StudyAnalyseCommand : public CliTest {
 protected:
  void simulate(const std::string& options) const {
    const Ran planned = nade("study plan --method nade -o plan.json");
    ASSERT_EQ(planned.status, 0) << planned.err;
    const Ran simulated = nade("study simulate plan.json -d study " + options);
    ASSERT_EQ(simulated.status, 0) << simulated.err;
  }
  [[nodiscard]] bool says_simulated(const std::string& file) const {
    return read_file(path(file)).find("SIMULATED") != std::string::npos;
  }
};

TEST_F(StudyAnalyseCommand, AStudyBecomesAReport) {
  simulate("--participants 3 --motion 1");
  const Ran ran = nade("study analyse study -o out/report");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.out, "");
  for (const char* file : {"report.md", "comparisons.csv", "metrics.csv", "fig3.gp", "fig3.dat",
                           "fig3_by_object.gp", "fig3_by_object.dat"}) {
    EXPECT_TRUE(says_simulated(std::string("out/report/") + file)) << file;
  }
  const std::string report = read_file(path("out/report/report.md"));
  EXPECT_NE(report.find("Of the drawn hand in 18 recorded trials"), std::string::npos) << report;
  EXPECT_NE(report.find("| dog | `nade` | 3 |"), std::string::npos) << report;
}

TEST_F(StudyAnalyseCommand, ContactIsWhatMeasureSays) {
  simulate("--participants 2 --motion 1");
  ASSERT_EQ(nade("study analyse study -o out").status, 0);
  const std::vector<std::string> table = split(read_file(path("out/metrics.csv")), '\n');
  const std::vector<std::string> names = split(table.at(0), ',');
  ASSERT_EQ(table.size(), 13U);
  const std::vector<std::string> row = split(table.at(1), ',');
  std::string stem;
  for (const auto& entry : std::filesystem::directory_iterator(path("study/" + row.at(0)))) {
    const std::string name = entry.path().filename().string();
    const std::size_t end = name.find("-" + row.at(1) + "-" + row.at(2) + ".tracked");
    if (end != std::string::npos) stem = entry.path().string();
  }
  ASSERT_FALSE(stem.empty());
  std::string corrected = stem;
  corrected.replace(corrected.find(".tracked"), 8, ".corrected");
  const Ran measured = nade("measure '" + stem + "' '" + corrected + "' --json -");
  ASSERT_EQ(measured.status, 0) << measured.err;
  const auto json = nlohmann::json::parse(measured.out);
  for (const std::string key :
       {"penetration_mean_mm", "contact_ratio", "part_gap_p95_mm", "linkage_gain", "pop_max_mm"}) {
    const auto column = std::find(names.begin(), names.end(), key) - names.begin();
    const std::string& field = row.at(static_cast<std::size_t>(column));
    if (json[key].is_null()) {
      EXPECT_EQ(field, "") << key;
      continue;
    }
    const double value = json[key].get<double>();
    EXPECT_NEAR(std::stod(field), value, 1e-9 * (1.0 + std::abs(value))) << key;
  }
}

TEST_F(StudyAnalyseCommand, ADamagedRecordingIsLeftOutAndNamed) {
  simulate("--participants 2 --motion 1");
  std::string damaged;
  for (const auto& entry : std::filesystem::directory_iterator(path("study/P01"))) {
    const std::string name = entry.path().filename().string();
    if (name.find("sphere-nade.corrected") != std::string::npos) damaged = name;
  }
  write_file(path("study/P01/" + damaged), "no recording");
  const Ran ran = nade("study analyse study -o out");
  EXPECT_EQ(ran.status, 0);
  EXPECT_NE(ran.err.find(damaged), std::string::npos) << ran.err;
  const std::string report = read_file(path("out/report.md"));
  EXPECT_NE(report.find("in 11 recorded trials"), std::string::npos);
  EXPECT_NE(report.find(damaged), std::string::npos);
}

/// What gnuplot, a shell or a number's format would read as more than a text.
constexpr const char* kHostile =
    R"(`touch PWNED` $(touch PWNED) ${x} @x @FIT_LIMIT '.system('touch PWNED').' ")"
    R"(.system('touch PWNED')." 100%s %n%d \)";

TEST_F(StudyAnalyseCommand, NoTextOfATableRunsACommand) {
  std::string hostile = kHostile;
  for (std::size_t at = 0; (at = hostile.find('"', at)) != std::string::npos; at += 2) {
    hostile.insert(at, 1, '"');
  }
  hostile = "\"" + hostile + "\nsystem('touch PWNED')\r\x01\x1b \xFF\"";
  std::string table = "participant,object,method,question,answer\n";
  for (const char* person : {"P1", "P2", "P3"}) {
    for (const std::string& method : {std::string("none"), hostile}) {
      for (const std::string& object : {std::string("plane"), hostile}) {
        table += std::string(person) + "," + object + "," + method + "," + hostile + ",4\n";
      }
    }
  }
  write_file(path("answers.csv"), table);
  for (const char* options : {"", " --language ja"}) {
    const Ran ran = nade(std::string("study analyse answers.csv -o '`touch PWNED`'") + options);
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_EQ(ran.err.find("gnuplot said"), std::string::npos) << ran.err;
  }
  EXPECT_FALSE(std::filesystem::exists(path("PWNED")));
  EXPECT_FALSE(std::filesystem::exists(path("`touch PWNED`/PWNED")));
  for (const char* script : {"fig3.gp", "fig3_by_object.gp"}) {
    const std::string text = read_file(path(std::string("`touch PWNED`/") + script));
    const auto is_control = [](char c) { return c != '\n' && (c == 0x7F || (c >= 0 && c < 0x20)); };
    EXPECT_TRUE(std::none_of(text.begin(), text.end(), is_control)) << script;
    EXPECT_EQ(text.find("\nsystem"), std::string::npos) << script;
    EXPECT_EQ(text.find('\xFF'), std::string::npos) << script;
  }
}

TEST_F(StudyAnalyseCommand, NoTextOfAPlanRunsACommand) {
  ASSERT_EQ(nade("study plan --method nade -o plan.json").status, 0);
  auto plan = nlohmann::json::parse(read_file(path("plan.json")));
  const std::string hostile = std::string(kHostile) + "\nsystem('touch PWNED')\r\x01\x1b";
  const nlohmann::json text{{"en", hostile}, {"ja", hostile}};
  plan["title"] = hostile;
  plan["thanks"] = text;
  plan["scale"]["low"] = plan["scale"]["high"] = text;
  for (auto& question : plan["questions"]) question["text"] = text;
  for (auto& paragraph : plan["instructions"]) paragraph = text;
  write_file(path("plan.json"), plan.dump());
  ASSERT_EQ(nade("study simulate plan.json -d study --participants 3").status, 0);
  for (const char* options : {"", " --language ja"}) {
    const Ran ran = nade(std::string("study analyse study -o out") + options);
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_EQ(ran.err.find("gnuplot said"), std::string::npos) << ran.err;
  }
  EXPECT_FALSE(std::filesystem::exists(path("PWNED")));
  EXPECT_FALSE(std::filesystem::exists(path("out/PWNED")));
}

TEST_F(StudyAnalyseCommand, WhatCannotBeAnalysedIsNamed) {
  write_file(path("answers.csv"), "participant,object,method,question,answer\nP1,dog,none,Q1,x\n");
  expect_failure(nade("study analyse answers.csv -o out"), "answers.csv: line 2: answer");
  expect_failure(nade("study analyse nowhere -o out"), "nowhere");
  EXPECT_EQ(nade("study analyse answers.csv").status, 2);
  EXPECT_EQ(nade("study analyse answers.csv -o out --language fr").status, 2);
  EXPECT_EQ(files(), std::vector<std::string>{"answers.csv"});
}

TEST_F(StudyAnalyseCommand, NoTextOfATableSteersTheTerminal) {
  write_file(path("answers.csv"),
             "participant,object,method,question,answer\nP1,dog,none,Q1,\x1b[2Jx\xE9\n");
  const Ran ran = nade("study analyse answers.csv -o out");
  EXPECT_EQ(ran.status, 1);
  EXPECT_NE(ran.err.find("' [2Jx\xEF\xBF\xBD'"), std::string::npos) << ran.err;
}

}  // namespace
