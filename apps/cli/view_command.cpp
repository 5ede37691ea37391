#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "commands.h"
#include "method_options.h"
#include "nade/eval/synth.h"
#include "object_options.h"
#include "picture_options.h"
#include "window.h"

namespace nade::cli {
namespace {

struct ViewArguments {
  std::optional<std::string> recording;
  ObjectOptions object;
  MethodOptions method;
  HandFiles hands;
  std::optional<double> press_m;
  PictureSize size;
  draw::Overlays overlays;
  std::optional<draw::Shown> shown;
  bool headless = false;
  std::optional<std::size_t> frames;
  std::optional<std::string> screenshot;
  std::optional<std::string> script;
};

/// Where the object stands, if the command line says anything about it.
std::optional<Placement> placement_of(const ObjectOptions& options) {
  if (!options.at && !options.turn && !options.scale) return std::nullopt;
  Placement placement;
  if (options.at) placement.pose.position = *options.at;
  if (options.turn) placement.pose.rotation = *options.turn;
  if (options.scale) placement.scale = *options.scale;
  return placement;
}

Result<viewer::Run> run_of(const ViewArguments& arguments) {
  viewer::Run run;
  run.width = arguments.size.width;
  run.height = arguments.size.height;
  run.frames = arguments.frames;
  run.screenshot = arguments.screenshot;
  if (!arguments.script) return run;
  std::ifstream file(*arguments.script, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) {
    return Error{ErrorCode::not_found, fmt::format("{}: cannot be read", *arguments.script)};
  }
  Result<std::vector<viewer::ScriptedStep>> script = viewer::parse_script(text, *arguments.script);
  if (!script) return script.error();
  run.script = std::move(script).value();
  return run;
}

Result<viewer::ViewerSetup> setup_of(const ViewArguments& arguments) {
  Result<draw::HandMeshes> hands = load_hands(arguments.hands);
  if (!hands) return hands.error();
  const Result<HandPose> relaxed = load_relaxed_hand(Handedness::right);
  if (!relaxed) return relaxed.error();
  viewer::ViewerSetup setup;
  setup.session.corrector = options_of(arguments.method);
  use_own_hands(arguments.hands, *hands, setup.session.corrector);
  setup.session.meshes = std::move(hands).value();
  setup.session.relaxed = *relaxed;
  setup.object = arguments.object.object;
  setup.placement = placement_of(arguments.object);
  setup.recording = arguments.recording;
  setup.press_m = arguments.press_m;
  setup.overlays = arguments.overlays;
  setup.shown = arguments.shown.value_or(draw::Shown::corrected);
  return setup;
}

Status run_view(const ViewArguments& arguments) {
  if (arguments.screenshot && !arguments.headless && !arguments.frames) {
    return Error{ErrorCode::out_of_range,
                 "--screenshot of a window is of its last frame: expected --frames N with it"};
  }
  const Result<viewer::Run> run = run_of(arguments);
  if (!run) return run.error();
  Result<viewer::ViewerSetup> setup = setup_of(arguments);
  if (!setup) return setup.error();
  return arguments.headless ? viewer::run_headless(std::move(setup).value(), *run)
                            : viewer::run_window(std::move(setup).value(), *run);
}

}  // namespace

void add_view(CLI::App& app, Action& action) {
  CLI::App* const command =
      app.add_subcommand("view", "Opens a window: a recording's hands, or a hand of the mouse");
  const auto arguments = std::make_shared<ViewArguments>();
  arguments->method.corrector.method = Method::nade;
  command->add_option("recording", arguments->recording, "the recording to open first")
      ->type_name("RECORDING");
  add_object_options(*command, arguments->object);
  command
      ->add_option("--press", arguments->press_m,
                   "how deep the palms lie: of the recording at the median, or of the mouse's hand")
      ->type_name("M")
      ->check(CLI::Range(0.0, 0.2));
  add_method_options(*command, arguments->method);
  add_hand_options(*command, arguments->hands);
  add_show_option(*command, arguments->shown);
  add_overlay_option(*command, arguments->overlays);
  add_size_option(*command, arguments->size);
  command->add_flag("--headless", arguments->headless,
                    "draws without a display, as fast as it can");
  command->add_option("--frames", arguments->frames, "ends after so many frames (headless: 60)")
      ->type_name("N")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000}));
  command->add_option("--screenshot", arguments->screenshot, "writes the last frame as a PNG file")
      ->type_name("FILE");
  command
      ->add_option("--script", arguments->script,
                   "does by itself what the lines of a file say (docs/viewer.md)")
      ->type_name("FILE");
  command->callback(
      [&action, arguments] { action = [arguments] { return run_view(*arguments); }; });
}

}  // namespace nade::cli
