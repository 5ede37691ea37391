// One command over many recordings: `nade correct`, `convert`, `measure` and `inspect` on folders.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "support/cli_run.h"
#include "support/files.h"

namespace {

using nade::test::Ran;
using nade::test::read_file;
using nade::test::write_file;

class CliBatch : public nade::test::CliTest {
 protected:
  /// A folder `in` of six strokes, one of them deeper in.
  void make_folder() const {
    std::filesystem::create_directories(path("in/more"));
    for (int i = 1; i <= 5; ++i) {
      make_stroke("in/take" + std::to_string(i) + ".jsonl",
                  "--object sphere --seed " + std::to_string(i));
    }
    make_stroke("in/more/take1.jsonl", "--object sphere --seed 6");
  }

  /// A row of the table that ends a run.
  static std::string row(const Ran& ran, const std::string& name) {
    const std::size_t at = ran.out.find("\n" + name + " ");
    if (at == std::string::npos) return "none";
    const std::string line = ran.out.substr(at + 1, ran.out.find('\n', at + 1) - at - 1);
    return line.substr(line.rfind(' ') + 1);
  }
};

TEST_F(CliBatch, AFolderBecomesWhatItsFilesBecomeOneByOne) {
  make_folder();
  for (const char* jobs : {"1", "4"}) {
    const std::string out = std::string("out") + jobs;
    const Ran ran =
        nade("correct in -o " + out + " --ending .jsonl --object sphere --jobs " + jobs);
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_EQ(row(ran, "corrected"), "6") << ran.out;
    for (const char* name : {"take1.jsonl", "take5.jsonl", "more/take1.jsonl"}) {
      const std::string in = std::string("in/") + name;
      ASSERT_EQ(nade("correct " + in + " -o one.jsonl --object sphere").status, 0);
      EXPECT_EQ(read_file(path(out + "/" + name)), read_file(path("one.jsonl"))) << name;
    }
  }
}

TEST_F(CliBatch, WhatIsBrokenIsNamedAndTheRestIsDone) {
  make_folder();
  write_file(path("in/empty.jsonl"), "");
  write_file(path("in/words.json"), "these are words\n");
  write_file(path("in/not_a_recording.txt"), "left alone\n");
  const Ran ran = nade("convert in -o out --ending .csv");
  EXPECT_EQ(ran.status, 1);
  EXPECT_EQ(row(ran, "converted"), "6") << ran.out;
  EXPECT_EQ(row(ran, "failed"), "2") << ran.out;
  EXPECT_NE(ran.err.find("nade: in/empty.jsonl: "), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("nade: in/words.json: "), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("2 of 8 recordings could not be converted"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(path("out/more/take1.csv")));
  EXPECT_FALSE(std::filesystem::exists(path("out/words.csv")));
}

TEST_F(CliBatch, MotionCaptureConvertsToTheSameBytesAtAnyTime) {
  std::filesystem::create_directories(path("in"));
  std::filesystem::copy_file(NADE_TEST_DATA_DIR "/hands.bvh", path("in/hands.bvh"));
  ASSERT_EQ(nade("convert in -o out1 --ending .jsonl").status, 0);
  ASSERT_EQ(shell("sleep 1.1; \"$NADE\" convert in -o out2 --ending .jsonl").status, 0);
  const std::string converted = read_file(path("out1/hands.jsonl"));
  EXPECT_EQ(converted, read_file(path("out2/hands.jsonl")));
  EXPECT_EQ(converted.find("created"), std::string::npos);
}

TEST_F(CliBatch, WhatIsDoneIsNotDoneAgain) {
  make_folder();
  const std::string command = "correct in -o out --object sphere";
  ASSERT_EQ(nade(command).status, 0);
  EXPECT_EQ(row(nade(command), "corrected"), "0");
  EXPECT_EQ(row(nade(command), "done before"), "6");
  // Another input, an output that is gone, a journal that was cut off: only those.
  make_stroke("in/take2.jsonl", "--object sphere --seed 12");
  std::filesystem::remove(path("out/take3.jsonl.gz"));
  const std::string journal = read_file(path("out/nade-done.jsonl"));
  write_file(path("out/nade-done.jsonl"), journal.substr(0, journal.size() - 20));
  const Ran rest = nade(command);
  EXPECT_EQ(rest.status, 0) << rest.err;
  EXPECT_GE(std::stoi(row(rest, "corrected")), 2) << rest.out;
  EXPECT_LE(std::stoi(row(rest, "corrected")), 3) << rest.out;
  EXPECT_EQ(row(nade(command), "done before"), "6");
  // With another method all of it is another thing.
  EXPECT_EQ(row(nade(command + " --method paper"), "corrected"), "6");
}

TEST_F(CliBatch, AKilledRunIsGoneOnWith) {
  std::filesystem::create_directories(path("in"));
  for (int i = 0; i < 12; ++i) {
    const std::string name = "in/take" + std::to_string(i) + ".jsonl";
    ASSERT_EQ(nade("synth -o " + name + " --object dog --duration 4").status, 0);
  }
  static_cast<void>(
      shell("\"$NADE\" correct in -o out --object dog --jobs 2 & sleep 0.6; kill -9 $!; wait"));
  for (const auto& file : std::filesystem::directory_iterator(path("out"))) {
    const std::string name = file.path().filename().string();
    if (name == "nade-done.jsonl") continue;
    EXPECT_EQ(nade("inspect out/" + name).status, 0) << name << " is not whole";
  }
  const Ran rest = nade("correct in -o out --object dog");
  EXPECT_EQ(rest.status, 0) << rest.err;
  EXPECT_EQ(std::stoi(row(rest, "corrected")) + std::stoi(row(rest, "done before")), 12);
}

TEST_F(CliBatch, NothingIsReplacedUnasked) {
  make_folder();
  expect_misuse(nade("correct in/take1.jsonl in/more/take1.jsonl -o out --object sphere"),
                "in/take1.jsonl and in/more/take1.jsonl would both become out/take1.jsonl.gz");
  expect_misuse(nade("correct in/take1.jsonl in/take2.jsonl -o in --ending .jsonl --object sphere"),
                "--output: expected a folder in which no input is replaced, found in");
  expect_misuse(nade("correct in -o out --object sphere --json -"), "--json: expected with one");
  expect_misuse(nade("convert in -o out --ending .bvh"), "--ending: expected .jsonl");
  std::filesystem::create_directory(path("nothing"));
  expect_failure(nade("convert nothing -o out"), "nothing: expected recordings");
}

TEST_F(CliBatch, OneRecordingGoesIntoAFolderThatIsThereOrNamedAsOne) {
  make_stroke("take.jsonl");
  std::filesystem::create_directory(path("there"));
  EXPECT_EQ(nade("convert take.jsonl -o there").status, 0);
  EXPECT_TRUE(std::filesystem::exists(path("there/take.jsonl.gz")));
  EXPECT_EQ(nade("correct take.jsonl -o new/ --object plane").status, 0);
  EXPECT_TRUE(std::filesystem::exists(path("new/take.jsonl.gz")));
}

TEST_F(CliBatch, ADataSetIsMeasuredAsAWhole) {
  make_folder();
  ASSERT_EQ(nade("correct in -o out --object sphere").status, 0);
  std::filesystem::remove(path("in/take4.jsonl"));
  const Ran ran = nade("measure in out --json set.json --csv set.csv");
  EXPECT_EQ(ran.status, 1);
  EXPECT_NE(ran.err.find("out/take4.jsonl.gz: expected its tracked recording in in, found none"),
            std::string::npos)
      << ran.err;
  const auto set = nlohmann::json::parse(read_file(path("set.json")));
  EXPECT_EQ(set["recordings"], 5);
  EXPECT_EQ(set["failed"].size(), 1U);
  ASSERT_EQ(set["rows"].size(), 5U);
  // The worst is one of the rows, and the row is what measuring it alone gives.
  const auto& hover = set["summary"]["hover_mm"];
  bool found = false;
  for (const auto& row_of_one : set["rows"]) {
    if (row_of_one["corrected"] != hover["worst_recording"]) continue;
    found = true;
    EXPECT_EQ(row_of_one["hover_mm"], hover["worst"]);
    const Ran alone = nade("measure " + row_of_one["tracked"].get<std::string>() + " " +
                           row_of_one["corrected"].get<std::string>() + " --json -");
    EXPECT_EQ(nlohmann::json::parse(alone.out), row_of_one);
  }
  EXPECT_TRUE(found);
  const std::string rows = read_file(path("set.csv"));
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 6);
}

TEST_F(CliBatch, CorrectedRecordingsBesideTheirTrackedOnesAreASet) {
  make_stroke("take.jsonl", "--object sphere");
  ASSERT_EQ(nade("correct take.jsonl -o take-corrected.jsonl.gz --object sphere").status, 0);
  const Ran ran = nade("measure .");
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.out.substr(0, ran.out.find('\n')), "1 recordings");
  std::filesystem::create_directory(path("none"));
  expect_failure(nade("measure none"), "none: expected recordings NAME and NAME-corrected");
}

TEST_F(CliBatch, ManyAreInspectedInOrder) {
  make_folder();
  const Ran ran = nade("inspect in --json --jobs 3");
  EXPECT_EQ(ran.status, 0) << ran.err;
  std::istringstream lines(ran.out);
  std::string last;
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const auto report = nlohmann::json::parse(line);
    EXPECT_LT(last, report["file"].get<std::string>());
    last = report["file"];
    EXPECT_GT(report["frames"], 0);
  }
  EXPECT_EQ(count, 6U);
}

}  // namespace
