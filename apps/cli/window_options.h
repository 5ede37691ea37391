#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "command_files.h"
#include "nade/status.h"
#include "picture_options.h"
#include "window.h"

namespace nade::cli {

/// A window, or what draws without one, and how long it stays.
struct WindowOptions {
  PictureSize size;
  bool headless = false;
  std::optional<std::size_t> frames;
  std::optional<std::string> screenshot;
  std::optional<std::string> script;
};

/// `without_display` is how long it stays there if nothing is said, for the help.
void add_window_options(CLI::App& command, WindowOptions& options, std::size_t frames_max,
                        const std::string& without_display);

/// Refuses a screenshot that is no PNG file, or would go over the script or what else is read.
[[nodiscard]] Status check_screenshot(const WindowOptions& options, std::vector<NamedFile> inputs);

/// Reads the script, if there is one. The error names the file and the line.
[[nodiscard]] Result<viewer::Run> run_of(const WindowOptions& options);

[[nodiscard]] Status show_in(const WindowOptions& options, viewer::ViewerSetup setup,
                             const viewer::Run& run);

}  // namespace nade::cli
