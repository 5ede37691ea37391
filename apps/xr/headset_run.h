#pragma once

#include <optional>
#include <string>

#include "graphics_binding.h"
#include "guide.h"

namespace nade::xr {

/// How `nade xr` and the study in the headset run.
struct HeadsetRun {
  std::optional<GraphicsWay> graphics;  ///< without a value whichever the runtime offers
  double eye_scale = 1.0;               ///< of each eye's picture, of what the headset asks for
  std::optional<std::size_t> frames;    ///< leaves after so many that were shown
  std::optional<std::string>
      screenshot;                     ///< what both eyes saw last: FILE-left.png, FILE-right.png
  std::optional<std::string> record;  ///< a recording; the corrected one is beside it
  /// A line of JSON for each panel that is shown: its buttons, and where they are in the headset's
  /// space. For programs that watch or press it.
  std::optional<std::string> panel_log;
  bool report = false;  ///< says at the end what frames cost
  bool mirror = false;  ///< a window for the operator
};

/// Shows the guide's room in the headset until the person, the runtime or Ctrl-C ends it. A session
/// or runtime that is lost is waited for. Sentences for the operator go to standard error.
[[nodiscard]] Status run_headset(const HeadsetRun& run, RoomSetup room, Guide& guide);

}  // namespace nade::xr
