#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "choice_option.h"
#include "chooser.h"
#include "commands.h"
#include "headset_run.h"
#include "method_options.h"
#include "number_options.h"
#include "object_options.h"
#include "picture_options.h"

namespace nade::cli {
namespace {

struct XrArguments {
  ObjectOptions object;
  MethodOptions method;
  HandFiles hands;
  std::optional<draw::Shown> shown;
  xr::HeadsetRun run;
};

Status run_xr(const XrArguments& arguments) {
  if (arguments.run.screenshot && !arguments.run.frames) {
    return misuse("--screenshot is of the last frame: expected --frames N with it");
  }
  const Status method = check_method(arguments.method, MethodChange::any_time);
  if (!method) return method;
  std::vector<NamedFile> inputs = hand_files(arguments.hands);
  inputs.push_back(object_file(arguments.object));
  const Status apart = check_apart(
      {{"--record", arguments.run.record}, {"--panel-log", arguments.run.panel_log}}, inputs);
  if (!apart) return apart;
  Result<draw::HandMeshes> hands = load_hands(arguments.hands);
  if (!hands) return hands.error();
  xr::RoomSetup room;
  room.corrector = options_of(arguments.method);
  use_own_hands(arguments.hands, *hands, room.corrector);
  room.hands = std::move(hands).value();
  if (arguments.object.at || arguments.object.turn || arguments.object.scale) {
    room.placement.emplace();
    if (arguments.object.at) room.placement->pose.position = *arguments.object.at;
    if (arguments.object.turn) room.placement->pose.rotation = *arguments.object.turn;
    if (arguments.object.scale) room.placement->scale = *arguments.object.scale;
  }
  room.objects = {"plane", "sphere", "dog"};
  const std::string first = arguments.object.object.value_or("sphere");
  const auto known = std::find(room.objects.begin(), room.objects.end(), first);
  if (known == room.objects.end()) {
    room.objects.insert(room.objects.begin(), first);
  } else {
    std::rotate(room.objects.begin(), known, known + 1);
  }
  xr::Chooser::Setup choice;
  choice.objects = room.objects;
  choice.method = room.corrector.method;
  choice.shown = arguments.shown.value_or(draw::Shown::corrected);
  choice.show_time = arguments.run.report;
  xr::Chooser chooser(std::move(choice));
  return xr::run_headset(arguments.run, std::move(room), chooser);
}

}  // namespace

void add_xr(CLI::App& app, Action& action) {
  CLI::App* const command =
      app.add_subcommand("xr", "Shows object and hands in a headset, by OpenXR");
  const auto arguments = std::make_shared<XrArguments>();
  arguments->method.corrector.method = Method::nade;
  add_object_options(*command, arguments->object);
  add_method_options(*command, arguments->method);
  add_hand_options(*command, arguments->hands);
  add_show_option(*command, arguments->shown);
  command
      ->add_option("--record", arguments->run.record,
                   "records the tracked hands there, and the corrected ones beside it")
      ->type_name("FILE");
  command
      ->add_option("--eye-scale", arguments->run.eye_scale,
                   "each eye's picture so many times as wide and high as the headset asks")
      ->type_name("FACTOR")
      ->transform(number_in(0.1, 2.0));
  command->add_option("--frames", arguments->run.frames, "leaves after so many frames")
      ->type_name("N")
      ->transform(whole_number_in(1, 100'000'000));
  command
      ->add_option("--screenshot", arguments->run.screenshot,
                   "writes what both eyes saw last, as FILE-left.png and FILE-right.png")
      ->type_name("FILE");
  command->add_flag("--time", arguments->run.report,
                    "shows what a correction takes, and at the end what frames took");
  command
      ->add_option("--panel-log", arguments->run.panel_log,
                   "writes what the panel shows, and where its buttons are, as lines of JSON")
      ->type_name("FILE");
  command->add_flag("--mirror", arguments->run.mirror,
                    "a window for the operator: what is seen, and figures");
  add_choice<xr::GraphicsWay>(*command, "--graphics", arguments->run.graphics,
                              {{"egl", xr::GraphicsWay::egl}, {"xlib", xr::GraphicsWay::xlib}},
                              "how pictures reach the runtime, if not in the way it offers");
  command->callback([&action, arguments] { action = [arguments] { return run_xr(*arguments); }; });
}

}  // namespace nade::cli
