#include "study_desk.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "nade/study/line_break.h"

namespace nade::viewer {
namespace {

using Lit = UiKit::Lit;
using study::StudyState;

constexpr ImGuiWindowFlags kPanelFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                         ImGuiWindowFlags_AlwaysAutoResize |
                                         ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoSavedSettings;
constexpr float kPanelWidth = 640.0F;
constexpr float kButtonHeight = 44.0F;

/// Why a trial may be left out: what the log says, and what the operator presses.
struct Reason {
  const char* name;
  const char* label;
};
constexpr std::array<Reason, 4> kReasons{{
    {"tracking", "tracking failed"},
    {"participant", "the participant's wish"},
    {"interrupted", "interrupted from outside"},
    {"other", "another reason"},
}};

ImVec2 size_of(const Input& input, const UiKit& ui) {
  return {static_cast<float>(input.width) / ui.scale(),
          static_cast<float>(input.height) / ui.scale()};
}

/// Opens a window of the study's at a place of the screen, as shares of it.
void begin_window(const char* name, const ImVec2& screen, const ImVec2& share, float width) {
  ImGui::SetNextWindowPos({share.x * screen.x, share.y * screen.y}, ImGuiCond_Always, share);
  ImGui::SetNextWindowSize({width, 0.0F});
  ImGui::SetNextWindowBgAlpha(0.94F);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 8.0F);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {24.0F, 20.0F});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {8.0F, 14.0F});
  ImGui::Begin(name, nullptr, kPanelFlags);
}

/// Writes a text in as many lines as it takes.
void draw_text(const std::string& text) {
  const auto width = [](std::string_view part) -> double {
    return ImGui::CalcTextSize(part.data(), part.data() + part.size()).x;
  };
  const double room = ImGui::GetContentRegionAvail().x;
  std::string lines;
  for (const std::string& line : study::broken_lines(text, room, width)) {
    lines += (lines.empty() ? "" : "\n") + line;
  }
  ImGui::TextUnformatted(lines.c_str());
}

void end_window() {
  ImGui::End();
  ImGui::PopStyleVar(3);
}

}  // namespace

StudyDesk::StudyDesk(std::unique_ptr<study::StudyRun> run, double speed)
    : run_(std::move(run)), speed_(speed) {}

void StudyDesk::draw(UiKit& ui, const Input& input) {
  draw_panel(ui, input);
  draw_operator(ui, input);
  if (asks_reason_) draw_reasons(ui, input);
}

void StudyDesk::draw_panel(UiKit& ui, const Input& input) {
  const ImVec2 screen = size_of(input, ui);
  const study::PanelView& view = run_->view();
  const bool aside = shows_object();  // the object has the middle
  begin_window("panel", screen, aside ? ImVec2{0.5F, 0.0F} : ImVec2{0.5F, 0.5F},
               std::min(aside ? 0.5F * kPanelWidth : kPanelWidth, screen.x - 20.0F));
  ImGui::PushFont(ui.large_font());
  ImGui::PushStyleColor(ImGuiCol_Text, {0.55F, 0.82F, 0.92F, 1.0F});
  draw_text(view.heading);
  ImGui::PopStyleColor();
  for (const std::string& text : view.lines) draw_text(text);
  // A press changes the rows.
  const std::vector<std::vector<study::PanelButton>> rows = view.rows;
  for (const auto& row : rows) draw_row(ui, row);
  ImGui::PopFont();
  end_window();
}

void StudyDesk::draw_row(UiKit& ui, const std::vector<study::PanelButton>& row) {
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float width =
      (ImGui::GetContentRegionAvail().x - gap * static_cast<float>(row.size() - 1)) /
      static_cast<float>(row.size());
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                      {7.0F, 0.5F * std::max(0.0F, kButtonHeight - ImGui::GetFontSize())});
  for (std::size_t i = 0; i < row.size(); ++i) {
    const study::PanelButton& button = row[i];
    if (i > 0) ImGui::SameLine();
    ImGui::BeginDisabled(!button.enabled);
    const bool pressed = ui.button(fmt::format("study:{}", button.id), button.label.c_str(),
                                   button.chosen ? Lit::yes : Lit::no, width, {});
    ImGui::EndDisabled();
    if (pressed) run_->press(button.id, now_ns_);
  }
  ImGui::PopStyleVar();
}

void StudyDesk::draw_operator(UiKit& ui, const Input& input) {
  const ImVec2 screen = size_of(input, ui);
  ImGui::SetNextWindowPos({0.0F, screen.y}, ImGuiCond_Always, {0.0F, 1.0F});
  ImGui::SetNextWindowBgAlpha(0.8F);  // over a bright scene too
  ImGui::Begin("operator", nullptr, kPanelFlags | ImGuiWindowFlags_NoInputs);
  ImGui::PushFont(ui.small_font());
  const study::StudyScene& scene = run_->scene();
  ImGui::TextDisabled("%s   P %s   R repeat   S skip   Esc %s%s",
                      run_->store().options().participant.c_str(),
                      run_->state() == StudyState::paused ? "go on" : "pause",
                      run_->over() ? "close" : "stop", scene.recording ? "   recording" : "");
  ImGui::PopFont();
  ImGui::End();
}

void StudyDesk::draw_reasons(UiKit& ui, const Input& input) {
  begin_window("reasons", size_of(input, ui), {0.5F, 0.9F}, kPanelWidth);
  ImGui::TextUnformatted("Leave this out, because of");
  for (const Reason& reason : kReasons) {
    if (ui.button(fmt::format("skip:{}", reason.name), reason.label, Lit::no, -1.0F, {})) {
      run_->skip(reason.label, now_ns_);
      asks_reason_ = false;
    }
  }
  if (ui.button("skip:cancel", "go on with it", Lit::no, -1.0F, {})) asks_reason_ = false;
  end_window();
}

void StudyDesk::take_keys(const Input& input) {
  for (const Key key : input.pressed) {
    if (key == Key::escape && asks_reason_) {
      asks_reason_ = false;
    } else if (key == Key::escape && run_->over()) {
      closed_ = true;
    } else if (key == Key::escape) {
      run_->stop(now_ns_);
    } else if (key == Key::p && run_->state() == StudyState::paused) {
      run_->resume(now_ns_);
    } else if (key == Key::p) {
      run_->pause(now_ns_);
    } else if (key == Key::r) {
      run_->repeat(now_ns_);
    } else if (key == Key::s && !run_->over()) {
      asks_reason_ = true;
    }
  }
}

void StudyDesk::prepare(Desk& desk) {
  const study::StudyScene& scene = run_->scene();
  if (!scene.coming_spec.empty() && scene.coming_spec != prepared_) {
    prepared_ = scene.coming_spec;
    desk.show_object(prepared_);
    desk.look(draw::View::three_quarter);
  }
  if (shows_object() && !shown_) {
    desk.shown = draw::Shown::corrected;
    desk.choose_method(scene.method);
  }
  shown_ = shows_object();
}

void StudyDesk::go_on(const Session& session, const Pose& head, const Input& input) {
  now_ns_ += std::llround(1e9 * speed_ * input.elapsed_s);
  study::RunFrame frame;
  frame.now_ns = now_ns_;
  frame.head = head;
  frame.object = session.placement();
  if (session.has_object() && session.loaded().animation) {
    frame.animated_ns = session.mouse_time_ns();
  }
  for (std::size_t side = 0; side < 2 && shown_; ++side) {
    if (!session.hands()[side]) continue;
    frame.tracked[side] = &session.hands()[side]->tracked;
    frame.corrected[side] = session.corrected(side);
  }
  run_->frame(frame);
}

}  // namespace nade::viewer
