#pragma once

#include "headless.h"

namespace nade::viewer {

/// Opens a window and runs until it is closed, or as `run` says. The error says what is missing,
/// and what to do.
[[nodiscard]] Status run_window(ViewerSetup setup, const Run& run);

}  // namespace nade::viewer
