#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nade::viewer {

/// The keys that mean something. Letters and signs are called as they are printed.
enum class Key : std::uint8_t {
  a,
  b,
  c,
  d,
  e,
  f,
  g,
  h,
  k,
  l,
  m,
  o,
  p,
  q,
  r,
  s,
  t,
  v,
  w,
  x,
  z,
  one,
  two,
  three,
  four,
  five,
  minus,
  plus,
  comma,
  period,
  question,
  space,
  tab,
  escape,
  left,
  right,
  up,
  down,
  home,
  end,
  shift,
  control,
};
inline constexpr std::size_t kKeyCount = 42;

/// A key by its name in a script: "a", "1", "space", "?", …
[[nodiscard]] std::optional<Key> key_from_name(std::string_view name);

enum class Button : std::uint8_t { left, right, middle };
enum class Change : std::uint8_t { down, up };

/// Something that a person did. Positions in pixels from the window's top left.
struct Event {
  enum class Kind : std::uint8_t { move, leave, button, wheel, key, drop };
  Kind kind = Kind::move;
  double x = 0.0;
  double y = 0.0;
  double wheel = 0.0;  ///< notches, above 0 away from the person
  Button button = Button::left;
  Key key = Key::space;
  Change change = Change::down;
  std::string path;  ///< of a file that was dropped
};

/// Everything that is done in one frame, from a window or from a script.
struct Input {
  int width = 1280;
  int height = 720;
  double step_s = 1.0 / 60.0;     ///< since the last frame, as far as things move
  double elapsed_s = 1.0 / 60.0;  ///< the same by the clock, however long it took
  double x = 0.0;
  double y = 0.0;
  bool inside = false;  ///< the pointer is over the window
  double moved_x = 0.0;
  double moved_y = 0.0;
  double wheel = 0.0;
  std::array<bool, 3> buttons{};  ///< by Button
  std::bitset<kKeyCount> held;
  std::vector<Key> pressed;  ///< in this frame
  std::vector<std::string> dropped;

  [[nodiscard]] bool down(Button button) const { return buttons[static_cast<std::size_t>(button)]; }
  [[nodiscard]] bool is_held(Key key) const { return held[static_cast<std::size_t>(key)]; }

  /// Forgets what belongs to the last frame only.
  void start_frame(double seconds);
  void take(const Event& event);
};

}  // namespace nade::viewer
