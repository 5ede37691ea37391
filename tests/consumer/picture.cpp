// Writes a picture with text in it, as another project does.

#include <cstdio>

#include "nade/draw/image.h"
#include "nade/draw/text.h"

int main() {
  nade::draw::Image image = nade::draw::Image::blank(120, 32);
  nade::draw::draw_text(image, 4.0F, 4.0F, "nade", 24.0F, {1.0F, 1.0F, 1.0F});
  const nade::Status saved = nade::draw::save_png("picture.png", image);
  if (!saved) std::fprintf(stderr, "%s\n", saved.error().message.c_str());
  return saved ? 0 : 1;
}
