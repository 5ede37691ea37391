#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "commands.h"
#include "console.h"
#include "io/operating_system.h"
#include "nade/version.h"

namespace {

constexpr int kDone = 0;
constexpr int kCouldNot = 1;
constexpr int kMisuse = 2;

std::string names_of_commands(const CLI::App& app) {
  std::string names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names += (names.empty() ? "" : ", ") + command->get_name();
  }
  return names;
}

/// What is wrong with a command's words. CLI11 does not name what stands where a command should,
/// and lists what is left over backwards.
std::string sentence_of(const CLI::App& command, const CLI::ParseError& error) {
  const std::vector<std::string> left = command.remaining();
  if (command.get_require_subcommand_min() > 0 && command.get_subcommands().empty()) {
    return fmt::format("expected a command ({}), found {}", names_of_commands(command),
                       left.empty() ? "none" : fmt::format("'{}'", left.front()));
  }
  if (left.empty()) return error.what();
  return fmt::format("expected nothing more, found '{}'", fmt::join(left, " "));
}

int parse_error(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
    app.exit(error);  // help or version
    return kDone;
  }
  const CLI::App* command = &app;
  std::string name = app.get_name();
  while (command->remaining().empty() && !command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
    name += " " + command->get_name();
  }
  nade::cli::warn(fmt::format("{} ({} --help tells the rest)", sentence_of(*command, error), name));
  return kMisuse;
}

/// An empty word is what a script's unset variable leaves. CLI11 takes it for 0.
nade::Status check_words(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& word : option->results()) {
      if (!word.empty()) continue;
      return nade::cli::misuse(
          fmt::format("{}: expected a value, found an empty one", option->get_name()));
    }
  }
  for (const CLI::App* command : app.get_subcommands()) {
    if (const nade::Status words = check_words(*command); !words) return words;
  }
  return nade::ok_status();
}

int run(int argc, char** argv) {
  CLI::App app{"nade keeps a tracked hand on the surface it strokes.", "nade"};
  app.allow_windows_style_options(false);  // "/work/stroke.jsonl" is a path there, too
  app.set_version_flag("--version", std::string("nade ") + NADE_VERSION);
  app.require_subcommand(1);
  nade::cli::Action action;
  nade::cli::add_correct(app, action);
  nade::cli::add_measure(app, action);
  nade::cli::add_synth(app, action);
  nade::cli::add_convert(app, action);
  nade::cli::add_inspect(app, action);
  nade::cli::add_bench(app, action);
#ifdef NADE_CLI_STUDY
  nade::cli::add_study(app, action);
#endif
#ifdef NADE_CLI_DRAW
  nade::cli::add_render(app, action);
  nade::cli::add_figure(app, action);
#endif
#ifdef NADE_CLI_VIEWER
  nade::cli::add_view(app, action);
#endif
#ifdef NADE_CLI_XR
  nade::cli::add_xr(app, action);
#endif
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return parse_error(app, error);
  }
  const nade::Status words = check_words(app);
  const nade::Status status = words ? action() : words;
  if (status.ok()) return kDone;
  nade::cli::warn(status.error().message);
  return status.error().code == nade::ErrorCode::out_of_range ? kMisuse : kCouldNot;
}

}  // namespace

int main(int argc, char** argv) {
  nade::os::prepare_streams();
  try {
    return run(argc, argv);
  } catch (const std::exception& unforeseen) {  // out of memory, at worst
    std::fprintf(stderr, "nade: %s\n", unforeseen.what());
    return kCouldNot;
  }
}
