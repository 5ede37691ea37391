// Pictures in files, and text in pictures.
#include "nade/draw/image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "nade/draw/text.h"
#include "support/files.h"
#include "support/scratch_folder.h"

namespace nade::draw {
namespace {

using ImageFile = test::FolderTest;

Image checkered() {
  Image image = Image::blank(37, 21);
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    image.rgba[i] = static_cast<std::uint8_t>(i * 7919 % 251);
  }
  return image;
}

TEST_F(ImageFile, PngKeepsEveryPixel) {
  const std::string file = path("picture.png");
  const Image image = checkered();
  ASSERT_TRUE(save_png(file, image));
  const Result<Image> loaded = load_image(file);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->width, image.width);
  EXPECT_EQ(loaded->height, image.height);
  EXPECT_EQ(loaded->rgba, image.rgba);
}

TEST_F(ImageFile, SamePictureGivesTheSameFile) {
  const std::string first = path("1.png");
  const std::string second = path("2.png");
  ASSERT_TRUE(save_png(first, checkered()));
  ASSERT_TRUE(save_png(second, checkered()));
  EXPECT_EQ(test::read_file(first), test::read_file(second));
}

TEST_F(ImageFile, BrokenFileIsNamed) {
  const std::string whole = path("1.png");
  const std::string half = path("2.png");
  ASSERT_TRUE(save_png(whole, checkered()));
  const std::string bytes = test::read_file(whole);
  test::write_file(half, bytes.substr(0, bytes.size() / 2));
  const Result<Image> loaded = load_image(half);
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().code, ErrorCode::bad_format);
  EXPECT_NE(loaded.error().message.find(half + ": expected a PNG or JPEG picture"),
            std::string::npos)
      << loaded.error().message;
}

TEST_F(ImageFile, MissingFileIsNamed) {
  const Result<Image> loaded = load_image("/no/such/picture.png");
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().code, ErrorCode::not_found);
  EXPECT_EQ(loaded.error().message, "/no/such/picture.png: No such file or directory");
}

TEST_F(ImageFile, WhereNothingCanBeWrittenIsNamed) {
  const Status saved = save_png("/no/such/folder/picture.png", checkered());
  ASSERT_FALSE(saved);
  EXPECT_NE(saved.error().message.find("/no/such/folder/picture.png"), std::string::npos);
}

TEST(Text, WidthGrowsWithHeightAndLength) {
  EXPECT_FLOAT_EQ(text_width("", 20.0F), 0.0F);
  EXPECT_GT(text_width("palm", 20.0F), 20.0F);
  EXPECT_LT(text_width("palm", 20.0F), 60.0F);
  EXPECT_NEAR(text_width("palm", 40.0F), 2.0F * text_width("palm", 20.0F), 0.01F);
  EXPECT_GT(text_width("palms", 20.0F), text_width("palm", 20.0F));
}

TEST(Text, OneCharacterOfSeveralBytesIsOneCharacter) {
  EXPECT_FLOAT_EQ(text_width("\xC3\xA9", 20.0F), text_width("e", 20.0F));
  // A byte that is no UTF-8 is a box.
  EXPECT_GT(text_width("\xFF", 20.0F), 4.0F);
  EXPECT_GT(text_width("\xE2\x82", 20.0F), 4.0F);
}

TEST(Text, JapaneseLettersAreOfTheSystemsFont) {
  if (!japanese_font()) GTEST_SKIP() << "no Japanese font is installed";
  // Not the box that stands for what no font has, and as wide as they are high.
  EXPECT_NE(text_width("\u64ab", 30.0F), text_width("\U0010ffff", 30.0F));
  EXPECT_FLOAT_EQ(text_width("\u64ab\u3067", 30.0F), 2.0F * text_width("\u64ab", 30.0F));
  EXPECT_GT(text_width("\u64ab", 30.0F), 20.0F);
}

TEST(Text, IsDrawnWhereItSaysAndAsWide) {
  Image image = Image::blank(200, 60);
  draw_text(image, 20.0F, 10.0F, "stroke", 30.0F, {0.0F, 0.0F, 0.0F});
  int left = image.width;
  int right = 0;
  int top = image.height;
  int bottom = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.rgba[static_cast<std::size_t>(4 * (y * image.width + x) + 3)] < 128) continue;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
  }
  EXPECT_NEAR(left, 20, 3);
  EXPECT_NEAR(right, 20.0F + text_width("stroke", 30.0F), 3);
  EXPECT_GE(top, 10);
  EXPECT_LE(bottom, 40);
}

TEST(Text, OutsideThePictureIsCutOff) {
  Image image = Image::blank(10, 10);
  draw_text(image, -30.0F, -20.0F, "palm", 80.0F, {1.0F, 0.0F, 0.0F});
  draw_text(image, 1000.0F, 1000.0F, "palm", 80.0F, {1.0F, 0.0F, 0.0F});
  EXPECT_EQ(image.rgba.size(), 400U);
}

}  // namespace
}  // namespace nade::draw
