#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "method_options.h"
#include "nade/eval/synth.h"
#include "object_options.h"
#include "picture_options.h"
#include "press_option.h"
#include "window_options.h"

namespace nade::cli {
namespace {

struct ViewArguments {
  std::optional<std::string> recording;
  ObjectOptions object;
  MethodOptions method;
  HandFiles hands;
  std::optional<double> press_m;
  draw::Overlays overlays;
  std::optional<draw::Shown> shown;
  WindowOptions window;
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
  const WindowOptions& window = arguments.window;
  if (window.screenshot && !window.headless && !window.frames) {
    return misuse("--screenshot of a window is of its last frame: expected --frames N with it");
  }
  const Status method = check_method(arguments.method, MethodChange::any_time);
  if (!method) return method;
  std::vector<NamedFile> inputs = hand_files(arguments.hands);
  inputs.insert(inputs.end(), {{"RECORDING", arguments.recording}, object_file(arguments.object)});
  const Status screenshot = check_screenshot(window, std::move(inputs));
  if (!screenshot) return screenshot;
  const Result<viewer::Run> run = run_of(window);
  if (!run) return run.error();
  Result<viewer::ViewerSetup> setup = setup_of(arguments);
  if (!setup) return setup.error();
  return show_in(window, std::move(setup).value(), *run);
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
  add_press_option(*command, arguments->press_m)
      ->description(
          "how deep the palms lie: of the recording at the median, or of the mouse's hand");
  add_method_options(*command, arguments->method);
  add_hand_options(*command, arguments->hands);
  add_show_option(*command, arguments->shown);
  add_overlay_option(*command, arguments->overlays);
  add_window_options(*command, arguments->window, 1'000'000, "60");
  command->callback(
      [&action, arguments] { action = [arguments] { return run_view(*arguments); }; });
}

}  // namespace nade::cli
