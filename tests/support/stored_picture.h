#pragma once

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "nade/draw/image.h"

namespace nade::test {

/// Who draws in the context that is current.
inline std::string drawn_by() {
  const auto text = [](GLenum name) {
    return std::string(reinterpret_cast<const char*>(glGetString(name))) + "\n";
  };
  return text(GL_RENDERER) + text(GL_VERSION);
}

/// Holds a picture against tests/data/pictures/NAME.png: pixel by pixel where drawn_by.txt there
/// names the renderer in use; else by its mean difference, and the test says that it skips the
/// rest. With NADE_TEST_UPDATE set it stores what is drawn now. Look at it before you commit it:
///
///     NADE_TEST_UPDATE=1 ctest --preset release -R '^(draw|stage)'
inline void expect_stored(const draw::Image& drawn, const std::string& name) {
  const std::string folder = std::string(NADE_TEST_DATA_DIR) + "/pictures/";
  if (std::getenv("NADE_TEST_UPDATE") != nullptr) {
    ASSERT_TRUE(draw::save_png(folder + name + ".png", drawn));
    std::ofstream(folder + "drawn_by.txt") << drawn_by();
  }
  const Result<draw::Image> stored = draw::load_image(folder + name + ".png");
  ASSERT_TRUE(stored) << stored.error().message;
  ASSERT_EQ(stored->width, drawn.width);
  ASSERT_EQ(stored->height, drawn.height);
  // Another driver rounds otherwise and samples edges elsewhere.
  double difference = 0.0;
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < drawn.rgba.size(); i += 4) {
    bool same = true;
    for (std::size_t k = i; k < i + 4; ++k) {
      difference += std::abs(drawn.rgba[k] - stored->rgba[k]);
      same = same && drawn.rgba[k] == stored->rgba[k];
    }
    pixels += same ? 0 : 1;
  }
  EXPECT_LT(difference / static_cast<double>(drawn.rgba.size()), 2.0) << name;
  std::ostringstream known;
  known << std::ifstream(folder + "drawn_by.txt").rdbuf();
  if (known.str() != drawn_by()) {
    GTEST_SKIP() << name << ".png was drawn by " << known.str() << "compared by measure only with "
                 << drawn_by();
  }
  // One renderer's reciprocals are another processor's: at edges a few pixels differ.
  constexpr std::size_t kPixelsForOneOther = 1000;
  EXPECT_LE(pixels, drawn.rgba.size() / 4 / kPixelsForOneOther)
      << "pixels of " << name << ".png differ";
}

}  // namespace nade::test
