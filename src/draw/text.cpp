#include "nade/draw/text.h"

#include <algorithm>
#include <cmath>

#include "glyphs.h"
#include "nade/assert.h"

namespace nade::draw {
namespace {

/// Puts a colour over a pixel; both straight alpha.
void put_over(std::uint8_t* pixel, const std::array<float, 3>& color, float alpha) {
  const float below = static_cast<float>(pixel[3]) / 255.0F * (1.0F - alpha);
  const float whole = alpha + below;
  if (whole <= 0.0F) return;
  for (std::size_t k = 0; k < 3; ++k) {
    const float mixed = (alpha * 255.0F * color[k] + below * static_cast<float>(pixel[k])) / whole;
    pixel[k] = static_cast<std::uint8_t>(std::lround(std::clamp(mixed, 0.0F, 255.0F)));
  }
  pixel[3] = static_cast<std::uint8_t>(std::lround(255.0F * std::min(whole, 1.0F)));
}

void put_glyph(Image& image, const GlyphBitmap& glyph, int left, int top,
               const std::array<float, 3>& color) {
  for (int row = 0; row < glyph.height; ++row) {
    const int y = top + row;
    if (y < 0 || y >= image.height) continue;
    for (int column = 0; column < glyph.width; ++column) {
      const int x = left + column;
      if (x < 0 || x >= image.width) continue;
      const auto place = static_cast<std::size_t>(row * glyph.width + column);
      const float alpha = static_cast<float>(glyph.cover[place]) / 255.0F;
      const std::size_t pixel =
          4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
               static_cast<std::size_t>(x));
      if (alpha > 0.0F) put_over(image.rgba.data() + pixel, color, alpha);
    }
  }
}

}  // namespace

float text_width(std::string_view utf8, float height_px) {
  if (!(height_px > 0.0F)) return 0.0F;
  TextLine line;
  set_line(utf8, height_px, line);
  return line.width_px;
}

void draw_text(Image& image, float x, float y, std::string_view utf8, float height_px,
               const Color& color) {
  NADE_ASSERT(std::isfinite(x) && std::isfinite(y) && std::isfinite(height_px));
  if (!(height_px > 0.0F)) return;
  const std::array<float, 3> encoded{srgb_encoded(color.x()), srgb_encoded(color.y()),
                                     srgb_encoded(color.z())};
  TextLine line;
  set_line(utf8, height_px, line);
  const int baseline = static_cast<int>(std::lround(y + ascent_px(height_px)));
  for (const PlacedGlyph& placed : line.glyphs) {
    const float pen = x + placed.x;
    const float whole = std::floor(pen);
    const GlyphBitmap glyph = draw_glyph(placed.glyph, height_px, pen - whole);
    put_glyph(image, glyph, static_cast<int>(whole) + glyph.left, baseline + glyph.top, encoded);
  }
}

}  // namespace nade::draw
