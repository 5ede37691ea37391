#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "nade/status.h"

namespace nade::draw {

/// A picture: sRGB, 8 bits, red green blue alpha (straight), top row first.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;  ///< 4 x width x height

  [[nodiscard]] static Image blank(int width, int height);
};

/// Writes a PNG file: whole or not at all, the same bytes for the same picture.
[[nodiscard]] Status save_png(const std::string& path, const Image& image);

/// Reads a PNG or JPEG file. The error names the file.
[[nodiscard]] Result<Image> load_image(const std::string& path);

}  // namespace nade::draw
