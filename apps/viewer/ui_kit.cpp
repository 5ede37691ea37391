#include "ui_kit.h"

#include <epoxy/gl.h>
#include <imgui.h>
#include <imgui_impl_opengl3.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "nade/draw/text.h"

namespace nade::viewer {
namespace {

constexpr double kTipAfter_s = 0.45;
constexpr float kTipWidth = 300.0F;
constexpr float kTextSize = 15.0F;
constexpr float kSmallSize = 12.5F;
constexpr float kLargeSize = 21.0F;
constexpr const char* kBoldFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf";

ImVec4 grey(float value) { return {value, value, value * 1.04F, 1.0F}; }

const ImVec4 kAccent{0.23F, 0.51F, 0.62F, 1.0F};
const ImVec4 kAccentBright{0.29F, 0.60F, 0.72F, 1.0F};

void set_style() {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 0.0F;
  style.WindowBorderSize = 0.0F;
  style.WindowPadding = {14.0F, 12.0F};
  style.FrameRounding = 4.0F;
  style.FramePadding = {7.0F, 4.0F};
  style.ItemSpacing = {6.0F, 6.0F};
  style.GrabRounding = 4.0F;
  style.GrabMinSize = 9.0F;
  style.PopupRounding = 5.0F;
  style.ScrollbarSize = 10.0F;
  ImVec4* const colors = style.Colors;
  colors[ImGuiCol_WindowBg] = grey(0.13F);
  colors[ImGuiCol_PopupBg] = grey(0.08F);
  colors[ImGuiCol_Text] = grey(0.90F);
  colors[ImGuiCol_TextDisabled] = grey(0.60F);
  colors[ImGuiCol_FrameBg] = grey(0.21F);
  colors[ImGuiCol_FrameBgHovered] = grey(0.26F);
  colors[ImGuiCol_FrameBgActive] = grey(0.30F);
  colors[ImGuiCol_Button] = grey(0.22F);
  colors[ImGuiCol_ButtonHovered] = grey(0.30F);
  colors[ImGuiCol_ButtonActive] = kAccent;
  colors[ImGuiCol_SliderGrab] = kAccent;
  colors[ImGuiCol_SliderGrabActive] = kAccentBright;
  colors[ImGuiCol_CheckMark] = kAccentBright;
  colors[ImGuiCol_Separator] = grey(0.24F);
  colors[ImGuiCol_PlotLines] = kAccentBright;
  colors[ImGuiCol_PlotHistogram] = kAccentBright;
}

constexpr std::array<ImWchar, 7> kLetters{0x20, 0x17f, 0x370, 0x3ff, 0x2010, 0x25ff, 0};

ImFont* add_font(float size) {
  const std::string_view bytes = draw::font_bytes();
  ImFontConfig config;
  config.FontDataOwnedByAtlas = false;
  // Dear ImGui asks for bytes that it may write, and leaves those that it does not own alone.
  return ImGui::GetIO().Fonts->AddFontFromMemoryTTF(const_cast<char*>(bytes.data()),
                                                    static_cast<int>(bytes.size()), size, &config,
                                                    kLetters.data());
}

/// The same in bold where the system has it.
ImFont* add_bold_font(float size) {
  if (!std::filesystem::exists(kBoldFont)) return add_font(size);
  return ImGui::GetIO().Fonts->AddFontFromFileTTF(kBoldFont, size, nullptr, kLetters.data());
}

/// Adds Japanese letters to the font that was added last; false where the system has none.
bool add_japanese(float size) {
  const std::optional<std::string> file = draw::japanese_font();
  if (!file) return false;
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  ImFontConfig config;
  config.MergeMode = true;
  return fonts.AddFontFromFileTTF(file->c_str(), size, &config, fonts.GetGlyphRangesJapanese()) !=
         nullptr;
}

}  // namespace

Result<std::unique_ptr<UiKit>> UiKit::create(float scale, Letters letters) {
  std::unique_ptr<UiKit> kit(new UiKit);
  kit->scale_ = scale;
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  kit->normal_ = add_font(scale * kTextSize);
  kit->small_ = add_font(scale * kSmallSize);
  kit->bold_ = add_bold_font(scale * kTextSize);
  kit->large_ = add_font(scale * kLargeSize);
  if (letters == Letters::japanese && !add_japanese(scale * kLargeSize)) {
    return Error{ErrorCode::not_found, std::string(draw::kNoJapaneseFont)};
  }
  io.FontGlobalScale = 1.0F / scale;  // sharp letters in a coordinate system of points
  set_style();
  if (!ImGui_ImplOpenGL3_Init("#version 450 core")) {
    return Error{ErrorCode::not_found, "the window's controls need the library libGL.so.1"};
  }
  kit->ready_ = true;
  return kit;
}

UiKit::~UiKit() {
  if (ready_) ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
}

void UiKit::begin(const Input& input) {
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(input.width) / scale_,
                    static_cast<float>(input.height) / scale_};
  io.DisplayFramebufferScale = {scale_, scale_};
  io.DeltaTime = static_cast<float>(std::max(input.step_s, 1e-4));
  const bool inside = input.inside;
  const ImVec2 pointer{inside ? static_cast<float>(input.x) / scale_ : -FLT_MAX,
                       inside ? static_cast<float>(input.y) / scale_ : -FLT_MAX};
#if IMGUI_VERSION_NUM >= 18700
  io.AddMousePosEvent(pointer.x, pointer.y);
  for (int i = 0; i < 3; ++i) io.AddMouseButtonEvent(i, input.buttons[static_cast<std::size_t>(i)]);
  io.AddMouseWheelEvent(0.0F, static_cast<float>(input.wheel));
#else
  io.MousePos = pointer;
  for (std::size_t i = 0; i < 3; ++i) io.MouseDown[i] = input.buttons[i];
  io.MouseWheel = static_cast<float>(input.wheel);
#endif
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  widgets_.clear();
  hovered_now_ = false;
}

void UiKit::end(unsigned framebuffer) {
  if (!hovered_now_) hovered_.clear();
  ImGui::Render();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glDisable(GL_FRAMEBUFFER_SRGB);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  last_widgets_ = widgets_;
}

bool UiKit::takes_pointer() const { return ImGui::GetIO().WantCaptureMouse; }

void UiKit::explain(std::string_view name, std::string_view tip) {
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high = ImGui::GetItemRectMax();
  widgets_.push_back(
      {std::string(name), scale_ * low.x, scale_ * low.y, scale_ * high.x, scale_ * high.y});
  if (tip.empty() || !ImGui::IsItemHovered()) return;
  hovered_now_ = true;
  if (hovered_ != name) {
    hovered_ = name;
    hovered_s_ = 0.0;
  }
  hovered_s_ += ImGui::GetIO().DeltaTime;
  if (hovered_s_ < kTipAfter_s || ImGui::IsItemActive()) return;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {10.0F, 8.0F});
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(kTipWidth);
  ImGui::TextUnformatted(tip.data(), tip.data() + tip.size());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
  ImGui::PopStyleVar();
}

bool UiKit::button(std::string_view name, const char* label, Lit lit, float width,
                   std::string_view tip) {
  if (lit == Lit::yes) {
    ImGui::PushStyleColor(ImGuiCol_Button, kAccent);
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, kAccentBright);
  }
  ImGui::PushID(name.data(), name.data() + name.size());
  const bool pressed = ImGui::Button(label, {width, 0.0F});
  ImGui::PopID();
  if (lit == Lit::yes) ImGui::PopStyleColor(2);
  explain(name, tip);
  return pressed;
}

bool UiKit::check(std::string_view name, const char* label, bool& value, std::string_view tip) {
  const bool changed = ImGui::Checkbox(label, &value);
  explain(name, tip);
  return changed;
}

bool UiKit::slider(std::string_view name, const char* label, float& value, float low, float high,
                   const char* format, std::string_view tip) {
  constexpr float kLabelWidth = 62.0F;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label);
  ImGui::SameLine(kLabelWidth);
  ImGui::SetNextItemWidth(-1.0F);
  ImGui::PushID(name.data(), name.data() + name.size());
  const bool changed = ImGui::SliderFloat("##value", &value, low, high, format,
                                          ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput);
  ImGui::PopID();
  explain(name, tip);
  return changed;
}

void UiKit::heading(const char* text) {
  ImGui::Spacing();
  ImGui::PushFont(bold_);
  ImGui::TextUnformatted(text);
  ImGui::PopFont();
}

const Widget* UiKit::find(std::string_view name) const {
  const auto found = std::find_if(last_widgets_.begin(), last_widgets_.end(),
                                  [&](const Widget& widget) { return widget.name == name; });
  return found == last_widgets_.end() ? nullptr : &*found;
}

}  // namespace nade::viewer
