#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <cmath>
#include <filesystem>

#include "panels.h"

namespace nade::viewer {
namespace {

using Lit = UiKit::Lit;

constexpr float kGap = 6.0F;
constexpr const char* kAlive = ":alive";

Lit lit(bool on) { return on ? Lit::yes : Lit::no; }

/// The width of each of `count` buttons in a row.
float in_row(int count) {
  const float whole = ImGui::GetContentRegionAvail().x;
  return std::floor((whole - kGap * static_cast<float>(count - 1)) / static_cast<float>(count));
}

/// What it is, where that is a file; whether it moves by itself; and how soft it is.
void nature_controls(UiKit& ui, Desk& desk, const std::string& still) {
  constexpr std::size_t kLongest = 18;
  const bool file = still.find('.') != std::string::npos || still.find('/') != std::string::npos;
  std::string name = std::filesystem::path(still).filename().string();
  if (name.size() > kLongest) name = name.substr(0, kLongest - 1) + "…";
  const float second = 0.5F * ImGui::GetContentRegionAvail().x + ImGui::GetStyle().WindowPadding.x;
  ImGui::PushFont(ui.small_font());
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", file ? name.c_str() : "or drop a mesh file");
  ImGui::PopFont();
  if (still == "dog" || still.ends_with(".glb") || still.ends_with(".gltf")) {
    bool alive = desk.session.loaded().animation.has_value();
    ImGui::SameLine(second);
    if (ui.check("object:alive", "alive", alive, "It moves as its file's animation says")) {
      desk.show_object(alive ? still + kAlive : still);
    }
  }
  const CorrectorOptions& corrector = desk.session.corrector();
  if (corrector.method != Method::nade) return;
  SettleOptions settle = corrector.settle;
  float softness_mm = static_cast<float>(1e3 * settle.softness_m);
  if (ui.slider("object:soft", "soft", softness_mm, 0.0F, 20.0F, "%.0f mm",
                "How far the skin sinks into the object, which gives way")) {
    settle.softness_m = 1e-3 * static_cast<double>(softness_mm);
    desk.session.set_settle(settle);
  }
}

void object_section(UiKit& ui, Desk& desk) {
  ui.heading("Object");
  struct Choice {
    const char* spec;
    const char* tip;
  };
  static constexpr std::array<Choice, 3> kChoices{{
      {"plane", "A table top"},
      {"sphere", "A ball of 30 cm"},
      {"dog", "A dog"},
  }};
  const std::string& spec = desk.session.loaded().spec;
  const std::string still = spec.substr(0, spec.find(kAlive));
  const float width = in_row(3);
  for (const Choice& choice : kChoices) {
    if (&choice != kChoices.data()) ImGui::SameLine(0.0F, kGap);
    const std::string name = std::string("object:") + choice.spec;
    if (ui.button(name, choice.spec, lit(still == choice.spec), width,
                  fmt::format("{}  (O: the next object)", choice.tip))) {
      desk.show_object(choice.spec);
    }
  }
  nature_controls(ui, desk, still);
}

void method_section(UiKit& ui, Desk& desk) {
  ui.heading("Method");
  const auto choices = method_choices();
  const float width = in_row(static_cast<int>(choices.size()));
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const MethodChoice& choice = choices[i];
    if (i > 0) ImGui::SameLine(0.0F, kGap);
    const bool chosen = desk.session.corrector().method == choice.method;
    if (ui.button(fmt::format("method:{}", choice.name), choice.name, lit(chosen), width,
                  fmt::format("{}  (M: the next method)", choice.tip))) {
      desk.choose_method(choice.method);
    }
  }
}

/// The colour of what the check box before it shows.
void swatch(const draw::Color& linear) {
  const draw::Color shown = linear.array().max(0.0F).pow(1.0F / 2.2F);
  const ImVec2 high = ImGui::GetItemRectMax();
  const ImVec2 low = ImGui::GetItemRectMin();
  ImGui::GetWindowDrawList()->AddCircleFilled(
      {high.x + 9.0F, 0.5F * (low.y + high.y)}, 4.0F,
      ImGui::ColorConvertFloat4ToU32({shown.x(), shown.y(), shown.z(), 1.0F}));
}

void overlay_checks(UiKit& ui, draw::Overlays& overlays) {
  const draw::DiagramColors colors = draw::diagram_colors();
  const float second = 0.5F * ImGui::GetContentRegionAvail().x + ImGui::GetStyle().WindowPadding.x;
  ui.check("overlay:rays", "rays", overlays.rays, "From each sunken part out to the surface");
  swatch(colors.ray);
  ImGui::SameLine(second);
  ui.check("overlay:held-ray", "held ray", overlays.held_ray,
           "The palm's ray, which keeps the direction it had when the palm went in");
  swatch(colors.held_ray);
  ui.check("overlay:contacts", "contacts", overlays.contacts,
           "Points of the surface that are touched, and where the parts go");
  swatch(colors.target);
  ImGui::SameLine(second);
  ui.check("overlay:normals", "normals", overlays.normals,
           "Of the surface where it is touched, and of the back of the hand");
  swatch(colors.normal);
  ui.check("overlay:penetration", "depth on skin", overlays.penetration,
           "Colours the skin where it lies in the object");
  ImGui::SameLine(second);
  ui.check("overlay:see-through", "see-through", overlays.see_through,
           "The object like glass, to see what is in it");
  ui.check("overlay:labels", "labels", overlays.labels, "Names what the other marks are");
}

void shown_section(UiKit& ui, Desk& desk) {
  ui.heading("Show");
  struct Choice {
    draw::Shown shown;
    const char* label;
    const char* tip;
  };
  static constexpr std::array<Choice, 3> kChoices{{
      {draw::Shown::tracked, "tracked", "The hand as it was tracked"},
      {draw::Shown::corrected, "corrected", "The hand to be drawn"},
      {draw::Shown::both, "both", "The corrected hand, and the tracked one as a ghost"},
  }};
  const float width = in_row(3);
  for (const Choice& choice : kChoices) {
    if (&choice != kChoices.data()) ImGui::SameLine(0.0F, kGap);
    if (ui.button(fmt::format("show:{}", choice.label), choice.label,
                  lit(desk.shown == choice.shown), width,
                  fmt::format("{}  (B: the next of these)", choice.tip))) {
      desk.shown = choice.shown;
    }
  }
  overlay_checks(ui, desk.overlays);
}

void view_section(UiKit& ui, Desk& desk) {
  ui.heading("View");
  struct Choice {
    draw::View view;
    const char* label;
    const char* tip;
  };
  static constexpr std::array<Choice, 5> kChoices{{
      {draw::View::front, "front", "From the front  (1)"},
      {draw::View::side, "side", "From the side  (2)"},
      {draw::View::top, "top", "From above  (3)"},
      {draw::View::three_quarter, "three-quarter", "From aside and above  (4)"},
      {draw::View::first_person, "first-person", "As the hand's owner sees it  (5)"},
  }};
  const float narrow = in_row(3);
  const float wide = in_row(2);
  for (std::size_t i = 0; i < kChoices.size(); ++i) {
    const Choice& choice = kChoices[i];
    if (i != 0 && i != 3) ImGui::SameLine(0.0F, kGap);
    if (ui.button(fmt::format("view:{}", choice.label), choice.label,
                  lit(desk.camera.view() == choice.view), i < 3 ? narrow : wide, choice.tip)) {
      desk.look(choice.view);
    }
  }
  ui.check("view:coarse", "coarse but quick", desk.coarse,
           "Draws the scene at half the size; set by itself where drawing is slow");
}

void degrees_slider(UiKit& ui, const char* label, double& value_rad, float most, const char* tip) {
  float degrees = static_cast<float>(value_rad / kDegree);
  if (ui.slider(std::string("hand:") + label, label, degrees, -most, most, "%.0f°", tip)) {
    value_rad = degrees * kDegree;
  }
}

void share_slider(UiKit& ui, const char* label, double& value, float low, float high,
                  const char* tip) {
  float percent = static_cast<float>(100.0 * value);
  if (ui.slider(std::string("hand:") + label, label, percent, 100.0F * low, 100.0F * high,
                "%.0f %%", tip)) {
    value = 0.01 * percent;
  }
}

void mouse_hand_section(UiKit& ui, Desk& desk) {
  ui.heading("Mouse hand");
  MouseHandSettings& hand = desk.session.mouse_hand().settings();
  const float width = in_row(2);
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    if (side == Handedness::right) ImGui::SameLine(0.0F, kGap);
    const std::string name(name_of(side));
    if (ui.button("hand:" + name, name.c_str(), lit(hand.side == side), width,
                  "Which hand  (X: the other)")) {
      hand.side = side;
    }
  }
  float depth_mm = static_cast<float>(1e3 * hand.depth_m);
  if (ui.slider("hand:press", "press", depth_mm, -60.0F, 40.0F, "%.0f mm",
                "How deep the palm's skin lies under the surface; below 0 it hovers  (wheel)")) {
    hand.depth_m = 1e-3 * depth_mm;
  }
  degrees_slider(ui, "turn", hand.turn_rad, 180.0F, "Where the fingers point  (Q, E)");
  degrees_slider(ui, "tilt", hand.tilt_rad, 60.0F, "Fingertips up or down  (W, S)");
  degrees_slider(ui, "roll", hand.roll_rad, 60.0F, "One edge of the hand up  (A, D)");
  share_slider(ui, "curl", hand.shape.curl, -0.5F, 1.5F, "Bends the fingers  (F, R)");
  share_slider(ui, "spread", hand.shape.spread, -1.0F, 1.5F, "Fingers apart or together  (G, T)");
  bool follows = hand.heading == Heading::with_motion;
  if (ui.check("hand:follows", "fingers follow the motion", follows,
               "The hand turns to where it goes, or always points away from you")) {
    hand.heading = follows ? Heading::with_motion : Heading::away;
  }
}

void recording_section(UiKit& ui, Desk& desk) {
  ui.heading("Recording");
  Session& session = desk.session;
  ImGui::TextUnformatted(std::filesystem::path(session.clip()->path()).filename().c_str());
  if (session.loading()) {
    ImGui::TextDisabled("reading: %zu frames so far", session.clip()->size());
  } else {
    float depth_mm = static_cast<float>(1e3 * session.press_m().value_or(0.0));
    if (ui.slider("press", "press", depth_mm, 1.0F, 60.0F,
                  session.press_m() ? "%.0f mm" : "as recorded",
                  "Moves the object so that the palms' skin lies so deep in the middle of the "
                  "recording")) {
      desk.tell(session.press(1e-3 * depth_mm));
    }
  }
  if (ui.button("close", "back to the mouse", Lit::no, -1.0F,
                "Puts the recording away; the mouse moves the hand again")) {
    session.close_clip();
    desk.look(desk.camera.view());
  }
}

}  // namespace

void draw_controls(UiKit& ui, Desk& desk, const Layout& layout) {
  ImGui::SetNextWindowPos({0.0F, 0.0F});
  ImGui::SetNextWindowSize(
      {static_cast<float>(layout.controls_width), static_cast<float>(layout.height)});
  ImGui::Begin("controls", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav);
  // All of it fits into a window of 720 points; a lower one scrolls.
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {kGap, 5.0F});
  object_section(ui, desk);
  method_section(ui, desk);
  shown_section(ui, desk);
  view_section(ui, desk);
  if (desk.session.clip() != nullptr) {
    recording_section(ui, desk);
  } else {
    mouse_hand_section(ui, desk);
  }
  ImGui::PopStyleVar();
  ImGui::End();
}

}  // namespace nade::viewer
