#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "command_files.h"
#include "commands.h"
#include "console.h"
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
};

/// What is not corrected may stand for what is: so the tracked hand itself is measured.
Status check_order(const SpooledInput& tracked) {
  const Result<RecordingReader> reader = RecordingReader::open(tracked.path());
  if (!reader) return reader.error();
  if (!is_corrected(reader->header())) return ok_status();
  return not_tracked(tracked.name(), kTrackedFirst);
}

Result<MeasureReport> measure(const MeasureArguments& arguments, const SpooledInput& tracked,
                              const SpooledInput& corrected) {
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
  Progress progress("measured", pair->frames());
  const Result<PairMetrics> metrics =
      pair->measure(placed->object(), [&progress, &placed](std::int64_t time_ns) {
        placed->move_to(time_ns);
        progress.step();
      });
  if (!metrics) return metrics.error();
  for (const std::string& warning : metrics->warnings) {
    warn(tracked.renamed(corrected.renamed(warning)));
  }
  MeasureReport report;
  report.tracked = arguments.tracked;
  report.corrected = arguments.corrected;
  report.method = method_of(header);
  report.object = placed->loaded.spec;
  report.hand_scale = metrics->hand_scale;
  report.both = metrics->both;
  report.hands = metrics->hands;
  return report;
}

Status run_measure(const MeasureArguments& arguments) {
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
  const Result<MeasureReport> report = measure(arguments, *tracked, *corrected);
  if (!report) return tracked->renamed(corrected->renamed(report.error()));
  if (arguments.json) {
    const Status written = write_whole(*arguments.json, as_json(*report));
    if (!written) return written;
  }
  if (arguments.csv) {
    const Status written = write_whole(*arguments.csv, as_csv(*report));
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
  command->add_option("tracked", arguments->tracked, "the recording that was corrected; - is stdin")
      ->type_name("TRACKED")
      ->required();
  command->add_option("corrected", arguments->corrected, "what became of it; - is stdin")
      ->type_name("CORRECTED")
      ->required();
  add_object_options(*command, arguments->object);
  add_press_option(*command, arguments->press_m);
  command
      ->add_option("--json", arguments->json,
                   "writes the metrics as JSON, and prints no table; - is stdout")
      ->type_name("FILE");
  command->add_option("--csv", arguments->csv, "writes the metrics as CSV; - is stdout")
      ->type_name("FILE");
  command->footer(
      "Object and placing are those of the corrected recording's header, where it has them and\n"
      "they are not given.");
  command->callback(
      [&action, arguments] { action = [arguments] { return run_measure(*arguments); }; });
}

}  // namespace nade::cli
