#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "byte_source.h"
#include "nade/mesh.h"
#include "nade/status.h"

namespace nade::io {

/// Goes through a text word by word and knows the line it is on.
class WordReader {
 public:
  WordReader(const std::string& path, std::string_view text) : path_(path), text_(text) {
    if (text.starts_with(kByteOrderMark)) at_ = kByteOrderMark.size();
  }

  /// The next word, on whatever line; empty at the end. A '#' hides the rest of its line.
  std::string_view word() {
    skip_space();
    return take();
  }
  /// The next word of this line; empty where the line ends.
  std::string_view word_of_line() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    if (at_ < text_.size() && (ends_line(text_[at_]) || text_[at_] == '#')) return {};
    return take();
  }
  void skip_line() {
    while (at_ < text_.size() && !ends_line(text_[at_])) ++at_;
  }

  [[nodiscard]] std::size_t offset() const { return at_; }
  [[nodiscard]] std::size_t line() const { return line_; }
  [[nodiscard]] Error error(ErrorCode code, const std::string& what) const {
    return {code, fmt::format("{}: line {}: {}", path_, line_, what)};
  }
  [[nodiscard]] Error expected(std::string_view what, std::string_view found) const {
    if (found.empty())
      return error(ErrorCode::bad_format,
                   fmt::format("expected {}, found the end of the file", what));
    constexpr std::size_t kLongest = 40;
    return error(ErrorCode::bad_format,
                 fmt::format("expected {}, found '{}'", what, found.substr(0, kLongest)));
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
  /// "\r\n" counts as one end.
  static bool ends_line(char c) { return c == '\n' || c == '\r'; }
  void skip_space() {
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '#') skip_line();
      if (at_ < text_.size() && ends_line(text_[at_])) {
        if (text_[at_] == '\r' || at_ == 0 || text_[at_ - 1] != '\r') ++line_;
      } else if (at_ >= text_.size() || !is_blank(text_[at_])) {
        return;
      }
    }
  }
  std::string_view take() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_blank(text_[at_]) && !ends_line(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  const std::string& path_;
  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

/// Whether the whole word is a number, which then is in `number`.
template <class Number>
[[nodiscard]] bool parse_word(std::string_view word, Number& number) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), number);
  return code == std::errc{} && end == word.data() + word.size();
}

/// `text` in small letters.
[[nodiscard]] inline std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

/// What is said of a polygon that `add_polygon` does not take.
inline constexpr std::string_view kTooWinding =
    "expected a polygon that can be cut into triangles, found one too large and too winding";

/// Adds a polygon as triangles, cut where it has inward corners. Fewer than three corners add
/// nothing; one that crosses itself is cut somehow. All corners must be vertices of `soup`. False
/// where the polygon is too large and too winding to be cut in reasonable time.
[[nodiscard]] bool add_polygon(TriangleSoup& soup, std::span<const std::uint32_t> corners);

}  // namespace nade::io
