#include "input.h"

#include <algorithm>

namespace nade::viewer {
namespace {

constexpr std::array<std::string_view, kKeyCount> kNames{
    "a",      "b",    "c",     "d",  "e",    "f",    "g",   "h",     "k",      "l",     "m",
    "o",      "p",    "q",     "r",  "s",    "t",    "v",   "w",     "x",      "z",     "1",
    "2",      "3",    "4",     "5",  "-",    "+",    ",",   ".",     "?",      "space", "tab",
    "escape", "left", "right", "up", "down", "home", "end", "shift", "control"};

}  // namespace

std::optional<Key> key_from_name(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<Key>(found - kNames.begin());
}

void Input::start_frame(double seconds) {
  step_s = seconds;
  elapsed_s = seconds;
  moved_x = 0.0;
  moved_y = 0.0;
  wheel = 0.0;
  pressed.clear();
  dropped.clear();
}

void Input::take(const Event& event) {
  switch (event.kind) {
    case Event::Kind::move:
      if (inside) {
        moved_x += event.x - x;
        moved_y += event.y - y;
      }
      x = event.x;
      y = event.y;
      inside = true;
      break;
    case Event::Kind::leave:
      inside = false;
      break;
    case Event::Kind::button:
      buttons[static_cast<std::size_t>(event.button)] = event.change == Change::down;
      break;
    case Event::Kind::wheel:
      wheel += event.wheel;
      break;
    case Event::Kind::key:
      held[static_cast<std::size_t>(event.key)] = event.change == Change::down;
      if (event.change == Change::down) pressed.push_back(event.key);
      break;
    case Event::Kind::drop:
      dropped.push_back(event.path);
      break;
  }
}

}  // namespace nade::viewer
