#include "nade/io/plain_text.h"

#include <array>
#include <cstddef>

// Based on: The Unicode Consortium. The Unicode Standard 15.0. 2022. Table 3-7.

namespace nade {
namespace {

/// Of characters of one, two, three and four bytes, the least.
constexpr std::array<char32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
constexpr char32_t kGreatest = 0x10FFFF;

std::size_t length_from(unsigned char first) {
  if (first < 0x80) return 1;
  if (first < 0xC0) return 0;
  if (first < 0xE0) return 2;
  return first < 0xF0 ? 3 : 4;
}

bool is_control(char32_t c) {
  return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0x200E || c == 0x200F ||
         (c >= 0x2028 && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069);
}

}  // namespace

char32_t next_character(std::string_view& text) {
  const auto first = static_cast<unsigned char>(text.front());
  const std::size_t length = length_from(first);
  if (length == 0 || length > text.size()) {
    text.remove_prefix(1);
    return kReplacement;
  }
  char32_t code = length == 1 ? first : first & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if ((byte & 0xC0U) != 0x80U) {
      text.remove_prefix(i);
      return kReplacement;
    }
    code = code << 6U | (byte & 0x3FU);
  }
  text.remove_prefix(length);
  const bool is_surrogate = code >= 0xD800 && code < 0xE000;
  return code < kLeast[length] || code > kGreatest || is_surrogate ? kReplacement : code;
}

std::string plain_text(std::string_view text) {
  std::string plain;
  plain.reserve(text.size());
  while (!text.empty()) {
    const std::string_view from = text;
    const char32_t code = next_character(text);
    if (is_control(code)) {
      plain += ' ';
    } else if (code == kReplacement) {
      plain += "\xEF\xBF\xBD";
    } else {
      plain += from.substr(0, from.size() - text.size());
    }
  }
  return plain;
}

}  // namespace nade
