#pragma once

#include <string_view>

#include "nade/draw/scene.h"

namespace nade::draw {

/// How wide a line of text would be, pixels, at a height (of capitals with ascenders and
/// descenders).
[[nodiscard]] float text_width(std::string_view utf8, float height_px);

/// Writes a line of text into a picture, its top left corner at (x, y). Characters that the font
/// lacks become boxes.
void draw_text(Image& image, float x, float y, std::string_view utf8, float height_px,
               const Color& color);

}  // namespace nade::draw
