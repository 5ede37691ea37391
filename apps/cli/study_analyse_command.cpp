#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command_files.h"
#include "commands.h"
#include "console.h"
#include "nade/io/output_file.h"
#include "nade/study/analysis.h"
#include "nade/study/contact_metrics.h"
#include "nade/study/figure.h"
#include "nade/study/participant.h"
#include "nade/study/report.h"
#include "nade/study/study_data.h"
#include "nade/version.h"
#include "number_options.h"

namespace nade::cli {
namespace {

struct AnalyseArguments {
  std::string study;
  std::string out;
  std::optional<std::string> plan;
  std::string language = "en";
  study::AnalysisOptions options;
};

Status make_folder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (!error) return ok_status();
  return Error{ErrorCode::unwritable, fmt::format("{}: {}", path, error.message())};
}

study::ContactMetrics measure(const study::StudyData& data) {
  if (data.recordings.empty()) return {};
  Progress progress("measured", data.recordings.size(), "trials");
  return study::measure_trials(data, [&progress] { progress.step(); });
}

/// Draws both figures; what could not be drawn goes to the report's problems.
Status draw(const AnalyseArguments& arguments, study::ReportContent& content) {
  const study::Language language =
      arguments.language == "ja" ? study::Language::japanese : study::Language::english;
  for (const study::Figure& figure :
       {study::answers_figure(content.data, content.analysis, language),
        study::answers_by_object_figure(content.data, content.analysis, language)}) {
    Result<study::DrawnFigure> drawn = study::draw_figure(figure, arguments.out);
    if (!drawn) return drawn.error();
    content.pictures.insert(content.pictures.end(), drawn->files.begin(), drawn->files.end());
    if (!drawn->problem.empty()) content.problems.push_back(std::move(drawn->problem));
  }
  return ok_status();
}

Status write_texts(const AnalyseArguments& arguments, const study::ReportContent& content) {
  const std::filesystem::path out(arguments.out);
  Status written = write_whole((out / "comparisons.csv").string(),
                               study::comparisons_csv(content.data, content.analysis));
  if (written && !content.contact.trials.empty()) {
    written = write_whole((out / "metrics.csv").string(),
                          study::trial_metrics_csv(content.data, content.contact));
  }
  if (!written) return written;
  return write_whole((out / "report.md").string(), study::report_markdown(content));
}

/// Beside the participants an analysis may lie in the study, but not among one's data.
Status check_folder(const AnalyseArguments& arguments) {
  const Result<std::vector<std::string>> found = study::participant_folders(arguments.study);
  const std::vector<std::string> one{arguments.study};  // of which all is analysed, or a table
  for (const std::string& folder : found ? *found : one) {
    if (!lies_in(arguments.out, folder)) continue;
    return misuse(
        fmt::format("--output: expected a folder outside {}, found {}", folder, arguments.out));
  }
  return ok_status();
}

Status run_analyse(const AnalyseArguments& arguments) {
  const Status apart = check_folder(arguments);
  if (!apart) return apart;
  const Result<study::StudyData> data = study::read_study_data(arguments.study, arguments.plan);
  if (!data) return data.error();
  const Result<study::Analysis> analysis = study::analyse(*data, arguments.options);
  if (!analysis) return analysis.error();
  const Status folder = make_folder(arguments.out);
  if (!folder) return folder;
  const study::ContactMetrics contact = measure(*data);
  study::ReportContent content{*data, *analysis, arguments.options, contact, "nade " NADE_VERSION,
                               {},    {}};
  const Status drawn = draw(arguments, content);
  if (!drawn) return drawn;
  const Status written = write_texts(arguments, content);
  if (!written) return written;
  for (const std::string& sentence : content.remarks()) warn(sentence);
  say(fmt::format("{}: {} participants, {} answers{}",
                  (std::filesystem::path(arguments.out) / "report.md").string(),
                  data->participants.size(), data->answers.size(),
                  data->simulated ? ", SIMULATED" : ""));
  return ok_status();
}

}  // namespace

void add_study_analyse(CLI::App& study, Action& action) {
  CLI::App* const command =
      study.add_subcommand("analyse", "Tests the answers, draws the figures, writes a report");
  const auto arguments = std::make_shared<AnalyseArguments>();
  command
      ->add_option("study", arguments->study,
                   "a study's folder, or a table of answers: columns participant, object, method, "
                   "question, answer")
      ->type_name("DIR|CSV")
      ->required();
  command->add_option("-o,--output", arguments->out, "the folder for report, figures and tables")
      ->type_name("OUT")
      ->required();
  command
      ->add_option("--plan", arguments->plan,
                   "the plan of a table of answers, for its questions and scale")
      ->type_name("PLAN");
  command
      ->add_option("--baseline", arguments->options.baseline,
                   "the method that the others are compared with")
      ->type_name("METHOD")
      ->capture_default_str();
  command->add_option("--language", arguments->language, "of the questions in the figures")
      ->type_name("en|ja")
      ->check(CLI::IsMember({"en", "ja"}))
      ->capture_default_str();
  command->add_option("--seed", arguments->options.bootstrap.seed, "of the bootstrap")
      ->type_name("N")
      ->transform(whole_number())
      ->capture_default_str();
  command->footer(
      "OUT gets report.md, comparisons.csv, fig3 and fig3_by_object (.svg .pdf .png, and the .gp\n"
      "and .dat that draw them), and metrics.csv where recordings lie beside the answers.");
  command->callback(
      [&action, arguments] { action = [arguments] { return run_analyse(*arguments); }; });
}

}  // namespace nade::cli
