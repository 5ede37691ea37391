#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "nade/eval/press.h"
#include "nade/status.h"
#include "object_options.h"

namespace nade::cli {

/// `--press`: how deep a recording's palms lie in the object, metres.
CLI::Option* add_press_option(CLI::App& command, std::optional<double>& press_m);

/// Moves the object so that the palms of the recording at `path` lie so deep at the median.
[[nodiscard]] Status press_onto(const PalmTrack& palms, const std::string& path, double press_m,
                                PlacedObject& placed);
/// The same, with the palms read from the recording.
[[nodiscard]] Status press_onto(const std::string& path, double press_m, PlacedObject& placed);

}  // namespace nade::cli
