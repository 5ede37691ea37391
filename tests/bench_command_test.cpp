// `nade bench` as a person meets it.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/cli_run.h"

namespace {

using nade::test::CliTest;
using nade::test::lines_of;
using nade::test::Ran;
using nade::test::read_file;

class BenchCommand : public CliTest {};

/// Without the physics hand, which takes its time and has its own test.
const std::string kMethods = "--method none,paper,nade,wrist-offset";

/// A CSV file without its last two columns, which are times.
std::string without_times(const std::string& csv) {
  std::string text;
  for (std::string line : lines_of(csv)) {
    for (int i = 0; i < 2; ++i) line.resize(line.rfind(','));
    text += line + '\n';
  }
  return text;
}

TEST_F(BenchCommand, QuickSuiteIsTheSameWhateverTheJobs) {
  const Ran one = nade("bench --quick " + kMethods +
                       " --jobs 1 --csv one.csv --json one.json --markdown one.md");
  ASSERT_EQ(one.status, 0) << one.err;
  for (const char* const part : {"paper", "wrist-offset", "penetration_max_mm", "pop_max_mm"}) {
    EXPECT_NE(one.out.find(part), std::string::npos) << part;
  }
  const auto json = nlohmann::json::parse(read_file(path("one.json")));
  EXPECT_EQ(json["cases"].size(), 12u);
  EXPECT_EQ(json["methods"]["paper"]["penetration_max_mm"]["values"].size(), 12u);
  EXPECT_EQ(json["methods"]["none"]["pop_max_mm"]["worst"], 0.0);
  EXPECT_LT(json["methods"]["nade"]["penetration_max_mm"]["median"],
            json["methods"]["none"]["penetration_max_mm"]["median"]);
  const auto& missing = json["methods"]["none"]["excess_max_mm"];
  EXPECT_EQ(missing["met"], 0);
  EXPECT_EQ(missing["reached"], false);
  EXPECT_EQ(missing["in"], 0.95);
  EXPECT_GT(missing["shortfall_mean"], 3.0);
  EXPECT_EQ(json["held_out"].size(), 12u);
  EXPECT_LT(json["methods"]["none"]["print_share"]["median"],
            json["methods"]["nade"]["print_share"]["median"]);
  EXPECT_EQ(json["methods"]["none"]["print_share"]["reached"], false);
  EXPECT_EQ(json["methods"]["none"]["print_share_flat"]["measured"], 3u) << "two planes, one ball";
  const std::string table = read_file(path("one.md"));
  EXPECT_NE(table.find("| excess_max_mm (at most 1.5 in 95 %) |"), std::string::npos);
  EXPECT_NE(table.find("| hover_mm (at most the paper's in 85 %) |"), std::string::npos);
  const std::size_t missed = table.find("| paper misses the target of | in |");
  ASSERT_NE(missed, std::string::npos);
  EXPECT_NE(table.find("excess_max_mm", missed), std::string::npos);
  const Ran two = nade("bench --quick " + kMethods + " --jobs 2 --csv -");
  ASSERT_EQ(two.status, 0) << two.err;
  EXPECT_EQ(without_times(two.out), without_times(read_file(path("one.csv"))));
}

/// Targets that refer to the paper's method are judged without it in the list, too.
TEST_F(BenchCommand, ThePapersTargetsNeedNotBeAskedFor) {
  const std::string filter = "bench --quick --filter plane --json - --method ";
  const Ran alone = nade(filter + "nade");
  const Ran beside = nade(filter + "paper,nade");
  ASSERT_EQ(alone.status, 0) << alone.err;
  ASSERT_EQ(beside.status, 0) << beside.err;
  const auto print_of = [](const Ran& ran) {
    return nlohmann::json::parse(ran.out)["methods"]["nade"]["print_share"];
  };
  EXPECT_EQ(print_of(alone)["judged"], 2u);
  EXPECT_EQ(print_of(alone), print_of(beside));
}

TEST_F(BenchCommand, EveryNthCaseIsTheFirstOfEachN) {
  const Ran ran = nade("bench --quick --method none --every 5 --json -");
  ASSERT_EQ(ran.status, 0) << ran.err;
  const auto cases = nlohmann::json::parse(ran.out)["cases"];
  ASSERT_EQ(cases.size(), 3U);  // of twelve
  EXPECT_EQ(cases[0], "plane line 0.1 m/s 20 mm");
  EXPECT_EQ(cases[1], "dog/ear line 0.1 m/s 4 mm");
}

TEST_F(BenchCommand, WorstCasesCanBeMeasuredAgain) {
  const Ran ran = nade("bench --quick --filter box/ --method paper,none --csv - --dump worst");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_NE(read_file(path("worst/worst.txt")).find("penetration_max_mm paper"), std::string::npos);
  const Ran again = shell(
      "for d in worst/box-*/; do \"$NADE\" measure $d/tracked.jsonl.gz $d/paper.jsonl.gz --csv - "
      "|| exit 1; done");
  ASSERT_EQ(again.status, 0) << again.err;
  // The case's figures in the bench's table stand in the measurement as well.
  EXPECT_NE(again.out.find("box.off"), std::string::npos);
}

TEST_F(BenchCommand, OnlyTheMethodsAskedFor) {
  const Ran ran = nade("bench --quick --filter plane --method wrist-offset,none");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.out.find("paper  "), std::string::npos) << "only in targets";
  EXPECT_LT(ran.out.find("wrist-offset"), ran.out.find("none  "));
}

TEST_F(BenchCommand, RefusesInOneSentence) {
  for (const std::string& arguments : std::vector<std::string>{
           "--method magic", "--method none,", "--filter nothing-like-it", "--csv - --json -"}) {
    const Ran ran = nade("bench --quick " + arguments);
    EXPECT_EQ(ran.status, 2) << arguments;
    EXPECT_EQ(ran.out, "") << arguments;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  }
  expect_failure(nade("bench --quick --clips nowhere"), "nowhere");
  expect_failure(nade("bench --quick --mesh nowhere.obj"), "nowhere.obj");
  expect_failure(nade("bench --quick --filter plane --csv nowhere/out.csv"), "nowhere/out.csv");
}

}  // namespace
