#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <string>

#include "commands.h"
#include "nade/eval/synth.h"
#include "nade/io/recording.h"
#include "object_options.h"

namespace nade::cli {
namespace {

struct SynthArguments {
  std::string output;
  ObjectOptions object;
  SynthOptions synth;
  double tilt_deg = 0.0;
};

const std::map<std::string, Stroke> kStrokes{{"line", Stroke::line},
                                             {"circle", Stroke::circle},
                                             {"zigzag", Stroke::zigzag},
                                             {"curl", Stroke::curl},
                                             {"press", Stroke::press}};
const std::map<std::string, Handedness> kHands{{"left", Handedness::left},
                                               {"right", Handedness::right}};
const std::map<std::string, NoiseModel> kNoises{
    {"none", NoiseModel::none}, {"leap", NoiseModel::leap}, {"quest", NoiseModel::quest}};

Status run_synth(const SynthArguments& arguments) {
  SynthOptions options = arguments.synth;
  options.tilt_rad = arguments.tilt_deg * std::numbers::pi / 180.0;
  const Result<PlacedObject> placed = load_placed(arguments.object);
  if (!placed) return placed.error();
  const Result<HandPose> relaxed = load_relaxed_hand(options.side);
  if (!relaxed) return relaxed.error();
  Result<StrokeSynth> synth =
      StrokeSynth::create(placed->loaded, placed->placement, *relaxed, options);
  if (!synth) return synth.error();
  Result<RecordingWriter> writer = RecordingWriter::create(arguments.output, synth->header());
  if (!writer) return writer.error();
  while (const auto frame = synth->next()) {
    const Status written = writer->write(*frame);
    if (!written.ok()) return written;
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
  command->add_option("--stroke", synth.stroke, "how the hand moves")
      ->transform(CLI::CheckedTransformer(kStrokes).description("line|circle|zigzag|curl|press"));
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
  command->add_option("--hand", synth.side, "which hand")
      ->transform(CLI::CheckedTransformer(kHands).description("left|right"));
  command->add_option("--duration", synth.duration_s, "of the recording")
      ->type_name("S")
      ->capture_default_str();
  command->add_option("--rate", synth.rate_hz, "frames a second")
      ->type_name("HZ")
      ->capture_default_str();
  command->add_option("--noise", synth.noise, "whose tracking errors the hand bears")
      ->transform(CLI::CheckedTransformer(kNoises).description("none|leap|quest"));
  command->add_option("--seed", synth.seed, "of the tracking errors")
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--hand-scale", synth.hand_scale, "how many times larger the hand is")
      ->type_name("S")
      ->capture_default_str();
  command->callback(
      [&action, arguments] { action = [arguments] { return run_synth(*arguments); }; });
}

}  // namespace nade::cli
