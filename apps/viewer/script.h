#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "input.h"
#include "nade/status.h"

namespace nade::viewer {

/// A click on a widget by its name, as tooltips and tests know it.
struct ScriptedClick {
  std::string widget;
  double across = 0.5;  ///< where, as a share of the widget's width
};

/// What a script does in one frame, in its order: an event or a click.
struct ScriptedStep {
  std::size_t frame = 0;
  std::variant<Event, ScriptedClick> act;
};

/// Reads a script: a line a step, "FRAME WHAT …", with frames in order, counted from 0. Empty
/// lines and what follows # do not count.
///
///     0 move X Y                the pointer, in pixels
///     0 glide X Y FRAMES        the pointer, evenly over so many frames
///     0 wheel NOTCHES
///     0 down left | up left     or right, middle
///     0 key NAME | hold NAME | release NAME
///     0 click WIDGET [ACROSS]   ACROSS from 0 to 1, for sliders
///     0 drop PATH
///
/// The error names the line and what was expected.
[[nodiscard]] Result<std::vector<ScriptedStep>> parse_script(std::string_view text,
                                                             const std::string& name);

}  // namespace nade::viewer
