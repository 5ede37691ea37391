#include "glyphs.h"

#include <stb/stb_truetype.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "embedded.h"
#include "nade/assert.h"
#include "nade/draw/text.h"
#include "nade/io/plain_text.h"

namespace nade::draw {
namespace {

struct Font {
  stbtt_fontinfo info{};
  float ascent = 0.0F;
  bool read = false;

  explicit Font(std::string_view file) {
    const auto* const bytes = reinterpret_cast<const unsigned char*>(file.data());
    const int offset = file.empty() ? -1 : stbtt_GetFontOffsetForIndex(bytes, 0);
    read = offset >= 0 && stbtt_InitFont(&info, bytes, offset) != 0;
    if (!read) return;
    int up = 0;
    int down = 0;
    int gap = 0;
    stbtt_GetFontVMetrics(&info, &up, &down, &gap);
    ascent = static_cast<float>(up);
  }
};

const Font& main_font() {
  static const Font kFont(font_bytes());
  NADE_ASSERT(kFont.read);
  return kFont;
}

std::string file_content(const std::optional<std::string>& path) {
  if (!path) return {};
  std::ifstream file(*path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// For the letters that the main one does not have; not read where the system has none.
const Font& second_font() {
  static const std::string kFile = file_content(japanese_font());
  static const Font kFont(kFile);
  return kFont;
}

/// Marks a glyph's number as one of the second font's, whose numbers end below.
constexpr int kOfSecond = 1 << 16;

int find_glyph(char32_t character) {
  if (character == kReplacement) return 0;
  const auto code = static_cast<int>(character);
  const int glyph = stbtt_FindGlyphIndex(&main_font().info, code);
  if (glyph != 0 || !second_font().read) return glyph;
  const int other = stbtt_FindGlyphIndex(&second_font().info, code);
  return other != 0 ? other | kOfSecond : 0;
}

const stbtt_fontinfo& font_of(int glyph) {
  return (glyph & kOfSecond) != 0 ? second_font().info : main_font().info;
}

}  // namespace

std::string_view font_bytes() { return embedded_file("DejaVuSans.ttf"); }

std::optional<std::string> japanese_font() {
  for (const char* file : {"/usr/share/fonts/opentype/ipafont-gothic/ipag.ttf",
                           "/usr/share/fonts/truetype/fonts-japanese-gothic.ttf",
                           "/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc",
                           "/usr/share/fonts/truetype/vlgothic/VL-Gothic-Regular.ttf"}) {
    if (std::filesystem::exists(file)) return file;
  }
  return std::nullopt;
}

void set_line(std::string_view utf8, float height_px, TextLine& line) {
  line.glyphs.clear();
  float x = 0.0F;
  int before = 0;
  while (!utf8.empty()) {
    const int glyph = find_glyph(next_character(utf8));
    const stbtt_fontinfo& info = font_of(glyph);
    const float scale = stbtt_ScaleForPixelHeight(&info, height_px);
    const int number = glyph & ~kOfSecond;
    if (!line.glyphs.empty() && &font_of(before) == &info) {
      x +=
          scale * static_cast<float>(stbtt_GetGlyphKernAdvance(&info, before & ~kOfSecond, number));
    }
    line.glyphs.push_back({glyph, x});
    int advance = 0;
    int bearing = 0;
    stbtt_GetGlyphHMetrics(&info, number, &advance, &bearing);
    x += scale * static_cast<float>(advance);
    before = glyph;
  }
  line.width_px = x;
}

float ascent_px(float height_px) {
  return main_font().ascent * stbtt_ScaleForPixelHeight(&main_font().info, height_px);
}

GlyphBitmap draw_glyph(int glyph, float height_px, float shift) {
  const stbtt_fontinfo& info = font_of(glyph);
  const int number = glyph & ~kOfSecond;
  const float scale = stbtt_ScaleForPixelHeight(&info, height_px);
  int right = 0;
  int bottom = 0;
  GlyphBitmap bitmap;
  stbtt_GetGlyphBitmapBoxSubpixel(&info, number, scale, scale, shift, 0.0F, &bitmap.left,
                                  &bitmap.top, &right, &bottom);
  bitmap.width = std::max(right - bitmap.left, 0);
  bitmap.height = std::max(bottom - bitmap.top, 0);
  if (bitmap.width == 0 || bitmap.height == 0) return bitmap;
  bitmap.cover.resize(static_cast<std::size_t>(bitmap.width) *
                      static_cast<std::size_t>(bitmap.height));
  stbtt_MakeGlyphBitmapSubpixel(&info, bitmap.cover.data(), bitmap.width, bitmap.height,
                                bitmap.width, scale, scale, shift, 0.0F, number);
  return bitmap;
}

float srgb_encoded(float linear) {
  const float c = std::clamp(linear, 0.0F, 1.0F);
  return c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1.0F / 2.4F) - 0.055F;
}

}  // namespace nade::draw
