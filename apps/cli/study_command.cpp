#include <fmt/format.h>
#include <sys/stat.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "command_files.h"
#include "commands.h"
#include "console.h"
#include "nade/io/output_file.h"
#include "nade/io/plain_text.h"
#include "nade/study/check.h"
#include "nade/study/export.h"
#include "nade/study/plan.h"
#include "nade/study/simulate.h"
#include "nade/version.h"
#include "number_options.h"
#include "study_run.h"

namespace nade::cli {
namespace {

constexpr const char* kTool = "nade " NADE_VERSION;

struct PlanArguments {
  std::string output;
  std::string method = "paper";
  std::string language = "en";
  std::string order = "random";
  std::optional<std::uint64_t> seed;
};

Status run_plan(const PlanArguments& arguments) {
  study::Plan plan = study::default_plan(*method_from_name(arguments.method));
  if (arguments.language == "ja") plan.language = study::Language::japanese;
  if (arguments.order == "latin") plan.order = study::OrderKind::latin;
  if (arguments.seed) plan.seed = *arguments.seed;
  return write_whole(arguments.output, study::plan_text(plan));
}

void add_plan(CLI::App& study, Action& action) {
  CLI::App* const command = study.add_subcommand(
      "plan", "Writes the plan of the paper's experiment, to run or to change");
  const auto arguments = std::make_shared<PlanArguments>();
  command->add_option("-o,--output", arguments->output, "the plan to write; - is stdout")
      ->type_name("PLAN")
      ->required();
  command->add_option("--method", arguments->method, "the correction to compare with none")
      ->type_name("paper|nade")
      ->check(CLI::IsMember({"paper", "nade"}))
      ->capture_default_str();
  command->add_option("--language", arguments->language, "of the participants")
      ->type_name("en|ja")
      ->check(CLI::IsMember({"en", "ja"}))
      ->capture_default_str();
  command
      ->add_option("--order", arguments->order,
                   "each participant's own, or rows of a balanced Latin square")
      ->type_name("random|latin")
      ->check(CLI::IsMember({"random", "latin"}))
      ->capture_default_str();
  command->add_option("--seed", arguments->seed, "what orders are drawn from (default 2023)")
      ->type_name("N")
      ->transform(whole_number());
  command->callback(
      [&action, arguments] { action = [arguments] { return run_plan(*arguments); }; });
}

Status run_check(const std::string& folder) {
  const Result<study::StudyCheck> check = study::check_study(
      folder, [](const std::string& participant) { say(fmt::format("reading {}", participant)); });
  if (!check) return check.error();
  std::printf("%-14s %9s %8s %8s %9s %9s\n", "participant", "finished", "skipped", "answers",
              "motion_s", "problems");
  bool simulated = false;
  for (const study::CheckedParticipant& line : check->participants) {
    simulated = simulated || line.origin == study::Origin::simulated;
    std::printf("%-14s %4zu of %zu %8zu %8zu %9.1f %9zu%s\n", plain_text(line.participant).c_str(),
                line.finished, line.trials, line.skipped, line.answers, line.motion_s,
                line.problems, line.origin == study::Origin::simulated ? "  SIMULATED" : "");
  }
  for (const std::string& note : check->notes) {
    std::printf("note: %s\n", plain_text(note).c_str());
  }
  for (const std::string& problem : check->problems) {
    std::printf("problem: %s\n", plain_text(problem).c_str());
  }
  if (check->problems.empty()) return ok_status();
  return Error{ErrorCode::bad_value,
               fmt::format("{}: expected a whole study, found {} problem{}", folder,
                           check->problems.size(), check->problems.size() == 1 ? "" : "s")};
}

void add_check(CLI::App& study, Action& action) {
  CLI::App* const command = study.add_subcommand("check", "Reads all of a study and names damage");
  const auto folder = std::make_shared<std::string>();
  command->add_option("folder", *folder, "the study's folder")->type_name("DIR")->required();
  command->callback([&action, folder] { action = [folder] { return run_check(*folder); }; });
}

struct ExportArguments {
  std::string folder;
  std::string output;
};

Status run_export(const ExportArguments& arguments) {
  // There it would count as one of the participants.
  if (lies_in(arguments.output, arguments.folder)) {
    return misuse(fmt::format("--output: expected a folder outside the study {}, found {}",
                              arguments.folder, arguments.output));
  }
  const Result<study::StudyExport> done = study::export_study(
      arguments.folder, arguments.output,
      [](const std::string& participant) { say(fmt::format("exporting {}", participant)); });
  if (!done) return done.error();
  say(fmt::format("{}: {} participants, {} answers, {} motions", arguments.output,
                  done->participants, done->answers, done->motions));
  return ok_status();
}

void add_export(CLI::App& study, Action& action) {
  CLI::App* const command = study.add_subcommand(
      "export", "Writes a study as one table of answers and as motion in BIDS");
  const auto arguments = std::make_shared<ExportArguments>();
  command->add_option("folder", arguments->folder, "the study's folder")
      ->type_name("DIR")
      ->required();
  command->add_option("-o,--output", arguments->output, "a new folder")
      ->type_name("OUT")
      ->required();
  command->callback(
      [&action, arguments] { action = [arguments] { return run_export(*arguments); }; });
}

struct SimulateArguments {
  std::string plan;
  std::string folder;
  std::string effect = "Q1=1.5,Q2=0.5,Q3=1.2";
  study::SimulationOptions options;
};

Status run_simulate(const SimulateArguments& arguments) {
  const Result<study::Plan> plan = study::read_plan(arguments.plan);
  if (!plan) return plan.error();
  study::SimulationOptions options = arguments.options;
  const Result<study::Effect> effect = study::parse_effect(arguments.effect, *plan);
  if (!effect) return effect.error();
  options.effect = *effect;
  options.tool = kTool;
  return study::simulate_study(
      *plan, arguments.folder, options,
      [](const std::string& participant) { say(fmt::format("inventing {}", participant)); });
}

void add_simulate(CLI::App& study, Action& action) {
  CLI::App* const command = study.add_subcommand(
      "simulate", "Invents a study's participants under a stated effect; all of it says SIMULATED");
  const auto arguments = std::make_shared<SimulateArguments>();
  study::SimulationOptions& options = arguments->options;
  command->add_option("plan", arguments->plan, "the study's plan")->type_name("PLAN")->required();
  command->add_option("-d,-o,--directory", arguments->folder, "a new folder")
      ->type_name("DIR")
      ->required();
  command->add_option("--participants", options.participants, "how many")
      ->type_name("N")
      ->transform(whole_number_in(1, 999))
      ->capture_default_str();
  command
      ->add_option("--effect", arguments->effect,
                   "what correction adds to each question's answer, in standard deviations of one "
                   "person's answers: Q1=1.5,Q2=0.5 or all=0")
      ->type_name("TEXT")
      ->capture_default_str();
  command->add_option("--seed", options.seed, "what people are invented from")
      ->type_name("N")
      ->transform(whole_number())
      ->capture_default_str();
  command->add_option("--motion", options.motion_s, "seconds of motion to invent for each trial")
      ->type_name("S")
      ->check(number_in(0.0, 3600.0))
      ->capture_default_str();
  command->callback(
      [&action, arguments] { action = [arguments] { return run_simulate(*arguments); }; });
}

}  // namespace

void add_study(CLI::App& app, Action& action) {
  CLI::App* const command = app.add_subcommand(
      "study", "The user study: plan, run, check, export, analyse, simulate (docs/study.md)");
  command->require_subcommand(1);
  add_plan(*command, action);
  add_study_run(*command, action);
  add_check(*command, action);
  add_export(*command, action);
  add_study_analyse(*command, action);
  add_simulate(*command, action);
}

}  // namespace nade::cli
