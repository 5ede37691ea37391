#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "panels.h"

namespace nade::viewer {
namespace {

using Lit = UiKit::Lit;

constexpr float kButton = 34.0F;
constexpr float kPadding = 12.0F;
constexpr int kControlsWidth = 292;
constexpr int kFiguresWidth = 236;
constexpr int kFootHeight = 46;
constexpr std::array<double, 6> kSpeeds{0.1, 0.25, 0.5, 1.0, 2.0, 4.0};

std::string as_time(double seconds) {
  const int minutes = static_cast<int>(seconds / 60.0);
  return fmt::format("{}:{:05.2f}", minutes, seconds - 60.0 * minutes);
}

void speed_button(UiKit& ui, Playback& playback) {
  if (ui.button("speed", fmt::format("{}×", playback.speed).c_str(), Lit::no, 52.0F,
                "How fast it plays: the next speed  (, and . for slower and faster)")) {
    const auto next = std::upper_bound(kSpeeds.begin(), kSpeeds.end(), playback.speed);
    playback.speed = next == kSpeeds.end() ? kSpeeds.front() : *next;
  }
}

void scrub_bar(UiKit& ui, Session& session, float width) {
  const Clip& clip = *session.clip();
  const auto last = static_cast<int>(clip.size()) - 1;
  int index = static_cast<int>(session.playback().index);
  ImGui::SetNextItemWidth(width);
  const std::string format =
      fmt::format("{} of {}   frame %d", as_time(session.playback().time_s),
                  as_time(1e-9 * static_cast<double>(clip.time_ns(clip.size() - 1))));
  if (ImGui::SliderInt("##scrub", &index, 0, std::max(last, 1), format.c_str(),
                       ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput)) {
    session.seek(static_cast<std::size_t>(std::clamp(index, 0, last)));
  }
  ui.explain("scrub", "Where in the recording; drag to go elsewhere  (Home, End)");
}

void timeline(UiKit& ui, Session& session) {
  Playback& playback = session.playback();
  if (session.loading()) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("reading the recording…");
    return;
  }
  if (ui.button("play", playback.playing ? "||" : "▶", Lit::no, kButton,
                "Plays or pauses  (space)")) {
    session.play_or_pause();
  }
  ImGui::SameLine();
  if (ui.button("step:back", "◀|", Lit::no, kButton, "One frame back  (left)")) session.step(-1);
  ImGui::SameLine();
  if (ui.button("step:ahead", "|▶", Lit::no, kButton, "One frame on  (right)")) session.step(1);
  ImGui::SameLine();
  scrub_bar(ui, session, ImGui::GetContentRegionAvail().x - 170.0F);
  ImGui::SameLine();
  speed_button(ui, playback);
  ImGui::SameLine();
  if (ui.button("loop", "loop", playback.loop ? Lit::yes : Lit::no, 56.0F,
                "From the end again to the start, or stop there  (L)")) {
    playback.loop = !playback.loop;
  }
}

}  // namespace

Layout layout_of(int width, int height, bool panels) {
  Layout layout;
  layout.width = width;
  layout.height = height;
  if (panels) {
    layout.controls_width = kControlsWidth;
    layout.figures_width = kFiguresWidth;
    layout.foot_height = kFootHeight;
  }
  layout.scene = {layout.controls_width, 0,
                  std::max(1, width - layout.controls_width - layout.figures_width),
                  std::max(1, height - layout.foot_height)};
  return layout;
}

void draw_foot(UiKit& ui, Desk& desk, const Layout& layout) {
  ImGui::SetNextWindowPos({static_cast<float>(layout.scene.x),
                           static_cast<float>(layout.scene.y + layout.scene.height)});
  ImGui::SetNextWindowSize(
      {static_cast<float>(layout.scene.width), static_cast<float>(layout.foot_height)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {kPadding, 10.0F});
  ImGui::Begin("foot", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav);
  if (desk.session.clip() != nullptr) {
    timeline(ui, desk.session);
  } else {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Move the mouse over the object; the wheel presses. Right drag turns.");
  }
  ImGui::SameLine(ImGui::GetWindowWidth() - kPadding - kButton);
  if (ui.button("help", "?", Lit::no, kButton, "All keys  (?)")) desk.help = !desk.help;
  ImGui::End();
  ImGui::PopStyleVar();
}

}  // namespace nade::viewer
