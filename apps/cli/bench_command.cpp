#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "bench_choice.h"
#include "bench_report.h"
#include "bench_run.h"
#include "command_files.h"
#include "commands.h"
#include "console.h"
#include "nade/io/output_file.h"
#include "number_options.h"

namespace nade::cli {
namespace {

struct BenchArguments {
  bool quick = false;
  bool full = false;
  std::string methods;
  std::vector<std::string> settings;
  bool tuning = false;
  std::string filter;
  std::vector<std::string> meshes;
  std::string clips;
  std::string scenes;  ///< a folder; empty: those that come with nade
  std::size_t every = 1;
  std::size_t jobs = std::max(1U, std::thread::hardware_concurrency());
  std::optional<std::string> json;
  std::optional<std::string> csv;
  std::optional<std::string> markdown;
  std::string dump;
};

/// The recordings in a folder, by name.
Result<std::vector<std::string>> clips_in(const std::string& folder) {
  std::vector<std::string> clips;
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failed)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".json") || name.ends_with(".jsonl") || name.ends_with(".gz")) {
      clips.push_back(entry.path().string());
    }
  }
  if (failed) {
    return Error{ErrorCode::not_found,
                 fmt::format("{}: expected a folder of recordings: {}", folder, failed.message())};
  }
  if (clips.empty()) {
    return Error{ErrorCode::not_found,
                 fmt::format("{}: expected recordings (.json, .jsonl, .gz), found none", folder)};
  }
  std::sort(clips.begin(), clips.end());
  return clips;
}

Result<BenchPlan> plan_of(const BenchArguments& arguments) {
  Result<std::vector<ComparedMethod>> methods = chosen_methods(arguments.methods);
  if (!methods) return methods.error();
  const Result<std::shared_ptr<const ProxyTuning>> tuning = tuning_with(arguments.settings);
  if (!tuning) return tuning.error();
  for (ComparedMethod& method : methods.value()) {
    if (method.name == "nade") method = tuned_method(*tuning);
  }
  SuiteOptions options;
  if (arguments.quick) options.size = SuiteSize::quick;
  if (arguments.full) options.size = SuiteSize::full;
  options.mesh_files = arguments.meshes;
  if (!arguments.clips.empty()) {
    Result<std::vector<std::string>> clips = clips_in(arguments.clips);
    if (!clips) return clips.error();
    options.clips = std::move(clips).value();
  }
  if (options.size != SuiteSize::quick) {
    auto scenes = chosen_scenes(arguments.scenes);
    if (!scenes) return scenes.error();
    options.scenes = std::move(scenes).value();
  }
  std::vector<NamedFile> inputs;
  for (const std::string& mesh : options.mesh_files) inputs.push_back({"--mesh", mesh});
  for (const std::string& clip : options.clips) inputs.push_back({"--clips", clip});
  const Status apart = check_apart(
      {{"--json", arguments.json}, {"--csv", arguments.csv}, {"--markdown", arguments.markdown}},
      inputs);
  if (!apart) return apart.error();
  BenchPlan plan{suite_cases(options), std::move(methods).value(), arguments.jobs};
  std::erase_if(plan.cases, [&](const SuiteCase& suite_case) {
    return suite_case.name().find(arguments.filter) == std::string::npos;
  });
  if (plan.cases.empty()) {
    return misuse(fmt::format("--filter '{}': no case has that in its name", arguments.filter));
  }
  std::vector<SuiteCase> kept;
  for (std::size_t i = 0; i < plan.cases.size(); i += arguments.every) {
    kept.push_back(std::move(plan.cases[i]));
  }
  plan.cases = std::move(kept);
  return plan;
}

Status write_reports(const BenchArguments& arguments, const BenchReport& report) {
  const auto write = [](const std::optional<std::string>& path, const std::string& text) {
    return path ? write_whole(*path, text) : ok_status();
  };
  for (const Status& written :
       {write(arguments.json, as_json(report)), write(arguments.csv, as_csv(report)),
        write(arguments.markdown, as_markdown(report))}) {
    if (!written.ok()) return written;
  }
  for (const auto* path : {&arguments.json, &arguments.csv, &arguments.markdown}) {
    if (*path == kStandardStream) return ok_status();
  }
  return write_whole(kStandardStream, as_text(report));
}

Status run_command(const BenchArguments& arguments) {
  if (arguments.tuning) return write_whole(kStandardStream, tuning_as_markdown());
  const Result<BenchPlan> plan = plan_of(arguments);
  if (!plan) return plan.error();
  const Result<DrawnHands> hands = load_drawn_hands();
  if (!hands) return hands.error();
  const Result<BenchReport> report = run_bench(*plan, *hands);
  if (!report) return report.error();
#ifndef NADE_CLI_PHYSICS
  if (arguments.methods.empty()) warn("no physics hand: built without Bullet (libbullet-dev)");
#endif
  if (!arguments.dump.empty()) {
    const Status dumped = dump_worst(*plan, *hands, *report, arguments.dump);
    if (!dumped.ok()) return dumped;
  }
  return write_reports(arguments, *report);
}

}  // namespace

void add_bench(CLI::App& app, Action& action) {
  CLI::App* const command =
      app.add_subcommand("bench", "Compares all methods over a fixed suite of strokes");
  const auto arguments = std::make_shared<BenchArguments>();
  CLI::Option* const quick =
      command->add_flag("--quick", arguments->quick, "a dozen short strokes only");
  command->add_flag("--full", arguments->full, "every change at every place")->excludes(quick);
  command
      ->add_option("--method", arguments->methods,
                   "which methods, parted by commas (default all): none, paper, nade, "
                   "wrist-offset, and physics where built with Bullet")
      ->type_name("NAMES");
  command
      ->add_option("--set", arguments->settings,
                   "another number for method nade; repeatable; --tuning lists them")
      ->type_name("NAME=VALUE");
  command->add_flag("--tuning", arguments->tuning, "prints those numbers and ends");
  command->add_option("--filter", arguments->filter, "only cases with this in their names")
      ->type_name("TEXT");
  command->add_option("--mesh", arguments->meshes, "a mesh to stroke too, at its top; repeatable")
      ->type_name("FILE");
  command
      ->add_option("--clips", arguments->clips,
                   "a folder of recordings, each pressed 30 mm onto plane, sphere and dog")
      ->type_name("DIR");
  command
      ->add_option("--scenes", arguments->scenes,
                   "a folder of scenes, or none (default those that come with nade)")
      ->type_name("DIR")
      ->excludes(quick);
  command->add_option("--every", arguments->every, "of these only the first of each N")
      ->type_name("N")
      ->transform(whole_number_in(1, 1000));
  command->add_option("--jobs", arguments->jobs, "cases worked on at a time (default all cores)")
      ->type_name("N")
      ->transform(whole_number_in(1, 256));
  command->add_option("--json", arguments->json, "writes all figures as JSON; - is stdout")
      ->type_name("FILE");
  command->add_option("--csv", arguments->csv, "writes a line a case and method; - is stdout")
      ->type_name("FILE");
  command->add_option("--markdown", arguments->markdown, "writes the tables; - is stdout")
      ->type_name("FILE");
  command
      ->add_option("--dump", arguments->dump,
                   "writes the recordings of each metric's worst cases, for nade render")
      ->type_name("DIR");
  command->callback(
      [&action, arguments] { action = [arguments] { return run_command(*arguments); }; });
}

}  // namespace nade::cli
