#include "nade/io/plain_text.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace nade {
namespace {

TEST(PlainText, LettersOfAnyScriptStay) {
  const std::string text = "Wärme 手のひら 🐕 100 %";
  EXPECT_EQ(plain_text(text), text);
}

TEST(PlainText, WhatSteersATerminalBecomesABlank) {
  EXPECT_EQ(plain_text("a\x1b[31mb\r\n\tc\x7f"), "a [31mb   c ");
  EXPECT_EQ(plain_text(std::string("a\0b", 3)), "a b");
  EXPECT_EQ(plain_text("a\u009b31mb"), "a 31mb");
  EXPECT_EQ(plain_text("a\u202eb\u2066c"), "a b c");
}

TEST(PlainText, BytesThatAreNoCharacterAreShownAsSuch) {
  const std::string replaced = "\xEF\xBF\xBD";
  EXPECT_EQ(plain_text("\xE9t\xE9"), replaced + "t" + replaced);  // Latin-1
  EXPECT_EQ(plain_text("\xC0\xAF"), replaced);                    // overlong
  EXPECT_EQ(plain_text("\xED\xA0\x80"), replaced);                // half a pair of UTF-16
  EXPECT_EQ(plain_text("\xF4\x90\x80\x80"), replaced);            // beyond U+10FFFF
  EXPECT_EQ(plain_text("\xE6\x89"), replaced + replaced);         // cut off
}

TEST(PlainText, EveryCallTakesAtLeastAByte) {
  for (int first = 0; first < 256; ++first) {
    for (int second = 0; second < 256; ++second) {
      const std::string bytes{static_cast<char>(first), static_cast<char>(second)};
      std::string_view left = bytes;
      next_character(left);
      EXPECT_LT(left.size(), 2U);
    }
  }
}

}  // namespace
}  // namespace nade
