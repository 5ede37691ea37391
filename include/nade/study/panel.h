#pragma once

#include <string>
#include <vector>

namespace nade::study {

/// What a person may press on a panel.
struct PanelButton {
  int id = 0;  ///< given back when it is pressed
  std::string label;
  bool chosen = false;  ///< the answer given, the option that is on
  bool enabled = true;  ///< shown but not to be pressed otherwise
};

/// A panel of text and buttons, the same in a window and floating in a headset: a heading, lines of
/// text, rows of buttons. Who draws it breaks lines.
struct PanelView {
  std::string heading;
  std::vector<std::string> lines;
  std::vector<std::vector<PanelButton>> rows;
};

}  // namespace nade::study
