#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace nade::io {

/// Of JSON.
[[nodiscard]] inline bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// Reads through a JSON text that may end anywhere.
class SketchReader {
 public:
  explicit SketchReader(std::string_view text) : text_(text) {}

  [[nodiscard]] bool at_end() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
    return at_ >= text_.size();
  }
  [[nodiscard]] bool step(char expected) {
    if (at_end() || text_[at_] != expected) return false;
    ++at_;
    return true;
  }
  /// The next three characters that are not white space, left in place.
  [[nodiscard]] std::string begins() const {
    constexpr std::size_t kCount = 3;
    std::string result;
    for (std::size_t i = at_; i < text_.size() && result.size() < kCount; ++i) {
      if (!is_space(text_[i])) result += text_[i];
    }
    return result;
  }
  [[nodiscard]] std::string string() {
    if (!step('"')) return {};
    const std::size_t start = at_;
    while (at_ < text_.size() && text_[at_] != '"') at_ += text_[at_] == '\\' ? 2 : 1;
    at_ = std::min(at_, text_.size());
    return std::string(text_.substr(start, at_++ - start));
  }
  void skip_value() {
    int depth = 0;
    while (!at_end()) {
      const char c = text_[at_];
      if (c == '"') {
        static_cast<void>(string());
      } else if (c == '[' || c == '{') {
        ++depth;
        ++at_;
      } else if (c == ']' || c == '}' || c == ',') {
        if (depth == 0) return;
        if (c != ',') --depth;
        ++at_;
      } else {
        ++at_;
      }
    }
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace nade::io
