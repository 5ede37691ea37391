#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace nade::study {

/// How wide a text is when it is shown, in any unit.
using TextWidth = std::function<double(std::string_view utf8)>;

/// A text in lines no wider than `room`: broken at blanks, in Japanese between phrases (after
/// punctuation, and where kana end and the next word begins), or, where a text has zero-width
/// spaces (U+200B), there instead. What is too wide for a line by itself is broken between
/// characters; one character may stand over. Line feeds are kept. At least one line.
[[nodiscard]] std::vector<std::string> broken_lines(std::string_view utf8, double room,
                                                    const TextWidth& width);

}  // namespace nade::study
