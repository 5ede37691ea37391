#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input.h"
#include "nade/status.h"

struct ImFont;

namespace nade::viewer {

/// A widget that was drawn: its name for scripts and tests, and where it is, pixels.
struct Widget {
  std::string name;
  float left = 0.0F;
  float top = 0.0F;
  float right = 0.0F;
  float bottom = 0.0F;
};

/// The window's controls (Dear ImGui) in the OpenGL context that is current, fed by our own
/// events so that a script does exactly what a person does.
class UiKit {
 public:
  enum class Letters { latin, japanese };
  /// `scale`: pixels of ours for each of the size that controls are laid out in, > 0. The error
  /// says what the context, or the system's fonts, lack.
  [[nodiscard]] static Result<std::unique_ptr<UiKit>> create(float scale,
                                                             Letters letters = Letters::latin);
  UiKit(const UiKit&) = delete;
  UiKit& operator=(const UiKit&) = delete;
  ~UiKit();

  void begin(const Input& input);
  /// Draws the controls into a framebuffer of the window's size.
  void end(unsigned framebuffer);
  /// Whether the pointer is the controls' business, as of `begin`.
  [[nodiscard]] bool takes_pointer() const;

  /// Names the widget that was just made, for scripts, and gives it a tooltip, where there is one.
  void explain(std::string_view name, std::string_view tip);
  /// A push button, lit while it is the one chosen.
  enum class Lit { no, yes };
  [[nodiscard]] bool button(std::string_view name, const char* label, Lit lit, float width,
                            std::string_view tip);
  bool check(std::string_view name, const char* label, bool& value, std::string_view tip);
  [[nodiscard]] bool slider(std::string_view name, const char* label, float& value, float low,
                            float high, const char* format, std::string_view tip);
  void heading(const char* text);

  /// All widgets of the last frame.
  [[nodiscard]] const std::vector<Widget>& widgets() const { return last_widgets_; }
  [[nodiscard]] const Widget* find(std::string_view name) const;
  [[nodiscard]] float scale() const { return scale_; }
  [[nodiscard]] ImFont* small_font() const { return small_; }
  [[nodiscard]] ImFont* bold_font() const { return bold_; }
  /// Larger letters, the only ones that may be Japanese.
  [[nodiscard]] ImFont* large_font() const { return large_; }

 private:
  UiKit() = default;

  bool ready_ = false;  ///< has what it draws with
  float scale_ = 1.0F;
  ImFont* normal_ = nullptr;
  ImFont* small_ = nullptr;
  ImFont* bold_ = nullptr;
  ImFont* large_ = nullptr;
  std::vector<Widget> widgets_;
  std::vector<Widget> last_widgets_;
  std::string hovered_;
  double hovered_s_ = 0.0;
  bool hovered_now_ = false;
};

}  // namespace nade::viewer
