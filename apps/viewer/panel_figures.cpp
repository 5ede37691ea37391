#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>

#include "panels.h"

namespace nade::viewer {
namespace {

struct Plot {
  Figure figure;
  const char* name;
  const char* label;
  const char* unit;
  float least_top;  ///< the plot's scale reaches at least so far
  const char* tip;
};

constexpr std::array<Plot, kFigureCount> kPlots{{
    {Figure::penetration, "plot:penetration", "penetration", "mm", 5.0F,
     "How deep the deepest skin of the corrected hand lies in the object"},
    {Figure::gap, "plot:gap", "gap", "mm", 5.0F,
     "The widest distance from the surface of a part that the person presses into it"},
    {Figure::bend, "plot:bend", "bend added", "°", 10.0F,
     "How far the correction bends the finger joints: the median over them"},
    {Figure::pop, "plot:pop", "pop", "mm", 2.0F,
     "Sudden motion: how far a corrected joint went in one frame beyond three times the fastest "
     "tracked joint"},
    {Figure::solve, "plot:solve", "solve time", "µs", 50.0F,
     "What the correction of a hand took on this machine"},
}};

std::string as_text(const std::optional<double>& value, const char* unit) {
  if (!value) return "–";
  return fmt::format("{:.{}f}{}{}", *value, *value < 99.95 ? 1 : 0, *unit == '\0' ? "" : " ", unit);
}

void text_at_right(const std::string& text) {
  const float width = ImGui::CalcTextSize(text.c_str()).x;
  ImGui::SameLine();
  ImGui::SetCursorPosX(ImGui::GetWindowWidth() - ImGui::GetStyle().WindowPadding.x - width);
  ImGui::TextUnformatted(text.c_str());
}

void draw_plot(UiKit& ui, const Plot& plot, const History& history) {
  ImGui::BeginGroup();
  ImGui::TextUnformatted(plot.label);
  text_at_right(as_text(history.last(), plot.unit));
  const float top = std::max(plot.least_top, 1.15F * history.highest());
  // Always as many frames wide, so that the newest is at the right from the start.
  std::array<float, History::kLength> values{};
  const auto known = history.values();
  std::copy(known.begin(), known.end(), values.end() - static_cast<std::ptrdiff_t>(known.size()));
  ImGui::PushID(plot.name);
  ImGui::PlotLines("##plot", values.data(), static_cast<int>(values.size()), 0, nullptr, 0.0F, top,
                   {ImGui::GetContentRegionAvail().x, 38.0F});
  ImGui::PopID();
  ImGui::EndGroup();
  ui.explain(plot.name, plot.tip);
}

struct Row {
  const char* name;
  const char* label;
  std::optional<double> Metrics::*value;
  const char* unit;
  const char* tip;
  std::size_t frames_at_least = 0;  ///< that press, before it tells anything
};

constexpr std::array<Row, 7> kRows{{
    {"sum:penetration-max", "penetration max", &Metrics::penetration_max_mm, "mm",
     "The deepest penetration of all frames"},
    {"sum:penetration-mean", "penetration mean", &Metrics::penetration_mean_mm, "mm",
     "Of the deepest skin, over the frames that press"},
    {"sum:gap", "gap p95", &Metrics::part_gap_p95_mm, "mm",
     "95 of 100 pressed parts are nearer to the surface than this"},
    {"sum:bend", "bend median", &Metrics::bend_added_median_deg, "°",
     "Bend that the correction added to the finger joints"},
    {"sum:pop", "pop max", &Metrics::pop_max_mm, "mm", "The largest sudden motion of all frames"},
    {"sum:amplification", "amplification max", &Metrics::amplification_max, "×",
     "The fastest corrected joint against the fastest tracked one"},
    {"sum:lag", "lag", &Metrics::linkage_lag_ms, "ms",
     "How much later the corrected palm moves than the tracked one, once it has pressed for a "
     "while",
     200},
}};

void draw_row(UiKit& ui, const char* name, const char* label, const std::string& value,
              const char* tip) {
  ImGui::BeginGroup();
  ImGui::TextUnformatted(label);
  text_at_right(value);
  ImGui::EndGroup();
  ui.explain(name, tip);
}

}  // namespace

void draw_figures(UiKit& ui, Desk& desk, const Layout& layout) {
  const auto left = static_cast<float>(layout.width - layout.figures_width);
  ImGui::SetNextWindowPos({left, 0.0F});
  ImGui::SetNextWindowSize(
      {static_cast<float>(layout.figures_width), static_cast<float>(layout.height)});
  ImGui::Begin("figures", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav);
  Figures& figures = desk.session.figures();
  ui.heading("This frame");
  for (const Plot& plot : kPlots) draw_plot(ui, plot, figures.of(plot.figure));
  ui.heading("Since the start");
  const Metrics& running = figures.running();
  for (const Row& row : kRows) {
    const bool early = running.pressing_frames < row.frames_at_least;
    draw_row(ui, row.name, row.label, as_text(early ? std::nullopt : running.*row.value, row.unit),
             row.tip);
  }
  std::optional<double> contact_percent;
  if (running.contact_ratio) contact_percent = 100.0 * *running.contact_ratio;
  draw_row(ui, "sum:contact", "in contact", as_text(contact_percent, "%"),
           "The share of pressing frames in which some corrected skin is within 2 mm of the "
           "surface");
  draw_row(ui, "sum:solve", "solve median", as_text(figures.solve_us_median(), "µs"),
           "What the correction of a hand takes on this machine");
  draw_row(ui, "sum:frames", "frames, pressing",
           fmt::format("{}, {}", running.frames, running.pressing_frames),
           "Frames that were measured, and those in which the person presses");
  if (ui.button("figures:restart", "measure anew", UiKit::Lit::no, -1.0F,
                "Forgets the figures so far  (Z)")) {
    figures.restart();
  }
  ImGui::End();
}

}  // namespace nade::viewer
