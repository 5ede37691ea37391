#include "bvh_text.h"

#include <fmt/format.h>

#include "nade/io/plain_text.h"

namespace nade::io {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";
constexpr std::string_view kWordEnds = " \t\r\v\f{}";

}  // namespace

bool BvhText::next_line() {
  while (const std::optional<Line> line = source_.read_line()) {
    ++line_;
    left_ = line->text;
    whole_ = line->terminated;
    if (left_.find_first_not_of(kBlanks) != std::string_view::npos) return true;
  }
  left_ = {};
  return false;
}

std::string_view BvhText::word_of_line() {
  const std::size_t begin = left_.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  left_.remove_prefix(begin);
  const bool brace = left_.front() == '{' || left_.front() == '}';
  const std::string_view word = left_.substr(0, brace ? 1 : left_.find_first_of(kWordEnds));
  left_.remove_prefix(word.size());
  return word;
}

std::string_view BvhText::word() {
  do {
    const std::string_view word = word_of_line();
    if (!word.empty()) return word;
  } while (next_line());
  return {};
}

std::string_view BvhText::rest_of_line() {
  std::string_view rest = left_.substr(0, left_.find('{'));
  left_.remove_prefix(rest.size());
  while (!rest.empty() && kBlanks.find(rest.front()) != std::string_view::npos)
    rest.remove_prefix(1);
  while (!rest.empty() && kBlanks.find(rest.back()) != std::string_view::npos)
    rest.remove_suffix(1);
  return rest;
}

std::string BvhText::place() const { return fmt::format("{}: line {}", source_.name(), line_); }

Error BvhText::expected(std::string_view what, std::string_view found) const {
  if (source_.failure()) return *source_.failure();
  constexpr std::size_t kLongest = 40;
  return {ErrorCode::bad_format,
          fmt::format("{}: expected {}, found {}", place(), what,
                      found.empty() ? "the end of the file"
                                    : fmt::format("'{}'", plain_text(found.substr(0, kLongest))))};
}

}  // namespace nade::io
