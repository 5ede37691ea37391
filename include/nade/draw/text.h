#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "nade/draw/scene.h"

namespace nade::draw {

/// How wide a line of text would be, pixels, at a height (of capitals with ascenders and
/// descenders).
[[nodiscard]] float text_width(std::string_view utf8, float height_px);

/// The font that the library brings and writes with, as a TrueType file's bytes; they last.
[[nodiscard]] std::string_view font_bytes();

/// The file of an installed font with Japanese letters, which the embedded one lacks; none where
/// the system has none of those we know.
[[nodiscard]] std::optional<std::string> japanese_font();

/// What to say where there is none and Japanese is to be shown.
inline constexpr std::string_view kNoJapaneseFont =
    "no font with Japanese letters was found: install fonts-ipafont-gothic (Debian), or run in "
    "English: --language en";

/// Writes a line of text into a picture, its top left corner at (x, y). Characters that no font
/// has become boxes.
void draw_text(Image& image, float x, float y, std::string_view utf8, float height_px,
               const Color& color);

}  // namespace nade::draw
