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
#include <vector>

#include "batch.h"
#include "command_files.h"
#include "commands.h"
#include "console.h"
#include "frame_pipe.h"
#include "method_options.h"
#include "model_options.h"
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
  BatchOptions files;
  std::string recipe;
  ObjectOptions object;
  MethodOptions method;
  ModelChoice model;
  std::optional<double> press_m;
  std::optional<std::string> json;
};

/// What was done, for people and programs.
struct Summary {
  std::size_t frames = 0;
  double seconds = 0.0;                ///< from the first frame to the last
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
                            const std::string& output, PlacedObject& placed, bool shown) {
  Result<RecordingReader> reader = RecordingReader::open(input.path());
  if (!reader) return reader.error();
  if (is_corrected(reader->header())) return not_tracked(input.name(), kTracked);
  Result<std::optional<RecordedFrame>> first = reader->next();
  if (!first) return first.error();
  const std::int64_t start_ns = *first ? (*first)->time_ns : 0;
  if (*first) placed.start_animation(start_ns);
  ModelOptions model{!arguments.model.flat, nullptr};
  if (arguments.model.with_object) model.object = shown_object(placed);
  Result<RecordingWriter> writer = RecordingWriter::create(
      output, corrected_header(reader->header(), arguments, placed), {}, model);
  if (!writer) return writer.error();
  const Object object = placed.object();
  const CorrectorOptions options = options_of(arguments.method);
  std::array<HandCorrector, 2> correctors{HandCorrector(options), HandCorrector(options)};
  Summary summary;
  std::optional<Progress> progress;
  if (shown) progress.emplace("corrected", 0);
  const Result<std::size_t> frames = pipe_frames(
      *reader, std::move(first).value(),
      [&](RecordedFrame& frame) {
        placed.move_to(frame.time_ns);
        for (std::size_t side = 0; side < correctors.size(); ++side) {
          auto& hand = frame.hands[side];
          if (hand) correct_hand(*hand, correctors[side], object, frame.time_ns, summary);
        }
        summary.seconds = 1e-9 * static_cast<double>(frame.time_ns - start_ns);
        if (progress) progress->step();
      },
      *writer);
  if (!frames) return frames.error();
  summary.frames = *frames;
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

std::string as_line(const Summary& summary, const std::string& output) {
  return fmt::format(
      "{}: {} frames, hands corrected {}, released {}, free {}, untracked {}; a hand took {:.1f} "
      "us (median), {:.1f} us (p99)",
      output, summary.frames, summary.count(HandStatus::corrected),
      summary.count(HandStatus::released), summary.count(HandStatus::free),
      summary.count(HandStatus::untracked), summary.solve_us.quantile(0.5).value_or(0.0),
      summary.solve_us.quantile(0.99).value_or(0.0));
}

/// Corrects one recording; `placed` stands where the command line put it.
Result<Summary> correct_one(const CorrectArguments& arguments, const SpooledInput& input,
                            const std::string& output, PlacedObject& placed, bool shown) {
  if (arguments.press_m) {
    const Status pressed = press_onto(input.path(), *arguments.press_m, placed);
    if (!pressed) return pressed.error();
  }
  Result<Summary> summary = correct_all(arguments, input, output, placed, shown);
  if (!summary) return summary;
  if (const auto why = why_nothing(*summary, arguments)) {
    warn(fmt::format("{}: {}", input.name(), *why));
  }
  return summary;
}

Status run_on(const CorrectArguments& arguments, const SpooledInput& input) {
  Result<PlacedObject> placed = load_placed(arguments.object);
  if (!placed) return placed.error();
  const std::string& output = arguments.files.output;
  const Result<Summary> summary = correct_one(arguments, input, output, *placed, true);
  if (!summary) return summary.error();
  if (!arguments.json) {
    say(as_line(*summary, output));
    return ok_status();
  }
  return write_whole(*arguments.json, as_json(*summary, arguments, *placed).dump(2) + "\n");
}

/// What of a recording's summary can be summed up over many.
nlohmann::ordered_json figures_of(const Summary& summary) {
  nlohmann::ordered_json json{{"frames", summary.frames}, {"seconds", summary.seconds}};
  for (std::size_t i = 0; i < summary.hands.size(); ++i) {
    const auto status = static_cast<HandStatus>(i);
    json[fmt::format("hands {}", name_of(status))] = summary.hands[i];
  }
  return json;
}

/// An object for each thread: one that moves by itself is as it is in the frame that is corrected.
Status correct_many(const CorrectArguments& arguments) {
  Result<PlacedObject> first = load_placed(arguments.object);
  if (!first) return first.error();
  const Placement placement = first->placement;
  const std::size_t jobs = arguments.files.jobs > 0 ? arguments.files.jobs : cores();
  std::vector<std::optional<PlacedObject>> objects(jobs);
  objects.front() = std::move(first).value();
  std::string recipe = arguments.recipe;
  if (const auto file = object_file(arguments.object).path) recipe += " " + stamp_of(*file);
  return run_batch(
      arguments.files, recipe, "corrected",
      [&](const BatchItem& item, std::size_t worker) -> Result<nlohmann::ordered_json> {
        std::optional<PlacedObject>& placed = objects[worker];
        if (!placed) {
          Result<LoadedObject> loaded = load_object(*arguments.object.object);
          if (!loaded) return loaded.error();
          placed.emplace(PlacedObject{std::move(loaded).value(), placement});
        }
        placed->placement = placement;
        placed->animation_start_ns.reset();
        const Result<Summary> summary = correct_one(arguments, SpooledInput::unspooled(item.input),
                                                    item.output, *placed, false);
        if (!summary) return summary.error();
        return figures_of(*summary);
      });
}

Status run_correct(const CorrectArguments& arguments) {
  if (!arguments.object.object) {
    return misuse("--object is needed: plane, sphere, dog or a mesh file");
  }
  const Status method = check_method(arguments.method, MethodChange::never);
  if (!method) return method;
  if (arguments.files.many()) {
    if (!arguments.json) return correct_many(arguments);
    return misuse(
        "--json: expected with one recording only; of several, nade-done.jsonl beside "
        "the outputs has the figures");
  }
  const std::string& recording = arguments.files.inputs.front();
  const std::string& output = arguments.files.output;
  const Status apart = check_apart({{"--output", output}, {"--json", arguments.json}},
                                   {{"IN", recording}, object_file(arguments.object)});
  if (!apart) return apart;
  const Status name = check_recording_name("--output", output);
  if (!name) return name;
  const Result<SpooledInput> input =
      arguments.press_m ? SpooledInput::open(recording) : SpooledInput::unspooled(recording);
  if (!input) return input.error();
  return named(run_on(arguments, *input), *input);
}

}  // namespace

void add_correct(CLI::App& app, Action& action) {
  CLI::App* const command =
      app.add_subcommand("correct", "Puts the hands of a recording onto an object");
  const auto arguments = std::make_shared<CorrectArguments>();
  add_batch_options(*command, arguments->files);
  add_object_options(*command, arguments->object);
  add_press_option(*command, arguments->press_m);
  command->add_option("--json", arguments->json, "writes the summary as JSON; - is standard output")
      ->type_name("FILE");
  add_model_choice(*command, arguments->model);
  add_method_options(*command, arguments->method);
  command->callback([&action, arguments, command] {
    arguments->recipe = recipe_of(*command);
    action = [arguments] { return run_correct(*arguments); };
  });
}

}  // namespace nade::cli
