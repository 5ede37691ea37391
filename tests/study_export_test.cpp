#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "nade/study/export.h"
#include "nade/study/simulate.h"
#include "support/study_files.h"

namespace nade::study {
namespace {

using test::lines_of;
using test::Stroker;

std::size_t columns_of(const std::string& line) {
  return 1 + static_cast<std::size_t>(std::count(line.begin(), line.end(), '\t'));
}

class StudyExportTest : public test::StudyFiles {
 protected:
  void run(const std::string& id) {
    auto opened = StudyRun::open(quick_plan(), options(id));
    ASSERT_TRUE(opened.ok());
    Stroker person(**opened);
    person.go_to(StudyState::question);
    person.go_on();
    person.press(kBackButton);
    person.answer = 6;
    person.go_to(StudyState::thanks);
  }
};

TEST_F(StudyExportTest, AnswersAreOneTidyTableOfWhatCounts) {
  run("P-1");
  run("P-2");
  const Result<StudyExport> done = export_study(path("data"), path("out"));
  ASSERT_TRUE(done.ok()) << done.error().message;
  EXPECT_EQ(done->participants, 2u);
  EXPECT_EQ(done->answers, 36u);
  EXPECT_EQ(done->motions, 12u);
  const std::vector<std::string> lines = lines_of(content_of("out/answers.csv"));
  ASSERT_EQ(lines.size(), 37u);
  EXPECT_NE(lines[1].find(",Q1,6,"), std::string::npos) << lines[1];  // as changed
}

TEST_F(StudyExportTest, MotionIsAsBidsDemandsIt) {
  run("P-1");
  const Result<StudyExport> done = export_study(path("data"), path("out"));
  ASSERT_TRUE(done.ok()) << done.error().message;
  const auto dataset = nlohmann::json::parse(content_of("out/bids/dataset_description.json"));
  EXPECT_EQ(dataset["BIDSVersion"], "1.9.0");
  EXPECT_EQ(lines_of(content_of("out/bids/participants.tsv"))[1], "sub-P1\t6");
  const std::string stem = "out/bids/sub-P1/motion/sub-P1_task-stroking_tracksys-hand_run-02_";
  const auto channels = lines_of(content_of(stem + "channels.tsv"));
  ASSERT_EQ(channels.size(), 1u + 1u + 26u * 7u);
  EXPECT_EQ(channels[0], "name\tcomponent\ttype\ttracked_point\tunits\treference_frame");
  EXPECT_EQ(channels[1], "latency\tn/a\tLATENCY\tn/a\ts\tn/a");
  EXPECT_EQ(channels[2], "right_palm_x\tx\tPOS\tright_palm\tm\tglobal");
  EXPECT_EQ(channels[8], "right_palm_quat_w\tquat_w\tORNT\tright_palm\tn/a\tglobal");
  const auto motion = lines_of(content_of(stem + "motion.tsv"));
  ASSERT_EQ(motion.size(), 40u);
  for (const std::string& row : motion) EXPECT_EQ(columns_of(row), channels.size() - 1);
  EXPECT_TRUE(motion[1].starts_with("0.050000\t"));
  const auto sidecar = nlohmann::json::parse(content_of(stem + "motion.json"));
  EXPECT_EQ(sidecar["TaskName"], "stroking");
  EXPECT_EQ(sidecar["SamplingFrequency"], 20.0);
  EXPECT_EQ(sidecar["POSChannelCount"], 78);
  EXPECT_EQ(sidecar["ORNTChannelCount"], 104);
  EXPECT_EQ(sidecar["MotionChannelCount"], 183);
  const auto frames = nlohmann::json::parse(content_of(stem + "channels.json"));
  EXPECT_EQ(frames["reference_frame"]["Levels"]["global"]["SpatialAxes"], "RSP");
  const std::string head = "out/bids/sub-P1/motion/sub-P1_task-stroking_tracksys-head_run-02_";
  EXPECT_EQ(columns_of(lines_of(content_of(head + "motion.tsv")).at(0)), 8u);
  EXPECT_FALSE(content_of("out/bids/derivatives/nade/sub-P1/motion/"
                          "sub-P1_task-stroking_tracksys-hand_run-02_desc-corrected_motion.tsv")
                   .empty());
}

TEST_F(StudyExportTest, IsWholeOrNotThere) {
  run("P1");
  add("data/P1/answers.csv", "P1,1,1\n");
  const Result<StudyExport> done = export_study(path("data"), path("out"));
  ASSERT_FALSE(done.ok());
  EXPECT_NE(done.error().message.find("answers.csv: line 21"), std::string::npos)
      << done.error().message;
  EXPECT_FALSE(std::filesystem::exists(path("out")));
  EXPECT_FALSE(std::filesystem::exists(path("out.part")));
}

TEST_F(StudyExportTest, LeavesOthersFilesAlone) {
  run("P1");
  std::filesystem::create_directory(path("out"));
  write("out/mine", "");
  EXPECT_FALSE(export_study(path("data"), path("out")).ok());
  EXPECT_TRUE(std::filesystem::exists(path("out/mine")));
}

TEST_F(StudyExportTest, SimulatedSaysSo) {
  SimulationOptions simulation;
  simulation.participants = 2;
  ASSERT_TRUE(simulate_study(quick_plan(), path("data"), simulation).ok());
  ASSERT_TRUE(export_study(path("data"), path("out")).ok());
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path("out"))) {
    const std::string name = std::filesystem::relative(entry.path(), path("")).string();
    const bool speaks = name.ends_with("beh.json") || name.ends_with("answers.csv") ||
                        name.ends_with("description.json") || name.ends_with("README");
    if (!speaks) continue;
    EXPECT_NE(content_of(name).find("SIMULATED"), std::string::npos) << name;
  }
  auto opened = StudyRun::open(quick_plan(), options("P9"));
  ASSERT_TRUE(opened.ok());
  std::filesystem::remove_all(path("out"));
  EXPECT_FALSE(export_study(path("data"), path("out")).ok());  // a person among them
}

}  // namespace
}  // namespace nade::study
