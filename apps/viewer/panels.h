#pragma once

#include "desk.h"
#include "ui_kit.h"

namespace nade::viewer {

/// What is where in the window, pixels.
struct Layout {
  int width = 0;
  int height = 0;
  int controls_width = 0;  ///< at the left
  int figures_width = 0;   ///< at the right
  int foot_height = 0;     ///< below the scene
  Viewport scene;
};
[[nodiscard]] Layout layout_of(int width, int height, bool panels);

/// What to look at and how: object, method, hand, what is shown.
void draw_controls(UiKit& ui, Desk& desk, const Layout& layout);
/// Figures of the moment, plotted, and since the start.
void draw_figures(UiKit& ui, Desk& desk, const Layout& layout);
/// Under the scene: the recording's time, or what to do with the mouse.
void draw_foot(UiKit& ui, Desk& desk, const Layout& layout);
/// Over the scene: sentences for the person, and the keys.
void draw_notices(UiKit& ui, Desk& desk, const Layout& layout);
void draw_help(UiKit& ui, Desk& desk, const Layout& layout);

}  // namespace nade::viewer
