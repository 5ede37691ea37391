#pragma once

#include <string>
#include <string_view>

namespace nade {

/// What stands for bytes that are no character.
inline constexpr char32_t kReplacement = 0xFFFD;

/// Takes one character of UTF-8 off the front of `text`, which must not be empty. kReplacement, and
/// at least a byte less, where the bytes are none.
char32_t next_character(std::string_view& text);

/// A line that may go to a terminal or into another program's script, whatever file it came from:
/// control characters and those that turn the direction of writing become blanks, bytes that are no
/// UTF-8 become U+FFFD.
[[nodiscard]] std::string plain_text(std::string_view text);

}  // namespace nade
