#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace nade::study {

/// Breaks a text into lines of at most `width` Latin letters: at blanks, and anywhere between the
/// characters of Chinese and Japanese, which count as two; a longer word has a line of its own.
/// UTF-8.
[[nodiscard]] std::vector<std::string> wrapped(std::string_view text, std::size_t width);

}  // namespace nade::study
