#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "console.h"
#include "measure_report.h"
#include "nade/eval/metrics.h"
#include "nade/eval/quantile.h"
#include "nade/io/assets.h"
#include "nade/io/hand_file.h"
#include "nade/io/output_file.h"
#include "nade/io/recording.h"
#include "object_options.h"
#include "spooled_input.h"

namespace nade::cli {
namespace {

struct MeasureArguments {
  std::string tracked;
  std::string corrected;
  ObjectOptions object;
  std::optional<std::string> json;
  std::optional<std::string> csv;
};

constexpr const char* kStandardStream = "-";

/// The drawn hands that a recording needs, and how large the person is.
struct DrawnHands {
  std::array<std::optional<HandMesh>, 2> meshes{};
  double scale = 1.0;
  std::size_t frames = 0;
};

/// Reads the tracked recording once: one scale for the whole of it, from all its hands.
Result<DrawnHands> survey(const std::string& path) {
  Result<RecordingReader> reader = RecordingReader::open(path);
  if (!reader) return reader.error();
  DrawnHands drawn;
  QuantileSketch scales;
  while (true) {
    const Result<std::optional<RecordedFrame>> frame = reader->next();
    if (!frame) return frame.error();
    if (!frame->has_value()) break;
    ++drawn.frames;
    for (const auto& hand : (*frame)->hands) {
      if (!hand || !is_usable(hand->pose)) continue;
      auto& mesh = drawn.meshes[index_of(hand->pose.side)];
      if (!mesh) {
        const Result<std::string> file =
            find_asset(fmt::format("hands/{}.glb", name_of(hand->pose.side)));
        if (!file) return file.error();
        Result<HandMesh> loaded = load_hand_mesh(*file, hand->pose.side);
        if (!loaded) return loaded.error();
        mesh = std::move(loaded).value();
      }
      scales.add(hand_scale(*mesh, hand->pose));
    }
  }
  drawn.scale = scales.quantile(0.5).value_or(1.0);
  return drawn;
}

/// Both recordings, read side by side.
struct Recordings {
  std::string tracked_name;  ///< as the person gave it
  RecordingReader tracked;
  std::string corrected_name;
  RecordingReader corrected;
};

/// How well two recordings went together.
struct Pairing {
  std::size_t pairs = 0;
  std::size_t only_tracked = 0;
  std::size_t only_corrected = 0;
  std::array<std::size_t, 2> missing{};  ///< hands tracked but not corrected
};

/// A meter for each hand that was drawn.
using Meters = std::array<std::optional<MetricsMeter>, 2>;

void measure_pair(const RecordedFrame& tracked, const RecordedFrame& corrected,
                  const Object& object, Meters& meters, Pairing& pairing) {
  for (std::size_t side = 0; side < meters.size(); ++side) {
    if (!meters[side]) continue;
    const auto& before = tracked.hands[side];
    const auto& after = corrected.hands[side];
    if (before && !after && is_usable(before->pose)) ++pairing.missing[side];
    if (before && after && after->status != HandStatus::untracked) {
      meters[side]->add(tracked.time_ns, before->pose, after->pose, object);
    } else {
      meters[side]->add_gap();
    }
  }
}

/// Pairs the frames by their times.
Result<Pairing> measure_all(Recordings& recordings, const Object& object, std::size_t frames,
                            Meters& meters) {
  Progress progress("measured", frames);
  Pairing pairing;
  Result<std::optional<RecordedFrame>> tracked = recordings.tracked.next();
  Result<std::optional<RecordedFrame>> corrected = recordings.corrected.next();
  while (true) {
    if (!tracked) return tracked.error();
    if (!corrected) return corrected.error();
    const std::optional<RecordedFrame>& before = *tracked;
    const std::optional<RecordedFrame>& after = *corrected;
    if (!before && !after) return pairing;
    const bool has_before = before && (!after || before->time_ns <= after->time_ns);
    const bool has_after = after && (!before || after->time_ns <= before->time_ns);
    if (has_before && has_after) {
      measure_pair(*before, *after, object, meters, pairing);
      ++pairing.pairs;
    } else {
      ++(has_before ? pairing.only_tracked : pairing.only_corrected);
    }
    if (has_before) {
      tracked = recordings.tracked.next();
      progress.step();
    }
    if (has_after) corrected = recordings.corrected.next();
  }
}

/// Refuses recordings that do not belong together, and says where they differ.
Status check_pairing(const Pairing& pairing, const Recordings& recordings) {
  const std::size_t unpaired = pairing.only_tracked + pairing.only_corrected;
  const std::size_t all = pairing.pairs + std::max(pairing.only_tracked, pairing.only_corrected);
  const std::string sentence =
      fmt::format("{}: {} of {} frames have a partner of the same time in {}",
                  recordings.corrected_name, pairing.pairs, all, recordings.tracked_name);
  if (2 * pairing.pairs < all) {
    return Error{ErrorCode::bad_value,
                 sentence + ", expected the corrected form of that recording"};
  }
  if (unpaired > 0) warn(sentence + ", only those are measured");
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    const std::size_t missing = pairing.missing[index_of(side)];
    if (missing == 0) continue;
    warn(fmt::format("{}: has no {} hand in {} frames where {} has one, they are not measured",
                     recordings.corrected_name, name_of(side), missing, recordings.tracked_name));
  }
  for (const RecordingReader* reader : {&recordings.tracked, &recordings.corrected}) {
    for (const std::string& warning : reader->warnings()) warn(warning);
  }
  return ok_status();
}

/// The method that the corrected recording's header names.
std::string method_of(const RecordingHeader& header) {
  const auto json = nlohmann::json::parse(header.unknown_json, nullptr, false);
  if (!json.is_object() || !json.contains("method") || !json["method"].is_string()) return {};
  return json["method"].get<std::string>();
}

void finish_meters(Meters& meters, MeasureReport& report) {
  std::optional<std::size_t> first;
  for (std::size_t side = 0; side < meters.size(); ++side) {
    if (!meters[side]) continue;
    report.hands[side] = meters[side]->finish();
    if (!first) {
      first = side;
    } else {
      meters[*first]->merge(*meters[side]);
    }
  }
  if (first) report.both = meters[*first]->finish();
}

Result<MeasureReport> measure(const MeasureArguments& arguments, const std::string& tracked_path) {
  const Result<DrawnHands> drawn = survey(tracked_path);
  if (!drawn) return drawn.error();
  Result<RecordingReader> tracked = RecordingReader::open(tracked_path);
  if (!tracked) return tracked.error();
  Result<RecordingReader> corrected = RecordingReader::open(arguments.corrected);
  if (!corrected) return corrected.error();
  Recordings recordings{arguments.tracked, std::move(tracked).value(), arguments.corrected,
                        std::move(corrected).value()};
  const RecordingHeader& header = recordings.corrected.header();
  const auto recorded = placing_from(header.unknown_json, arguments.corrected);
  if (!recorded) return recorded.error();
  const Result<PlacedObject> placed = load_placed(arguments.object, *recorded);
  if (!placed) return placed.error();
  Meters meters;
  for (std::size_t side = 0; side < meters.size(); ++side) {
    const auto& mesh = drawn->meshes[side];
    if (mesh) meters[side].emplace(*mesh, MetricsOptions{drawn->scale});
  }
  const Result<Pairing> pairing = measure_all(recordings, placed->object(), drawn->frames, meters);
  if (!pairing) return pairing.error();
  const Status fits = check_pairing(*pairing, recordings);
  if (!fits) return fits.error();
  MeasureReport report;
  report.tracked = arguments.tracked;
  report.corrected = arguments.corrected;
  report.method = method_of(header);
  report.object = placed->loaded.spec;
  report.hand_scale = drawn->scale;
  finish_meters(meters, report);
  return report;
}

Status run_measure(const MeasureArguments& arguments) {
  if (arguments.json == kStandardStream && arguments.csv == kStandardStream) {
    return Error{ErrorCode::out_of_range, "--json and --csv cannot both be standard output"};
  }
  std::optional<SpooledInput> spooled;
  if (arguments.tracked == kStandardStream) {
    if (arguments.corrected == kStandardStream) {
      return Error{ErrorCode::out_of_range, "TRACKED and CORRECTED cannot both be standard input"};
    }
    Result<SpooledInput> input = SpooledInput::read();
    if (!input) return input.error();
    spooled = std::move(input).value();
  }
  const Result<MeasureReport> report =
      measure(arguments, spooled ? spooled->path() : arguments.tracked);
  if (!report) return spooled ? spooled->renamed(report.error()) : report.error();
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
