#include <imgui.h>

#include <algorithm>
#include <array>

#include "panels.h"

namespace nade::viewer {
namespace {

constexpr ImGuiWindowFlags kOverFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                        ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoNav |
                                        ImGuiWindowFlags_NoSavedSettings;

constexpr float kKeysWidth = 96.0F;

struct KeyLine {
  const char* keys;
  const char* what;
};

constexpr std::array<KeyLine, 10> kHandKeys{{
    {"mouse", "moves the hand"},
    {"wheel", "presses deeper, or lifts"},
    {"Q  E", "turn"},
    {"W  S", "fingertips up, down"},
    {"A  D", "roll"},
    {"F  R", "curl, stretch"},
    {"G  T", "spread, close"},
    {"X", "the other hand"},
    {"C", "held as at first"},
    {"Z", "figures anew"},
}};
constexpr std::array<KeyLine, 8> kSceneKeys{{
    {"O", "next object"},
    {"M", "next method"},
    {"B", "tracked, corrected, both"},
    {"1 … 5", "views; 5: first person"},
    {"right drag", "turns the view"},
    {"middle drag", "moves it (or Shift and right)"},
    {"+  -", "nearer, farther (Ctrl, wheel)"},
    {"Tab", "hides the panels"},
}};
constexpr std::array<KeyLine, 5> kClipKeys{{
    {"space", "plays, pauses"},
    {"left  right", "a frame back, on"},
    {"Home  End", "to the start, the end"},
    {",  .", "slower, faster"},
    {"L", "loop or not"},
}};

template <std::size_t count>
void key_lines(UiKit& ui, const char* title, const std::array<KeyLine, count>& lines) {
  ui.heading(title);
  const float left = ImGui::GetCursorPosX();
  for (const KeyLine& line : lines) {
    ImGui::TextColored({0.45F, 0.78F, 0.90F, 1.0F}, "%s", line.keys);
    ImGui::SameLine();
    ImGui::SetCursorPosX(left + kKeysWidth);
    ImGui::TextUnformatted(line.what);
  }
}

}  // namespace

void draw_notices(UiKit& ui, Desk& desk, const Layout& layout) {
  const double step_s = ImGui::GetIO().DeltaTime;
  for (Notice& notice : desk.notices) notice.left_s -= step_s;
  std::erase_if(desk.notices, [](const Notice& notice) { return notice.left_s <= 0.0; });
  if (desk.notices.empty()) return;
  const Viewport& scene = layout.scene;
  const float width = std::min(560.0F, static_cast<float>(scene.width) - 40.0F);
  ImGui::SetNextWindowPos({static_cast<float>(scene.x) + 0.5F * static_cast<float>(scene.width),
                           static_cast<float>(scene.y + scene.height) - 16.0F},
                          ImGuiCond_Always, {0.5F, 1.0F});
  ImGui::SetNextWindowSize({width, 0.0F});
  ImGui::SetNextWindowBgAlpha(0.92F);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6.0F);
  ImGui::Begin("notices", nullptr, kOverFlags);
  for (const Notice& notice : desk.notices) {
    ImGui::PushTextWrapPos(width - 90.0F);
    ImGui::TextUnformatted(notice.text.c_str());
    ImGui::PopTextWrapPos();
  }
  ImGui::SetCursorPos({width - 76.0F, 10.0F});
  if (ui.button("notices:close", "close", UiKit::Lit::no, 64.0F, "Puts these sentences away")) {
    desk.notices.clear();
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

void draw_help(UiKit& ui, Desk& desk, const Layout& layout) {
  if (!desk.help) return;
  const Viewport& scene = layout.scene;
  ImGui::SetNextWindowPos({static_cast<float>(scene.x) + 0.5F * static_cast<float>(scene.width),
                           static_cast<float>(scene.y) + 0.5F * static_cast<float>(scene.height)},
                          ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowBgAlpha(0.96F);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6.0F);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {18.0F, 14.0F});
  ImGui::Begin("keys", nullptr, kOverFlags);
  ImGui::BeginGroup();
  key_lines(ui, "Mouse hand", kHandKeys);
  ImGui::EndGroup();
  ImGui::SameLine(0.0F, 28.0F);
  ImGui::BeginGroup();
  key_lines(ui, "Scene", kSceneKeys);
  key_lines(ui, "Recording", kClipKeys);
  ImGui::EndGroup();
  ImGui::Spacing();
  ImGui::TextDisabled("Drop a recording or a mesh onto the window to open it.");
  if (ui.button("help:close", "close", UiKit::Lit::no, -1.0F, "Back to the scene  (? or Esc)")) {
    desk.help = false;
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace nade::viewer
