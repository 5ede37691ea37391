#pragma once

#include "nade/draw/image.h"

namespace nade::viewer {

/// A picture in the graphics card's memory to draw into, in the OpenGL context that is current.
class Canvas {
 public:
  Canvas(int width, int height);
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;
  ~Canvas();

  [[nodiscard]] unsigned framebuffer() const { return framebuffer_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

 private:
  int width_;
  int height_;
  unsigned color_ = 0;
  unsigned depth_ = 0;
  unsigned framebuffer_ = 0;
};

/// Reads a picture back from a framebuffer of the current context (0: the window).
[[nodiscard]] draw::Image read_back(unsigned framebuffer, int width, int height);

}  // namespace nade::viewer
