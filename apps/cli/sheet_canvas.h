#pragma once

#include <string_view>

#include "nade/draw/image.h"
#include "nade/draw/scene.h"

namespace nade::cli {

/// A place on a sheet, pixels from its top left corner.
using Spot = Eigen::Vector2f;

/// A white sheet to lay pictures, text and legends out on. Colours are linear light.
class SheetCanvas {
 public:
  SheetCanvas(int width, int height);

  /// A picture with rounded corners; what lies beyond the sheet is left out.
  void paste(const draw::Image& picture, int left, int top);
  void line(const Spot& from, const Spot& to, float width_px, const draw::Color& color);
  void disc(const Spot& center, float radius_px, const draw::Color& color);
  void arrow(const Spot& from, const Spot& to, float width_px, const draw::Color& color);
  /// Text whose line's top left corner is at `at`.
  void text(const Spot& at, std::string_view utf8, float height_px, const draw::Color& color);
  /// Text centred about `at.x()`.
  void centered(const Spot& at, std::string_view utf8, float height_px, const draw::Color& color);

  [[nodiscard]] const draw::Image& image() const { return image_; }

 private:
  void blend(int x, int y, const draw::Color& color, float cover);
  template <class Distance>
  void fill(const Spot& low, const Spot& high, const draw::Color& color, const Distance& distance);

  draw::Image image_;
};

}  // namespace nade::cli
