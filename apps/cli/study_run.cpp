#include "study_run.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>
#include <vector>

#include "command_files.h"
#include "console.h"
#include "number_options.h"
#ifdef NADE_CLI_DRAW
#include "nade/draw/text.h"
#endif
#ifdef NADE_CLI_VIEWER
#include "method_options.h"
#include "nade/eval/synth.h"
#include "nade/version.h"
#include "picture_options.h"
#include "script_player.h"
#include "window_options.h"
#endif

namespace nade::cli {
namespace {

#ifdef NADE_CLI_VIEWER

/// Of a study in a window.
struct DesktopArguments {
  HandFiles hands;
  WindowOptions window;
};

constexpr std::size_t kFramesMax = 10'000'000;

/// Without a window nobody answers, so that a run has to say when it ends.
Status check_end(const WindowOptions& window) {
  if (!window.headless || window.script || window.frames) return ok_status();
  return misuse(
      "--headless: expected --script FILE, which presses the panel's buttons (docs/study.md), or "
      "--frames N");
}

Status run_on_desktop(const StudyRunArguments& study, const DesktopArguments& arguments) {
  const Status ends = check_end(arguments.window);
  if (!ends) return ends;
  std::vector<NamedFile> inputs = hand_files(arguments.hands);
  inputs.push_back({"PLAN", study.plan});
  const Status screenshot = check_screenshot(arguments.window, std::move(inputs));
  if (!screenshot) return screenshot;
  Result<viewer::Run> run = run_of(arguments.window);
  if (!run) return run.error();
  if (arguments.window.headless && !run->frames) run->frames = viewer::frames_of(run->script);
  Result<draw::HandMeshes> hands = load_hands(arguments.hands);
  if (!hands) return hands.error();
  const Result<HandPose> relaxed = load_relaxed_hand(Handedness::right);
  if (!relaxed) return relaxed.error();
  Result<std::unique_ptr<study::StudyRun>> opened = open_study(study, {"mouse", false});
  if (!opened) return opened.error();
  viewer::ViewerSetup setup;
  setup.object = (*opened)->session().plan().objects.front().spec;
  setup.study = std::make_shared<viewer::StudyDesk>(std::move(opened).value(), study.speed);
  MethodOptions method;
  method.corrector.method = Method::nade;
  setup.session.corrector = options_of(method);
  use_own_hands(arguments.hands, *hands, setup.session.corrector);
  setup.session.meshes = std::move(hands).value();
  setup.session.relaxed = *relaxed;
  const auto desk = setup.study;
  const Status shown = show_in(arguments.window, std::move(setup), *run);
  return close_study(shown, desk->run());
}

void add_desktop_options(CLI::App& command, DesktopArguments& arguments) {
  add_hand_options(command, arguments.hands);
  add_window_options(command, arguments.window, kFramesMax, "to the script's end");
}

#else

struct DesktopArguments {};

Status run_on_desktop(const StudyRunArguments&, const DesktopArguments&) {
  return Error{ErrorCode::not_found,
               "--desktop: expected a nade with its window, found one built without it"};
}

void add_desktop_options(CLI::App&, DesktopArguments&) {}

#endif

struct RunArguments {
  StudyRunArguments study;
  DesktopArguments desktop;
  bool desktop_asked = false;
  bool headset_asked = false;
};

Status run_study(const RunArguments& arguments) {
  const Status apart =
      check_apart({{"--panel-log", arguments.study.panel_log}}, {{"PLAN", arguments.study.plan}});
  if (!apart) return apart;
  if (arguments.headset_asked) return run_study_in_headset(arguments.study);
  return run_on_desktop(arguments.study, arguments.desktop);
}

}  // namespace

#ifndef NADE_CLI_STUDY_XR
Status run_study_in_headset(const StudyRunArguments&) {
  return Error{ErrorCode::not_found,
               "--xr: expected a nade built with OpenXR, found one without it (Debian: "
               "libopenxr-dev)"};
}
#endif

Result<std::unique_ptr<study::StudyRun>> open_study(const StudyRunArguments& arguments,
                                                    const HandSource& source) {
  Result<study::Plan> plan = study::read_plan(arguments.plan);
  if (!plan) return plan.error();
  if (arguments.language == "en") plan->language = study::Language::english;
  if (arguments.language == "ja") plan->language = study::Language::japanese;
#ifdef NADE_CLI_DRAW
  if (plan->language == study::Language::japanese && !draw::japanese_font()) {
    return Error{ErrorCode::not_found, std::string(draw::kNoJapaneseFont)};
  }
#endif
  const std::filesystem::path path(arguments.plan);
  study::RunOptions options;
  options.store.folder = arguments.folder.value_or((path.parent_path() / path.stem()).string());
  options.store.participant = arguments.participant;
  options.store.tool = "nade " NADE_VERSION;
  options.store.speed = arguments.speed;
  options.plan_folder = path.parent_path().string();
  options.source = source.name;
  options.hand_scale_known = source.scale_known;
  Result<std::unique_ptr<study::StudyRun>> run = study::StudyRun::open(*plan, std::move(options));
  if (!run) return run.error();
  for (const std::string& note : (*run)->store().notes()) warn(note);
  return run;
}

Status close_study(const Status& shown, study::StudyRun& run) {
  if (!shown && run.withdraw()) return shown;
  if (!run.status().ok()) return run.status();
  const study::StudyProgress& progress = run.session().progress();
  std::size_t open = 0;
  for (const auto fate : progress.trials) {
    open += fate == study::StudyProgress::Fate::open ? 1 : 0;
  }
  if (run.dropped_frames() > 0) {
    warn(fmt::format("{}: the disk was too slow for {} frames of motion", run.store().folder(),
                     run.dropped_frames()));
  }
  say(open == 0 ? fmt::format("{}: done", run.store().folder())
                : fmt::format("{}: {} of {} trials still to be done; the same command goes on",
                              run.store().folder(), open, progress.trials.size()));
  return shown;
}

void add_study_run(CLI::App& study, Action& action) {
  CLI::App* const command = study.add_subcommand(
      "run", "Runs a participant's study, or goes on with it where it was stopped");
  const auto arguments = std::make_shared<RunArguments>();
  command->add_option("plan", arguments->study.plan, "the study's plan")
      ->type_name("PLAN")
      ->required();
  command
      ->add_option("--participant", arguments->study.participant,
                   "letters, digits, - and _: no names")
      ->type_name("ID")
      ->required();
  command
      ->add_option("-d,--directory", arguments->study.folder,
                   "the study's folder (default: beside the plan, by its name)")
      ->type_name("DIR");
  command->add_option("--language", arguments->study.language, "in place of the plan's")
      ->type_name("en|ja")
      ->check(CLI::IsMember({"en", "ja"}));
  CLI::Option* const desktop = command->add_flag("--desktop", arguments->desktop_asked,
                                                 "in a window, with the mouse's hand (default)");
  command->add_flag("--xr", arguments->headset_asked, "in a headset")->excludes(desktop);
  command->add_flag("--mirror", arguments->study.mirror,
                    "with --xr: a window for the operator, what is seen and figures");
  command
      ->add_option("--panel-log", arguments->study.panel_log,
                   "with --xr: writes what the panel shows as lines of JSON, for programs")
      ->type_name("FILE");
  command
      ->add_option("--speed", arguments->study.speed,
                   "so many times faster, to try a plan out; the data say so")
      ->type_name("X")
      ->check(number_in(0.1, 100.0));
  add_desktop_options(*command, arguments->desktop);
  command->callback(
      [&action, arguments] { action = [arguments] { return run_study(*arguments); }; });
}

}  // namespace nade::cli
