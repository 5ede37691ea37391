#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "batch.h"
#include "command_files.h"
#include "commands.h"
#include "console.h"
#include "measure_many.h"
#include "measure_report.h"
#include "nade/eval/recording_pair.h"
#include "nade/io/output_file.h"
#include "object_options.h"
#include "press_option.h"
#include "spooled_input.h"
#include "tracked_check.h"

namespace nade::cli {
namespace {

struct MeasureArguments {
  std::string tracked;
  std::string corrected;
  ObjectOptions object;
  std::optional<double> press_m;
  std::optional<std::string> json;
  std::optional<std::string> csv;
  std::size_t jobs = 0;
};

/// What is not corrected may stand for what is: so the tracked hand itself is measured.
Status check_order(const SpooledInput& tracked) {
  const Result<RecordingReader> reader = RecordingReader::open(tracked.path());
  if (!reader) return reader.error();
  if (!is_corrected(reader->header())) return ok_status();
  return not_tracked(tracked.name(), kTrackedFirst);
}

Result<MeasureReport> measure(const MeasureArguments& arguments, const SpooledInput& tracked,
                              const SpooledInput& corrected, bool shown) {
  const Status order = check_order(tracked);
  if (!order) return order.error();
  Result<RecordingPair> pair =
      RecordingPair::open(tracked.path(), tracked.name(), corrected.path());
  if (!pair) return pair.error();
  const RecordingHeader& header = pair->corrected_header();
  auto recorded = placing_from(header.unknown_json, corrected.name());
  if (!recorded) return recorded.error();
  // What was pressed is pressed from where it was told to stand, as when it was corrected.
  if (arguments.press_m && *recorded) (*recorded)->placement = {};
  Result<PlacedObject> placed = load_placed(arguments.object, *recorded);
  if (!placed) return placed.error();
  if (arguments.press_m) {
    const Status pressed = press_onto(tracked.path(), *arguments.press_m, *placed);
    if (!pressed) return pressed.error();
  }
  std::optional<Progress> progress;
  if (shown) progress.emplace("measured", pair->frames());
  const Result<PairMetrics> metrics =
      pair->measure(placed->object(), [&progress, &placed](std::int64_t time_ns) {
        placed->move_to(time_ns);
        if (progress) progress->step();
      });
  if (!metrics) return metrics.error();
  for (const std::string& warning : metrics->warnings) {
    warn(tracked.renamed(corrected.renamed(warning)));
  }
  MeasureReport report;
  report.tracked = tracked.name();
  report.corrected = corrected.name();
  report.method = method_of(header);
  report.object = placed->loaded.spec;
  report.hand_scale = metrics->hand_scale;
  report.both = metrics->both;
  report.hands = metrics->hands;
  return report;
}

Status measure_set(const MeasureArguments& arguments) {
  const Status apart = check_apart({{"--json", arguments.json}, {"--csv", arguments.csv}},
                                   {object_file(arguments.object)});
  if (!apart) return apart;
  return measure_many(
      {arguments.tracked, arguments.corrected, arguments.json, arguments.csv, arguments.jobs},
      [&](const std::string& tracked, const std::string& corrected) {
        return measure(arguments, SpooledInput::unspooled(tracked),
                       SpooledInput::unspooled(corrected), false);
      });
}

Status run_measure(const MeasureArguments& arguments) {
  if (std::error_code ignored; std::filesystem::is_directory(arguments.tracked, ignored)) {
    return measure_set(arguments);
  }
  if (arguments.corrected.empty()) {
    return misuse("CORRECTED: expected a recording, or a folder as TRACKED");
  }
  const Status apart = check_apart({{"--json", arguments.json}, {"--csv", arguments.csv}},
                                   {{"TRACKED", arguments.tracked},
                                    {"CORRECTED", arguments.corrected},
                                    object_file(arguments.object)});
  if (!apart) return apart;
  if (arguments.tracked == kStandardStream && arguments.corrected == kStandardStream) {
    return misuse("TRACKED and CORRECTED cannot both be standard input");
  }
  const Result<SpooledInput> tracked = SpooledInput::open(arguments.tracked);
  if (!tracked) return tracked.error();
  const Result<SpooledInput> corrected = SpooledInput::open(arguments.corrected);
  if (!corrected) return corrected.error();
  const Result<MeasureReport> report = measure(arguments, *tracked, *corrected, true);
  if (!report) return tracked->renamed(corrected->renamed(report.error()));
  if (arguments.json) {
    const Status written = write_whole(*arguments.json, as_json(*report));
    if (!written) return written;
  }
  if (arguments.csv) {
    const Status written =
        write_whole(*arguments.csv, csv_names() + "\n" + csv_values(*report) + "\n");
    if (!written) return written;
  }
  if (arguments.json || arguments.csv == kStandardStream) return ok_status();
  return write_whole(kStandardStream, as_text(*report));
}

}  // namespace

void add_measure(CLI::App& app, Action& action) {
  CLI::App* const command =
      app.add_subcommand("measure", "Says how good a corrected recording is, in figures");
  const auto arguments = std::make_shared<MeasureArguments>();
  command
      ->add_option("tracked", arguments->tracked,
                   "the recording that was corrected, - is stdin; or a folder of them")
      ->type_name("TRACKED")
      ->required();
  command
      ->add_option("corrected", arguments->corrected,
                   "what became of it, - is stdin; or a folder of recordings by the same names; "
                   "without one each NAME-corrected lies beside its NAME")
      ->type_name("CORRECTED");
  add_object_options(*command, arguments->object);
  add_press_option(*command, arguments->press_m);
  command
      ->add_option("--json", arguments->json,
                   "writes the metrics as JSON, and prints no table; - is stdout")
      ->type_name("FILE");
  command->add_option("--csv", arguments->csv, "writes the metrics as CSV; - is stdout")
      ->type_name("FILE");
  add_jobs_option(*command, arguments->jobs);
  command->footer(
      "Object and placing are those of the corrected recording's header, where it has them and\n"
      "they are not given.");
  command->callback(
      [&action, arguments] { action = [arguments] { return run_measure(*arguments); }; });
}

}  // namespace nade::cli
