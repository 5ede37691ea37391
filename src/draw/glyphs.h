#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace nade::draw {

/// A glyph's shape at a size: how much of each pixel it covers, 0 to 255, top row first.
struct GlyphBitmap {
  int width = 0;
  int height = 0;
  int left = 0;  ///< of the pen, to the bitmap
  int top = 0;   ///< of the baseline, downwards, to the bitmap
  std::vector<std::uint8_t> cover;
};

/// A glyph of a line of text, with the pen's place, pixels from the start.
struct PlacedGlyph {
  int glyph = 0;
  float x = 0.0F;
};

struct TextLine {
  std::vector<PlacedGlyph> glyphs;
  float width_px = 0.0F;
};

/// Sets a line of UTF-8 in the embedded font, Japanese in japanese_font(); what neither has, and
/// bytes that are no UTF-8, become boxes. `line` keeps its memory.
void set_line(std::string_view utf8, float height_px, TextLine& line);

/// From the top of a line to its baseline, pixels.
[[nodiscard]] float ascent_px(float height_px);

/// `shift` is the part of a pixel, 0 to 1, that the pen stands to the right.
[[nodiscard]] GlyphBitmap draw_glyph(int glyph, float height_px, float shift);

/// Linear light as sRGB, 0 to 1.
[[nodiscard]] float srgb_encoded(float linear);

}  // namespace nade::draw
