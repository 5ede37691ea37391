#include "panel_picture.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "nade/draw/scene.h"
#include "nade/draw/text.h"
#include "nade/study/line_break.h"

namespace nade::xr {
namespace {

using draw::Color;
using draw::Image;

constexpr int kMargin = 40;
constexpr int kGap = 16;
constexpr float kHeadingHeight = 52.0F;
constexpr float kLineHeight = 38.0F;
constexpr float kLeading = 1.25F;
constexpr int kButtonHeight = 92;
/// A little more is pressed than is drawn: fingers are not pens.
constexpr int kReach = kGap / 2 - 1;
constexpr double kPixel_m = kPanelWidth_m / kPanelWidth_px;

struct Rgb {
  std::uint8_t r;
  std::uint8_t g;
  std::uint8_t b;
};
constexpr Rgb kPaper{238, 238, 234};
constexpr Rgb kEdge{150, 152, 156};
constexpr Rgb kButton{206, 212, 220};
constexpr Rgb kDisabled{228, 228, 226};
constexpr Rgb kChosen{28, 84, 160};
const Color kInk(0.012F, 0.012F, 0.014F);
const Color kPale(0.35F, 0.35F, 0.35F);
const Color kOnChosen(1.0F, 1.0F, 1.0F);

/// A filled rectangle with round corners.
void fill(Image& image, const ButtonPlace& place, const Rgb& color, int corner) {
  const double r = corner;
  for (int y = std::max(0, place.y); y < std::min(image.height, place.y + place.height); ++y) {
    for (int x = std::max(0, place.x); x < std::min(image.width, place.x + place.width); ++x) {
      const double from_x =
          std::max({place.x + r - x - 0.5, x + 0.5 - (place.x + place.width - r), 0.0});
      const double from_y =
          std::max({place.y + r - y - 0.5, y + 0.5 - (place.y + place.height - r), 0.0});
      if (std::hypot(from_x, from_y) > r) continue;
      std::uint8_t* const pixel =
          image.rgba.data() +
          4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
               static_cast<std::size_t>(x));
      pixel[0] = color.r;
      pixel[1] = color.g;
      pixel[2] = color.b;
      pixel[3] = 255;
    }
  }
}

/// Puts a panel's parts below each other; nothing is drawn where `image` is null.
class Layout {
 public:
  Layout(Image* image, float scale) : image_(image), scale_(scale) {}

  void text(std::string_view text, float height_px) {
    const float height = scale_ * height_px;
    constexpr double kAcross = kPanelWidth_px - 2 * kMargin;
    const auto width = [&](std::string_view part) { return draw::text_width(part, height); };
    for (const std::string& line : study::broken_lines(text, kAcross, width)) {
      if (image_ != nullptr) {
        draw::draw_text(*image_, kMargin, static_cast<float>(y_), line, height, kInk);
      }
      y_ += static_cast<int>(std::lround(kLeading * height));
    }
  }

  void gap() { y_ += static_cast<int>(std::lround(kGap * scale_)); }

  void row(const std::vector<study::PanelButton>& buttons, std::vector<ButtonPlace>& places) {
    if (buttons.empty()) return;
    const auto count = static_cast<int>(buttons.size());
    const int height = static_cast<int>(std::lround(kButtonHeight * scale_));
    const int width = (kPanelWidth_px - 2 * kMargin - (count - 1) * kGap) / count;
    for (int i = 0; i < count; ++i) {
      const study::PanelButton& button = buttons[static_cast<std::size_t>(i)];
      const ButtonPlace place{button.id, button.enabled, kMargin + i * (width + kGap),
                              y_,        width,          height};
      if (image_ != nullptr) {
        draw_button(button, place);
        places.push_back(place);
      }
    }
    y_ += height + kGap;
  }

  [[nodiscard]] int bottom() const { return y_; }

 private:
  void draw_button(const study::PanelButton& button, const ButtonPlace& place) {
    fill(*image_, place, button.chosen ? kChosen : button.enabled ? kButton : kDisabled, 18);
    float height = scale_ * kLineHeight;
    const float room = static_cast<float>(place.width) - 14.0F;
    const float width = draw::text_width(button.label, height);
    if (width > room) height *= std::max(0.4F, room / width);
    const float x = static_cast<float>(place.x) + 0.5F * (static_cast<float>(place.width) -
                                                          draw::text_width(button.label, height));
    const float y =
        static_cast<float>(place.y) + 0.5F * (static_cast<float>(place.height) - height);
    const Color& ink = button.chosen ? kOnChosen : button.enabled ? kInk : kPale;
    draw::draw_text(*image_, x, y, button.label, height, ink);
  }

  Image* image_;
  float scale_;
  int y_ = kMargin;
};

int lay_out(const study::PanelView& view, Image* image, float scale,
            std::vector<ButtonPlace>& places) {
  Layout layout(image, scale);
  if (!view.heading.empty()) {
    layout.text(view.heading, kHeadingHeight);
    layout.gap();
  }
  for (const std::string& line : view.lines) layout.text(line, kLineHeight);
  layout.gap();
  for (const auto& row : view.rows) layout.row(row, places);
  return layout.bottom();
}

}  // namespace

PanelPicture paint(const study::PanelView& view) {
  PanelPicture picture;
  picture.image = Image::blank(kPanelWidth_px, kPanelHeight_px);
  fill(picture.image, {0, true, 0, 0, kPanelWidth_px, kPanelHeight_px}, kEdge, 0);
  fill(picture.image, {0, true, 4, 4, kPanelWidth_px - 8, kPanelHeight_px - 8}, kPaper, 24);
  float scale = 1.0F;
  while (scale > 0.5F &&
         lay_out(view, nullptr, scale, picture.buttons) > kPanelHeight_px - kMargin / 2) {
    scale -= 0.05F;
  }
  lay_out(view, &picture.image, scale, picture.buttons);
  return picture;
}

std::optional<int> PanelPicture::button_at(double right_m, double up_m) const {
  const double x = right_m / kPixel_m + 0.5 * kPanelWidth_px;
  const double y = 0.5 * kPanelHeight_px - up_m / kPixel_m;
  for (const ButtonPlace& button : buttons) {
    if (button.enabled && x >= button.x - kReach && x < button.x + button.width + kReach &&
        y >= button.y - kReach && y < button.y + button.height + kReach) {
      return button.id;
    }
  }
  return std::nullopt;
}

Vec3 middle_of(const ButtonPlace& button) {
  return {kPixel_m * (button.x + 0.5 * button.width - 0.5 * kPanelWidth_px),
          kPixel_m * (0.5 * kPanelHeight_px - button.y - 0.5 * button.height), 0.0};
}

}  // namespace nade::xr
