#include "script.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

namespace nade::viewer {
namespace {

constexpr std::size_t kFramesMax = 1'000'000;

/// The words of one line, and where it stands.
struct Line {
  std::vector<std::string> words;
  std::string place;

  [[nodiscard]] Error refuse(std::string_view expected) const {
    return {ErrorCode::bad_format, fmt::format("{}: expected {}", place, expected)};
  }
  [[nodiscard]] std::optional<double> number(std::size_t at) const {
    if (at >= words.size()) return std::nullopt;
    const std::string& word = words[at];
    double value = 0.0;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (code != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) {
      return std::nullopt;
    }
    return value;
  }
};

using Steps = std::vector<ScriptedStep>;

Status add_pointer(const Line& line, std::size_t frame, Event& pointer, Steps& steps) {
  const auto x = line.number(2);
  const auto y = line.number(3);
  if (line.words[1] == "move") {
    if (line.words.size() != 4 || !x || !y) return line.refuse("FRAME move X Y");
    pointer.x = *x;
    pointer.y = *y;
    steps.push_back({frame, pointer});
    return ok_status();
  }
  const auto frames = line.number(4);
  if (line.words.size() != 5 || !x || !y || !frames || !(*frames >= 1.0) ||
      !(*frames <= static_cast<double>(kFramesMax))) {
    return line.refuse("FRAME glide X Y FRAMES");
  }
  const Event from = pointer;
  const auto count = static_cast<std::size_t>(*frames);
  for (std::size_t i = 1; i <= count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count);
    pointer.x = from.x + share * (*x - from.x);
    pointer.y = from.y + share * (*y - from.y);
    steps.push_back({frame + i - 1, pointer});
  }
  return ok_status();
}

Status add_button(const Line& line, std::size_t frame, const Event& pointer, Steps& steps) {
  Event event = pointer;
  event.kind = Event::Kind::button;
  event.change = line.words[1] == "down" ? Change::down : Change::up;
  const std::string which = line.words.size() == 3 ? line.words[2] : "";
  if (which == "left") {
    event.button = Button::left;
  } else if (which == "right") {
    event.button = Button::right;
  } else if (which == "middle") {
    event.button = Button::middle;
  } else {
    return line.refuse("FRAME down left, right or middle");
  }
  steps.push_back({frame, event});
  return ok_status();
}

Status add_key(const Line& line, std::size_t frame, Steps& steps) {
  const std::optional<Key> key =
      line.words.size() == 3 ? key_from_name(line.words[2]) : std::nullopt;
  if (!key) return line.refuse("FRAME key NAME, with a key that the viewer knows");
  Event event;
  event.kind = Event::Kind::key;
  event.key = *key;
  if (line.words[1] != "release") steps.push_back({frame, event});
  event.change = Change::up;
  if (line.words[1] == "release") steps.push_back({frame, event});
  if (line.words[1] == "key") steps.push_back({frame + 1, event});
  return ok_status();
}

Status add_click(const Line& line, std::size_t frame, Steps& steps) {
  const std::size_t words = line.words.size();
  const auto across = line.number(3);
  if (words < 3 || words > 4 || (words == 4 && !(across && *across >= 0.0 && *across <= 1.0))) {
    return line.refuse("FRAME click WIDGET [ACROSS], ACROSS from 0 to 1");
  }
  steps.push_back({frame, ScriptedClick{line.words[2], across.value_or(0.5)}});
  return ok_status();
}

Status add_other(const Line& line, std::size_t frame, Steps& steps) {
  Event event;
  if (line.words[1] == "wheel") {
    const auto notches = line.number(2);
    if (line.words.size() != 3 || !notches) return line.refuse("FRAME wheel NOTCHES");
    event.kind = Event::Kind::wheel;
    event.wheel = *notches;
  } else if (line.words[1] == "drop") {
    if (line.words.size() < 3) return line.refuse("FRAME drop PATH");
    event.kind = Event::Kind::drop;
    event.path = line.words[2];
    for (std::size_t i = 3; i < line.words.size(); ++i) event.path += ' ' + line.words[i];
  } else {
    return line.refuse("move, glide, wheel, down, up, key, hold, release, click or drop");
  }
  steps.push_back({frame, event});
  return ok_status();
}

Status add_line(const Line& line, Event& pointer, Steps& steps) {
  const auto frame = line.number(0);
  if (!frame || *frame < 0.0 || *frame > static_cast<double>(kFramesMax) || line.words.size() < 2) {
    return line.refuse("FRAME WHAT …, as in '10 move 640 360'");
  }
  const auto at = static_cast<std::size_t>(*frame);
  const std::string& what = line.words[1];
  if (what == "move" || what == "glide") return add_pointer(line, at, pointer, steps);
  if (what == "down" || what == "up") return add_button(line, at, pointer, steps);
  if (what == "key" || what == "hold" || what == "release") return add_key(line, at, steps);
  if (what == "click") return add_click(line, at, steps);
  return add_other(line, at, steps);
}

}  // namespace

Result<std::vector<ScriptedStep>> parse_script(std::string_view text, const std::string& name) {
  std::istringstream lines{std::string(text)};
  Steps steps;
  Event pointer;
  std::string content;
  for (std::size_t number = 1; std::getline(lines, content); ++number) {
    Line line{{}, fmt::format("{}: line {}", name, number)};
    std::istringstream words(content.substr(0, content.find('#')));
    for (std::string word; words >> word;) line.words.push_back(word);
    if (line.words.empty()) continue;
    const Status added = add_line(line, pointer, steps);
    if (!added) return added.error();
  }
  std::stable_sort(steps.begin(), steps.end(),
                   [](const ScriptedStep& a, const ScriptedStep& b) { return a.frame < b.frame; });
  return steps;
}

}  // namespace nade::viewer
