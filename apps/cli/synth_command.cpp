#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "command_files.h"
#include "commands.h"
#include "console.h"
#include "nade/correction.h"
#include "nade/eval/synth.h"
#include "nade/io/recording.h"
#include "number_options.h"
#include "object_options.h"

namespace nade::cli {
namespace {

struct SynthArguments {
  std::string output;
  ObjectOptions object;
  SynthOptions synth;
  double tilt_deg = 0.0;
};

std::optional<Handedness> hand_from_name(std::string_view name) {
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    if (name == name_of(side)) return side;
  }
  return std::nullopt;
}

/// An option whose text `parse` turns into a value, or into none where it is not `expected`.
template <class T>
void add_parsed(CLI::App& command, const std::string& name, T& value,
                std::optional<T> (*parse)(std::string_view), const std::string& expected,
                const std::string& help) {
  command
      .add_option_function<std::string>(
          name,
          [=, &value](const std::string& text) {
            const std::optional<T> parsed = parse(text);
            if (!parsed) {
              throw CLI::ValidationError(name,
                                         fmt::format("expected {}, found '{}'", expected, text));
            }
            value = *parsed;
          },
          help)
      ->type_name(expected);
}

/// What goes farther in a frame than this, and so many times its speed's way, jumps.
constexpr double kJump_m = 0.05;
constexpr double kJumpOfWay = 4.0;

/// Where a stroke's hand jumps: a step of the surface is one of the hand that follows it.
struct FarthestJump {
  double length_m = 0.0;
  double time_s = 0.0;
  std::optional<HandPose> before;

  void take(const RecordedFrame& frame, const SynthOptions& options) {
    const auto& hand = frame.hands[index_of(options.side)];
    if (!hand) {
      before.reset();
      return;
    }
    const double way_m = before ? largest_motion(*before, hand->pose) : 0.0;
    before = hand->pose;
    const double far_m = kJump_m + kJumpOfWay * options.speed_m_per_s / options.rate_hz;
    if (way_m <= std::max(far_m, length_m)) return;
    length_m = way_m;
    time_s = 1e-9 * static_cast<double>(frame.time_ns);
  }
};

Status run_synth(const SynthArguments& arguments) {
  const Status apart =
      check_apart({{"--output", arguments.output}}, {object_file(arguments.object)});
  if (!apart) return apart;
  const Status name = check_recording_name("--output", arguments.output);
  if (!name) return name;
  SynthOptions options = arguments.synth;
  options.tilt_rad = arguments.tilt_deg * kDegree;
  const Result<PlacedObject> placed = load_placed(arguments.object);
  if (!placed) return placed.error();
  const Result<HandPose> relaxed = load_relaxed_hand(options.side);
  if (!relaxed) return relaxed.error();
  Result<StrokeSynth> synth =
      StrokeSynth::create(placed->loaded, placed->placement, *relaxed, options);
  if (!synth) return synth.error();
  Result<RecordingWriter> writer = RecordingWriter::create(arguments.output, synth->header());
  if (!writer) return writer.error();
  FarthestJump jump;
  while (const auto frame = synth->next()) {
    const Status written = writer->write(*frame);
    if (!written.ok()) return written;
    jump.take(*frame, options);
  }
  if (jump.length_m > 0.0) {
    warn(
        fmt::format("{}: the hand jumps, farthest by {:.0f} mm at {:.2f} s: the surface that it "
                    "follows has a step there",
                    placed->loaded.spec, 1e3 * jump.length_m, jump.time_s));
  }
  return writer->finish();
}

}  // namespace

void add_synth(CLI::App& app, Action& action) {
  CLI::App* const command =
      app.add_subcommand("synth", "Makes a recording of a hand that strokes an object");
  const auto arguments = std::make_shared<SynthArguments>();
  SynthOptions& synth = arguments->synth;
  command->add_option("-o,--output", arguments->output, "the recording to write; - is stdout")
      ->type_name("OUT")
      ->required();
  add_object_options(*command, arguments->object);
  add_parsed(*command, "--stroke", synth.stroke, stroke_from_name, "line|circle|zigzag|curl|press",
             "how the hand moves (default line)");
  command
      ->add_option("--place", synth.place,
                   "where on the object: on the dog back|flank|head|ear|leg")
      ->type_name("PLACE");
  command->add_option("--speed", synth.speed_m_per_s, "mean speed of the palm while it strokes")
      ->type_name("M_PER_S")
      ->capture_default_str();
  command->add_option("--depth", synth.depth_m, "of the palm's skin below the surface")
      ->type_name("M")
      ->capture_default_str();
  command
      ->add_option("--tilt", arguments->tilt_deg,
                   "of the hand against the surface; above 0 raises the fingertips")
      ->type_name("DEG")
      ->capture_default_str();
  add_parsed(*command, "--hand", synth.side, hand_from_name, "left|right",
             "which hand (default right)");
  command->add_option("--duration", synth.duration_s, "of the recording")
      ->type_name("S")
      ->capture_default_str();
  command->add_option("--rate", synth.rate_hz, "frames a second")
      ->type_name("HZ")
      ->capture_default_str();
  add_parsed(*command, "--noise", synth.noise, noise_from_name, "none|leap|quest",
             "whose tracking errors the hand bears (default none)");
  command->add_option("--seed", synth.seed, "of the tracking errors")
      ->type_name("N")
      ->transform(whole_number())
      ->capture_default_str();
  command->add_option("--hand-scale", synth.hand_scale, "how many times larger the hand is")
      ->type_name("S")
      ->capture_default_str();
  command->callback(
      [&action, arguments] { action = [arguments] { return run_synth(*arguments); }; });
}

}  // namespace nade::cli
