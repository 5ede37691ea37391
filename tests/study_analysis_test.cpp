#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "nade/study/analysis.h"
#include "nade/study/figure.h"
#include "nade/study/participant.h"
#include "nade/study/report.h"
#include "support/files.h"
#include "support/scratch_folder.h"

namespace nade::study {
namespace {

using Json = nlohmann::json;
using test::lines_of;

/// SIMULATED answers of 15 invented people; tests/data/simulated_study.R makes them, and what R
/// says about them.
constexpr const char* kStudy = NADE_TEST_DATA_DIR "/simulated_study.csv";
constexpr const char* kSaidByR = NADE_TEST_DATA_DIR "/simulated_study_r.json";

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Each test in an empty folder of its own.
class StudyAnalysis : public test::FolderTest {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(std::filesystem::path(path(name)).parent_path());
    test::write_file(path(name), text);
    return path(name);
  }
  /// The one-sentence error of a table that cannot be read.
  [[nodiscard]] std::string error_of(const std::string& text) const {
    const Result<StudyData> data = read_study_data(write("answers.csv", text));
    if (data.ok()) return "no error";
    EXPECT_EQ(data.error().message.find('\n'), std::string::npos);
    return data.error().message;
  }
};

StudyData stored_study() {
  Result<StudyData> data = read_study_data(kStudy);
  EXPECT_TRUE(data.ok()) << data.error().message;
  return std::move(data).value();
}

Analysis analysed(const StudyData& data, const AnalysisOptions& options = {}) {
  const Result<Analysis> analysis = analyse(data, options);
  EXPECT_TRUE(analysis.ok()) << analysis.error().message;
  return *analysis;
}

void expect_quartiles(const Json& expected, const Quartiles& found) {
  EXPECT_NEAR(found.lower, expected[0].get<double>(), 1e-9);
  EXPECT_NEAR(found.median, expected[1].get<double>(), 1e-9);
  EXPECT_NEAR(found.upper, expected[2].get<double>(), 1e-9);
}

void expect_number(const Json& expected, const char* key, const std::optional<double>& found) {
  ASSERT_TRUE(found) << key;
  const double value = expected[key].get<double>();
  EXPECT_NEAR(*found, value, 1e-11 + 1e-9 * std::abs(value)) << key;
}

void expect_family(const Json& expected, const std::vector<Comparison>& found) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Json& r = expected[i];
    const Comparison& ours = found[i];
    SCOPED_TRACE(ours.question + " " + ours.object);
    EXPECT_EQ(ours.question, r["question"].get<std::string>());
    EXPECT_EQ(ours.object, r["object"].get<std::string>());
    EXPECT_EQ(ours.dropped.pairs, r["n"].get<std::size_t>());
    EXPECT_EQ(ours.dropped.zeros, r["zeros"].get<std::size_t>());
    expect_quartiles(r["none"], ours.baseline_answers);
    expect_quartiles(r["nade"], ours.method_answers);
    expect_number(r, "w_plus", ours.dropped.w_plus);
    expect_number(r, "p_cc", ours.dropped.p_corrected);
    expect_number(r, "p_exact", ours.dropped.p_exact);
    expect_number(r, "p_exact_exactRankTests", ours.dropped.p_exact);
    expect_number(r, "w_plus_pratt", ours.pratt.w_plus);
    expect_number(r, "p_exact_pratt", ours.pratt.p_exact);
    expect_number(r, "rank_biserial", ours.dropped.rank_biserial);
    expect_number(r, "p_holm", ours.p_holm);
    expect_number(r, "p_holm_pratt", ours.p_holm_pratt);
  }
}

TEST_F(StudyAnalysis, StoredStudyEqualsR) {
  const Json said = Json::parse(test::read_file(kSaidByR));
  const StudyData data = stored_study();
  EXPECT_EQ(data.participants.size(), 15U);
  EXPECT_EQ(data.answers.size(), 270U);
  EXPECT_TRUE(data.simulated);
  const Analysis analysis = analysed(data);
  EXPECT_EQ(analysis.methods, (std::vector<std::string>{"none", "nade"}));
  EXPECT_TRUE(analysis.missing.empty());
  expect_family(said["averaged"], analysis.averaged);
  expect_family(said["by_object"], analysis.by_object);
}

TEST_F(StudyAnalysis, ReportOfTheStoredStudy) {
  const StudyData data = stored_study();
  const Analysis analysis = analysed(data);
  const AnalysisOptions options;
  const ContactMetrics contact;
  const ReportContent content{data, analysis, options, contact, "nade", {"fig3.png"}, {}};
  const std::string report = report_markdown(content);
  EXPECT_EQ(lines_of(report).front(), "# SIMULATED: Answers of a stroking study");
  EXPECT_TRUE(has(report, "15 participants, 270 answers; 15 answered everything."));
  for (const char* row :
       {"| Q1 | 15 | 3 [2.67, 3.67] | 5.33 [5, 5.33] | 120 | 0.0000610 | 0.0000610 | 0.000702 | "
        "0.000183 | \\*\\* | 1 [1, 1] |",
        "| Q2 | 15 (2 zero) | 4.67 [4, 5] | 5 [4.5, 5.67] | 64.5 | 0.184 | 0.247 | 0.191 | 0.184 | "
        "n.s. | 0.42 [",
        "| Q3 | 15 (1 zero) | 3.67 [3.33, 4.17] | 5 [4.17, 5.17] | 91 | 0.0131 | 0.0121 | 0.0167 | "
        "0.0261 | \\* | 0.73 [",
        "| Q1 | sphere | 15 | 3 [3, 4] | 6 [4, 6] | 112 | 0.00177 | 0.00177 | 0.00302 | 0.0124 | "
        "\\* | 0.87 [",
        "| Q2 | dog | 15 (5 zero) | 3 [3, 4.5] | 4 [3.5, 5.5] | 39 | 0.277 | 0.234 | 0.258 | 1.000 "
        "| n.s. | 0.42 ["}) {
    EXPECT_TRUE(has(report, row)) << row << "\n" << report;
  }
  EXPECT_TRUE(has(report, "(fig3.png)"));
  EXPECT_FALSE(has(report, "(fig3_by_object.png)"));
  const std::vector<std::string> table = lines_of(comparisons_csv(data, analysis));
  ASSERT_EQ(table.size(), 1U + 3U + 9U);
  for (std::size_t i = 1; i < table.size(); ++i) EXPECT_TRUE(has(table[i], ",SIMULATED"));
}

TEST_F(StudyAnalysis, TablesAsSpreadsheetsWriteThem) {
  const std::string tidy =
      "participant,object,method,question,answer\n"
      "P2,dog,none,Q1,3\nP2,dog,nade,Q1,6\nP10,dog,none,Q1,4\nP10,dog,nade,Q1,\n";
  const std::string foreign =
      "\xEF\xBB\xBF\"Answer\";note;Question;\"Method\";OBJECT;Participant\r\n"
      "3;\"said \"\"hm\"\";\nthen 3\";Q1;none;dog;\"P2\"\r\n"
      "6;;Q1; nade ;dog;P2\r\n\r\n"
      "\"4\";;Q1;none;dog;P10\r\n"
      "NA;;Q1;nade;dog;P10";
  for (const std::string& text : {tidy, foreign}) {
    const Result<StudyData> data = read_study_data(write("answers.csv", text));
    ASSERT_TRUE(data.ok()) << data.error().message;
    EXPECT_EQ(data->participants, (std::vector<std::string>{"P2", "P10"}));
    EXPECT_EQ(data->methods, (std::vector<std::string>{"none", "nade"}));
    ASSERT_EQ(data->answers.size(), 4U);
    EXPECT_EQ(data->answers[1].value, 6.0);
    EXPECT_FALSE(data->answers[3].value);
    EXPECT_FALSE(data->simulated);
  }
}

TEST_F(StudyAnalysis, WhatIsWrongInATableIsNamed) {
  const std::string head = "participant,object,method,question,answer\n";
  EXPECT_EQ(error_of(head + "P1,dog,none,Q1,3\nP1,dog,nade,Q1,six\n"),
            path("answers.csv") + ": line 3: answer: expected a number, found 'six'");
  EXPECT_EQ(error_of(head + "P1,dog,none,Q1\nP1,dog,nade,Q1,6\n"),
            path("answers.csv") + ": line 2: expected 5 fields, found 4");
  EXPECT_EQ(error_of(head + "P1,,none,Q1,3\n"),
            path("answers.csv") + ": line 2: object: expected a name, found ''");
  EXPECT_EQ(error_of(head + "P1,\"dog,none,Q1,3\n"),
            path("answers.csv") + ": line 2: expected a closing quote, found the end");
  EXPECT_EQ(
      error_of("participant,object,method,answer\nP1,dog,none,3\n"),
      path("answers.csv") +
          ": line 1: expected a column 'question', found participant, object, method, answer");
  EXPECT_EQ(error_of(head + "P1,dog,none,Q1,3\nP1,dog,nade,Q1,6\nP1,dog,none,Q1,4\n"),
            path("answers.csv") +
                ": line 4: expected one answer of P1 to Q1 of dog with none, found another in line "
                "2");
  EXPECT_EQ(error_of(""), path("answers.csv") + ": expected a line of column names, found nothing");
  EXPECT_EQ(error_of(head), path("answers.csv") + ": expected answers, found none");
  EXPECT_TRUE(has(error_of(std::string("p\0\0", 3)), "expected text in UTF-8"));
}

TEST_F(StudyAnalysis, ACutOffLastLineIsLeftOut) {
  const Result<StudyData> data =
      read_study_data(write("answers.csv",
                            "participant,object,method,question,answer\n"
                            "P1,dog,none,Q1,3\nP1,dog,nade,Q1,6\nP2,dog,no"));
  ASSERT_TRUE(data.ok());
  EXPECT_EQ(data->answers.size(), 2U);
  ASSERT_EQ(data->warnings.size(), 1U);
  EXPECT_TRUE(has(data->warnings[0], "cut off in line 4"));
}

TEST_F(StudyAnalysis, NothingToCompareIsNoAnalysis) {
  const std::string head = "participant,object,method,question,answer\n";
  const auto refused = [&](const std::string& rows) {
    const Result<StudyData> data = read_study_data(write("answers.csv", head + rows));
    EXPECT_TRUE(data.ok());
    const Result<Analysis> analysis = analyse(*data);
    return analysis.ok() ? "no error" : analysis.error().message;
  };
  EXPECT_TRUE(has(refused("P1,dog,paper,Q1,3\nP1,dog,nade,Q1,3\n"), "found 'paper', 'nade'"));
  EXPECT_TRUE(has(refused("P1,dog,none,Q1,3\n"), "with the method 'none' and with another"));
  EXPECT_TRUE(has(refused("P1,dog,none,Q1,3\nP2,dog,nade,Q1,3\n"), "found nobody's"));
}

TEST_F(StudyAnalysis, AnotherBaseline) {
  const Result<StudyData> data =
      read_study_data(write("answers.csv",
                            "participant,object,method,question,answer\n"
                            "P1,dog,none,Q1,3\nP1,dog,nade,Q1,6\nP1,dog,paper,Q1,4\n"));
  ASSERT_TRUE(data.ok());
  AnalysisOptions options;
  options.baseline = "paper";
  const Analysis analysis = analysed(*data, options);
  EXPECT_EQ(analysis.methods, (std::vector<std::string>{"paper", "none", "nade"}));
  ASSERT_EQ(analysis.averaged.size(), 2U);
  EXPECT_EQ(analysis.averaged[0].dropped.w_plus, 0.0);
  EXPECT_EQ(analysis.averaged[1].dropped.w_plus, 1.0);
}

TEST_F(StudyAnalysis, AveragesThatAreEqualAreTies) {
  // 7/3 - 5/3 and 5/3 - 7/3 differ in their last bit; a third of what differs must not.
  std::string text = "participant,object,method,question,answer\n";
  const auto person = [&](const std::string& name, const std::vector<int>& before,
                          const std::vector<int>& after) {
    const std::vector<std::string> objects{"plane", "sphere", "dog"};
    for (std::size_t i = 0; i < objects.size(); ++i) {
      text += name + "," + objects[i] + ",none,Q1," + std::to_string(before[i]) + "\n";
      text += name + "," + objects[i] + ",nade,Q1," + std::to_string(after[i]) + "\n";
    }
  };
  person("P1", {1, 2, 2}, {2, 2, 3});
  person("P2", {4, 4, 6}, {5, 5, 6});
  person("P3", {6, 6, 4}, {4, 5, 5});
  person("P4", {3, 4, 4}, {4, 3, 4});
  const Result<StudyData> data = read_study_data(write("answers.csv", text));
  ASSERT_TRUE(data.ok());
  const Analysis analysis = analysed(*data);
  ASSERT_EQ(analysis.averaged.size(), 1U);
  EXPECT_EQ(analysis.averaged[0].dropped.zeros, 1U);
  EXPECT_EQ(analysis.averaged[0].dropped.w_plus, 4.0);
  EXPECT_EQ(analysis.averaged[0].dropped.w_minus, 2.0);
}

TEST_F(StudyAnalysis, WhoLacksAnAnswerIsLeftOutAndNamed) {
  std::string text;
  for (const std::string& line : lines_of(test::read_file(kStudy))) {
    if (line.rfind("S07,", 0) == 0 && has(line, ",dog,nade,")) continue;
    text += line + "\n";
  }
  const Result<StudyData> data = read_study_data(write("answers.csv", text));
  ASSERT_TRUE(data.ok());
  const Analysis analysis = analysed(*data);
  for (const Comparison& comparison : analysis.averaged) {
    EXPECT_EQ(comparison.dropped.pairs, 14U);
  }
  for (const Comparison& comparison : analysis.by_object) {
    EXPECT_EQ(comparison.dropped.pairs, comparison.object == "dog" ? 14U : 15U);
  }
  ASSERT_EQ(analysis.missing.size(), 1U);
  EXPECT_EQ(analysis.missing[0].participant, "S07");
  EXPECT_EQ(analysis.missing[0].questions, (std::vector<std::string>{"Q1", "Q2", "Q3"}));
  EXPECT_EQ(analysis.missing[0].why, "no answers");
}

/// A participant's folder, written as a study writes it.
class FolderWriter {
 public:
  FolderWriter(std::string participant, const Plan& plan) {
    head_.participant = std::move(participant);
    head_.tool = "nade";
    head_.plan = plan;
    head_.trials = trials_of(plan, head_.participant);
    answers_ = answers_header(head_.origin);
  }
  [[nodiscard]] const std::vector<Trial>& trials() const { return head_.trials; }
  void answer(const Trial& trial, const std::string& question, int answer, std::size_t attempt = 1,
              bool changed = false) {
    answers_ +=
        answers_line({head_.participant, trial.number, trial.number, trial.object,
                      std::string(name_of(trial.method)), question, answer, 1.5, attempt, changed},
                     head_.origin);
  }
  void log(const std::string& line) { log_ += line + "\n"; }
  void write(const std::string& study) const {
    const std::filesystem::path folder = std::filesystem::path(study) / head_.participant;
    std::filesystem::create_directories(folder);
    std::ofstream(folder / kPlanFile) << participant_text(head_);
    std::ofstream(folder / kAnswersFile) << answers_;
    std::ofstream(folder / kLogFile) << log_;
  }

 private:
  ParticipantPlan head_;
  std::string answers_;
  std::string log_;
};

TEST_F(StudyAnalysis, AStudysFolder) {
  const Plan plan = default_plan(Method::nade);
  for (const char* name : {"P1", "P2", "P10"}) {
    FolderWriter writer(name, plan);
    for (const Trial& trial : writer.trials()) {
      const bool skipped = writer.trials().size() == trial.number && std::string(name) == "P2";
      if (skipped) {
        writer.log(R"({"event":"skipped","trial":6,"reason":"tracking was lost"})");
        continue;
      }
      for (const Question& question : plan.questions) {
        writer.answer(trial, question.id, trial.method == Method::nade ? 3 : 2);
      }
      // The person goes back; then the whole trial is done again.
      if (trial.method == Method::nade) {
        writer.answer(trial, "Q1", 4, 1, true);
        for (const Question& question : plan.questions) writer.answer(trial, question.id, 5, 2);
        writer.answer(trial, "Q2", 6, 2, true);
        writer.answer(trial, "Q1", 1, 3);  // and broken off
      }
    }
    writer.write(path("study"));
  }
  const Result<StudyData> data = read_study_data(path("study"));
  ASSERT_TRUE(data.ok()) << data.error().message;
  EXPECT_EQ(data->participants, (std::vector<std::string>{"P1", "P2", "P10"}));
  EXPECT_EQ(data->questions, plan.questions);
  EXPECT_FALSE(data->simulated);
  EXPECT_EQ(data->answers.size(), 3U * 18U - 3U);
  const Result<StudyData> alone = read_study_data(path("study/P1/"));
  ASSERT_TRUE(alone.ok()) << alone.error().message;
  EXPECT_EQ(alone->answers.size(), 18U);
  for (const GivenAnswer& answer : data->answers) {
    EXPECT_EQ(answer.value, answer.method == "none" ? 2.0 : answer.question == "Q2" ? 6.0 : 5.0);
  }
  const Analysis analysis = analysed(*data);
  ASSERT_EQ(analysis.missing.size(), 1U);
  EXPECT_EQ(analysis.missing[0].participant, "P2");
  EXPECT_EQ(analysis.missing[0].why, "skipped: tracking was lost");
  EXPECT_EQ(analysis.averaged[0].dropped.pairs, 2U);
  EXPECT_EQ(analysis.averaged[0].method_answers.median, 5.0);
}

TEST_F(StudyAnalysis, ADamagedFolderIsRefused) {
  FolderWriter writer("P1", default_plan(Method::nade));
  writer.answer(writer.trials()[0], "Q1", 9);
  writer.write(path("study"));
  const Result<StudyData> data = read_study_data(path("study"));
  ASSERT_FALSE(data.ok());
  EXPECT_TRUE(has(data.error().message, "P1/answers.csv: line 2: answer")) << data.error().message;
  std::filesystem::create_directories(path("empty"));
  EXPECT_FALSE(read_study_data(path("empty")).ok());
  EXPECT_FALSE(read_study_data(path("nowhere")).ok());
}

TEST_F(StudyAnalysis, FiguresShowEveryAnswerAndWhatIsSignificant) {
  const StudyData data = stored_study();
  const Analysis analysis = analysed(data);
  const Figure figure = answers_figure(data, analysis, Language::english);
  const Figure again = answers_figure(data, analysis, Language::english);
  EXPECT_EQ(figure.script, again.script);
  EXPECT_EQ(figure.data, again.data);
  std::size_t dots = 0;
  bool in_dots = false;
  for (const std::string& line : lines_of(figure.data)) {
    if (line.rfind("# ", 0) == 0) {
      in_dots = line.rfind("# dots", 0) == 0 || (in_dots && line.rfind("# x", 0) == 0);
    } else if (in_dots && !line.empty()) {
      ++dots;
    }
  }
  EXPECT_EQ(dots, 270U);
  for (const char* mark : {" **\n", " n.s.\n", " *\n"}) EXPECT_TRUE(has(figure.data, mark)) << mark;
  EXPECT_TRUE(has(figure.script, "SIMULATED"));
  EXPECT_TRUE(has(answers_by_object_figure(data, analysis, Language::english).script, "SIMULATED"));
  EXPECT_EQ(significance_mark(0.0099), "**");
  EXPECT_EQ(significance_mark(0.01), "*");
  EXPECT_EQ(significance_mark(0.05), "n.s.");
}

TEST_F(StudyAnalysis, FiguresAreDrawnByGnuplot) {
  if (std::system("gnuplot --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no gnuplot here";
  const StudyData data = stored_study();
  const Analysis analysis = analysed(data);
  std::filesystem::create_directories(path("a folder's"));
  const auto drawn =
      draw_figure(answers_by_object_figure(data, analysis, Language::english), path("a folder's"));
  ASSERT_TRUE(drawn.ok()) << drawn.error().message;
  EXPECT_EQ(drawn->problem, "");
  EXPECT_EQ(drawn->files, (std::vector<std::string>{"fig3_by_object.svg", "fig3_by_object.pdf",
                                                    "fig3_by_object.png"}));
  const std::string stem = path("a folder's") + "/fig3_by_object";
  EXPECT_EQ(test::read_file(stem + ".png").substr(1, 3), "PNG");
  EXPECT_EQ(test::read_file(stem + ".pdf").substr(0, 4), "%PDF");
  EXPECT_TRUE(has(test::read_file(stem + ".svg"), "SIMULATED"));
  EXPECT_TRUE(has(test::read_file(stem + ".svg"), "with correction"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path("a folder's")), {}), 5);
}

TEST_F(StudyAnalysis, WithoutGnuplotScriptAndDataAreThere) {
  const StudyData data = stored_study();
  const Analysis analysis = analysed(data);
  std::filesystem::create_directories(path("out"));
  const std::string searched = std::getenv("PATH");
  ::setenv("PATH", path("out").c_str(), 1);
  const auto drawn = draw_figure(answers_figure(data, analysis, Language::english), path("out"));
  ::setenv("PATH", searched.c_str(), 1);
  ASSERT_TRUE(drawn.ok());
  EXPECT_TRUE(drawn->files.empty());
  EXPECT_TRUE(has(drawn->problem, "gnuplot-nox")) << drawn->problem;
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path("out")), {}), 2);
  EXPECT_FALSE(test::read_file(path("out/fig3.gp")).empty());
  EXPECT_TRUE(has(test::read_file(path("out/fig3.dat")), "SIMULATED"));
}

}  // namespace
}  // namespace nade::study
