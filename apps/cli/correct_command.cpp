#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "command_files.h"
#include "commands.h"
#include "console.h"
#include "method_options.h"
#include "nade/corrector.h"
#include "nade/eval/quantile.h"
#include "nade/io/output_file.h"
#include "nade/io/recording.h"
#include "nade/version.h"
#include "object_options.h"
#include "press_option.h"
#include "spooled_input.h"
#include "tracked_check.h"

namespace nade::cli {
namespace {

/// Farther than any room's table.
constexpr double kFar_m = 5.0;

struct CorrectArguments {
  std::string input;
  std::string output;
  ObjectOptions object;
  MethodOptions method;
  std::optional<double> press_m;
  std::optional<std::string> json;
};

/// What was done, for people and programs.
struct Summary {
  std::size_t frames = 0;
  std::array<std::size_t, 4> hands{};  ///< by HandStatus
  QuantileSketch solve_us;
  /// How near a palm or a fingertip came to the object while nothing had touched it, metres.
  double nearest_m = std::numeric_limits<double>::infinity();

  [[nodiscard]] std::size_t count(HandStatus status) const {
    return hands[static_cast<std::size_t>(status)];
  }
};

void look_how_near(const HandPose& hand, const Object& object, Summary& summary) {
  SurfaceHint hint;
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const std::size_t joint = index_of(joint_of(part_at(i)));
    const auto near = object.closest_point(hand.joints[joint].position,
                                           std::numeric_limits<double>::infinity(), hint);
    if (!near) continue;
    const double gap_m = std::max(near->signed_distance - hand.radius[joint], 0.0);
    summary.nearest_m = std::min(summary.nearest_m, gap_m);
  }
}

RecordingHeader corrected_header(const RecordingHeader& tracked, const CorrectArguments& arguments,
                                 const PlacedObject& placed) {
  RecordingHeader header = tracked;
  const std::string placing = with_placing(tracked.unknown_json, placed.placing());
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(placing);
  json["method"] = method_name(arguments.method);
  json["tool"] = fmt::format("nade {}", NADE_VERSION);
  if (arguments.press_m) json["press"] = *arguments.press_m;
  header.unknown_json = with_settle(json.dump(), arguments.method.corrector.settle);
  return header;
}

void correct_hand(RecordedHand& hand, HandCorrector& corrector, const Object& object,
                  std::int64_t time_ns, Summary& summary) {
  const auto start = std::chrono::steady_clock::now();
  const CorrectedHand& corrected = corrector.update(hand.pose, object, time_ns);
  const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
  summary.solve_us.add(took.count());
  ++summary.hands[static_cast<std::size_t>(corrected.status)];
  if (summary.count(HandStatus::corrected) == 0) look_how_near(hand.pose, object, summary);
  hand.pose = corrected.pose;
  hand.status = corrected.status;
  for (std::size_t i = 0; i < kPartCount; ++i) {
    hand.contact[i].reset();
    if (const auto& contact = corrected.contacts[i]) {
      hand.contact[i] = RecordedContact{contact->surface_point, contact->normal, contact->depth_m};
    }
  }
}

Result<Summary> correct_all(const CorrectArguments& arguments, const SpooledInput& input,
                            PlacedObject& placed) {
  Result<RecordingReader> reader = RecordingReader::open(input.path());
  if (!reader) return reader.error();
  if (is_corrected(reader->header())) return not_tracked(input.name(), kTracked);
  Result<std::optional<RecordedFrame>> frame = reader->next();
  if (!frame) return frame.error();
  if (*frame) placed.start_animation((*frame)->time_ns);
  Result<RecordingWriter> writer = RecordingWriter::create(
      arguments.output, corrected_header(reader->header(), arguments, placed));
  if (!writer) return writer.error();
  const Object object = placed.object();
  const CorrectorOptions options = options_of(arguments.method);
  std::array<HandCorrector, 2> correctors{HandCorrector(options), HandCorrector(options)};
  Summary summary;
  Progress progress("corrected", 0);
  while (*frame) {
    placed.move_to((*frame)->time_ns);
    for (std::size_t side = 0; side < correctors.size(); ++side) {
      auto& hand = (*frame)->hands[side];
      if (hand) correct_hand(*hand, correctors[side], object, (*frame)->time_ns, summary);
    }
    const Status written = writer->write(**frame);
    if (!written) return written.error();
    ++summary.frames;
    progress.step();
    frame = reader->next();
    if (!frame) return frame.error();
  }
  for (const std::string& warning : reader->warnings()) warn(input.renamed(warning));
  const Status finished = writer->finish();
  if (!finished) return finished.error();
  return summary;
}

nlohmann::ordered_json as_json(const Summary& summary, const CorrectArguments& arguments,
                               const PlacedObject& placed) {
  auto json = nlohmann::ordered_json::parse(with_placing({}, placed.placing()));
  json["method"] = method_name(arguments.method);
  json["frames"] = summary.frames;
  for (std::size_t i = 0; i < summary.hands.size(); ++i) {
    json["hands"][std::string(name_of(static_cast<HandStatus>(i)))] = summary.hands[i];
  }
  const auto number = [](const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
  };
  json["solve_us_median"] = number(summary.solve_us.quantile(0.5));
  json["solve_us_p99"] = number(summary.solve_us.quantile(0.99));
  return json;
}

/// Why nothing was corrected, and what to try; none where something was, or nothing was to be.
std::optional<std::string> why_nothing(const Summary& summary, const CorrectArguments& arguments) {
  if (arguments.method.corrector.method == Method::none && !arguments.method.literal) {
    return std::nullopt;
  }
  if (summary.count(HandStatus::corrected) > 0) return std::nullopt;
  if (!std::isfinite(summary.nearest_m)) return "no frame has a hand, nothing is corrected";
  const char* advice = "--press 0.02 puts the object under the palms, --at moves it";
  if (arguments.press_m) advice = "a larger --press puts it deeper into the palms";
  if (summary.nearest_m > kFar_m) {
    advice =
        "hands and object may be in different units (--scale) or places; --press 0.02 puts the "
        "object under the palms";
  }
  return fmt::format("no hand touches {}: the nearest palm or fingertip is {} away; {}",
                     *arguments.object.object,
                     summary.nearest_m < 1.0 ? fmt::format("{:.1f} mm", 1e3 * summary.nearest_m)
                                             : fmt::format("{:.4g} m", summary.nearest_m),
                     advice);
}

std::string as_line(const Summary& summary, const CorrectArguments& arguments) {
  return fmt::format(
      "{}: {} frames, hands corrected {}, released {}, free {}, untracked {}; a hand took {:.1f} "
      "us (median), {:.1f} us (p99)",
      arguments.output, summary.frames, summary.count(HandStatus::corrected),
      summary.count(HandStatus::released), summary.count(HandStatus::free),
      summary.count(HandStatus::untracked), summary.solve_us.quantile(0.5).value_or(0.0),
      summary.solve_us.quantile(0.99).value_or(0.0));
}

Status run_on(const CorrectArguments& arguments, const SpooledInput& input) {
  Result<PlacedObject> placed = load_placed(arguments.object);
  if (!placed) return placed.error();
  if (arguments.press_m) {
    const Status pressed = press_onto(input.path(), *arguments.press_m, *placed);
    if (!pressed) return pressed;
  }
  const Result<Summary> summary = correct_all(arguments, input, *placed);
  if (!summary) return summary.error();
  if (const auto why = why_nothing(*summary, arguments)) {
    warn(fmt::format("{}: {}", input.name(), *why));
  }
  if (!arguments.json) {
    say(as_line(*summary, arguments));
    return ok_status();
  }
  return write_whole(*arguments.json, as_json(*summary, arguments, *placed).dump(2) + "\n");
}

Status run_correct(const CorrectArguments& arguments) {
  if (!arguments.object.object) {
    return misuse("--object is needed: plane, sphere, dog or a mesh file");
  }
  const Status method = check_method(arguments.method, MethodChange::never);
  if (!method) return method;
  const Status apart = check_apart({{"--output", arguments.output}, {"--json", arguments.json}},
                                   {{"IN", arguments.input}, object_file(arguments.object)});
  if (!apart) return apart;
  const Status name = check_recording_name("--output", arguments.output);
  if (!name) return name;
  const Result<SpooledInput> input = arguments.press_m ? SpooledInput::open(arguments.input)
                                                       : SpooledInput::unspooled(arguments.input);
  if (!input) return input.error();
  return named(run_on(arguments, *input), *input);
}

}  // namespace

void add_correct(CLI::App& app, Action& action) {
  CLI::App* const command =
      app.add_subcommand("correct", "Puts the hands of a recording onto an object");
  const auto arguments = std::make_shared<CorrectArguments>();
  command->add_option("input", arguments->input, "the recording to correct; - is stdin")
      ->type_name("IN")
      ->required();
  command->add_option("-o,--output", arguments->output, "the recording to write; - is stdout")
      ->type_name("OUT")
      ->required();
  add_object_options(*command, arguments->object);
  add_press_option(*command, arguments->press_m);
  command->add_option("--json", arguments->json, "writes the summary as JSON; - is standard output")
      ->type_name("FILE");
  add_method_options(*command, arguments->method);
  command->callback(
      [&action, arguments] { action = [arguments] { return run_correct(*arguments); }; });
}

}  // namespace nade::cli
