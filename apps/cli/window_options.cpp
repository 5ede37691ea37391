#include "window_options.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

#include "number_options.h"

namespace nade::cli {

void add_window_options(CLI::App& command, WindowOptions& options, std::size_t frames_max,
                        const std::string& without_display) {
  add_size_option(command, options.size);
  command.add_flag("--headless", options.headless, "draws without a display, as fast as it can");
  command
      .add_option("--frames", options.frames,
                  fmt::format("ends after so many frames (headless: {})", without_display))
      ->type_name("N")
      ->transform(whole_number_in(1, frames_max));
  command.add_option("--screenshot", options.screenshot, "writes the last frame as a PNG file")
      ->type_name("FILE");
  command
      .add_option("--script", options.script,
                  "does by itself what the lines of a file say (docs/viewer.md)")
      ->type_name("FILE");
}

Status check_screenshot(const WindowOptions& options, std::vector<NamedFile> inputs) {
  if (!options.screenshot) return ok_status();
  const Status png = check_png("--screenshot", *options.screenshot);
  if (!png) return png;
  inputs.push_back({"--script", options.script});
  return check_apart({{"--screenshot", options.screenshot}}, inputs);
}

Result<viewer::Run> run_of(const WindowOptions& options) {
  viewer::Run run;
  run.width = options.size.width;
  run.height = options.size.height;
  run.frames = options.frames;
  run.screenshot = options.screenshot;
  if (!options.script) return run;
  std::ifstream file(*options.script, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) {
    return Error{ErrorCode::not_found, fmt::format("{}: cannot be read", *options.script)};
  }
  Result<std::vector<viewer::ScriptedStep>> script = viewer::parse_script(text, *options.script);
  if (!script) return script.error();
  run.script = std::move(script).value();
  return run;
}

Status show_in(const WindowOptions& options, viewer::ViewerSetup setup, const viewer::Run& run) {
  return options.headless ? viewer::run_headless(std::move(setup), run)
                          : viewer::run_window(std::move(setup), run);
}

}  // namespace nade::cli
