#include "glyphs.h"

#include <stb/stb_truetype.h>

#include <algorithm>
#include <cmath>

#include "embedded.h"
#include "nade/assert.h"

namespace nade::draw {
namespace {

struct Font {
  stbtt_fontinfo info{};
  float ascent = 0.0F;

  Font() {
    const std::string_view file = embedded_file("DejaVuSans.ttf");
    const auto* const bytes = reinterpret_cast<const unsigned char*>(file.data());
    const bool read = !file.empty() && stbtt_InitFont(&info, bytes, 0) != 0;
    NADE_ASSERT(read);
    int up = 0;
    int down = 0;
    int gap = 0;
    stbtt_GetFontVMetrics(&info, &up, &down, &gap);
    ascent = static_cast<float>(up);
  }
};

const Font& font() {
  static const Font kFont;
  return kFont;
}

/// Takes one character off the front of `text`; -1 where the bytes are none.
int next_character(std::string_view& text) {
  const auto first = static_cast<unsigned char>(text.front());
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xC0 ? 0
                             : first < 0xE0 ? 2
                             : first < 0xF0 ? 3
                                            : 4;
  if (length == 0 || first > 0xF4 || length > text.size()) {
    text.remove_prefix(1);
    return -1;
  }
  int code = length == 1 ? first : first & (0x7F >> length);
  for (std::size_t i = 1; i < length; ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if ((byte & 0xC0) != 0x80) {
      text.remove_prefix(i);
      return -1;
    }
    code = code << 6 | (byte & 0x3F);
  }
  text.remove_prefix(length);
  return code;
}

}  // namespace

void set_line(std::string_view utf8, float height_px, TextLine& line) {
  const stbtt_fontinfo& info = font().info;
  const float scale = stbtt_ScaleForPixelHeight(&info, height_px);
  line.glyphs.clear();
  float x = 0.0F;
  int before = -1;
  while (!utf8.empty()) {
    const int character = next_character(utf8);
    const int glyph = character < 0 ? 0 : stbtt_FindGlyphIndex(&info, character);
    if (before >= 0) {
      x += scale * static_cast<float>(stbtt_GetGlyphKernAdvance(&info, before, glyph));
    }
    line.glyphs.push_back({glyph, x});
    int advance = 0;
    int bearing = 0;
    stbtt_GetGlyphHMetrics(&info, glyph, &advance, &bearing);
    x += scale * static_cast<float>(advance);
    before = glyph;
  }
  line.width_px = x;
}

float ascent_px(float height_px) {
  return font().ascent * stbtt_ScaleForPixelHeight(&font().info, height_px);
}

GlyphBitmap draw_glyph(int glyph, float height_px, float shift) {
  const stbtt_fontinfo& info = font().info;
  const float scale = stbtt_ScaleForPixelHeight(&info, height_px);
  int right = 0;
  int bottom = 0;
  GlyphBitmap bitmap;
  stbtt_GetGlyphBitmapBoxSubpixel(&info, glyph, scale, scale, shift, 0.0F, &bitmap.left,
                                  &bitmap.top, &right, &bottom);
  bitmap.width = std::max(right - bitmap.left, 0);
  bitmap.height = std::max(bottom - bitmap.top, 0);
  if (bitmap.width == 0 || bitmap.height == 0) return bitmap;
  bitmap.cover.resize(static_cast<std::size_t>(bitmap.width) *
                      static_cast<std::size_t>(bitmap.height));
  stbtt_MakeGlyphBitmapSubpixel(&info, bitmap.cover.data(), bitmap.width, bitmap.height,
                                bitmap.width, scale, scale, shift, 0.0F, glyph);
  return bitmap;
}

float srgb_encoded(float linear) {
  const float c = std::clamp(linear, 0.0F, 1.0F);
  return c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1.0F / 2.4F) - 0.055F;
}

}  // namespace nade::draw
