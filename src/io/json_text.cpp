#include "json_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "sketch_reader.h"

namespace nade::io {
namespace {

/// Deeper than any recording, shallow enough to recurse through.
constexpr std::size_t kDeepest = 64;
/// More than any frame or header has; parsed they take some hundred bytes each.

bool continues_scalar(char c) {
  return !is_space(c) && c != ',' && c != ']' && c != '}' && c != ':' && c != '"';
}

bool is_not_finite(const std::string& token) {
  if (token == "NaN" || token == "Infinity" || token == "-Infinity") return true;
  if (token.empty() || (token[0] != '-' && (token[0] < '0' || token[0] > '9'))) return false;
  char* end = nullptr;
  const double number = std::strtod(token.c_str(), &end);
  return *end == '\0' && !std::isfinite(number);
}

/// Calls `take` with where each number, literal or misspelt word begins, and its text.
template <class Take>
void for_each_scalar(std::string_view text, Take&& take) {
  bool in_string = false;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (in_string || c == '"' || !continues_scalar(c) || c == '[' || c == '{') {
      if (in_string && c == '\\') ++i;
      if (c == '"') in_string = !in_string;
      ++i;
      continue;
    }
    const std::size_t begin = i;
    while (i < text.size() && continues_scalar(text[i])) ++i;
    take(begin, text.substr(begin, i - begin));
  }
}

/// The text with null for every number that is not finite; none where there is none.
std::optional<std::string> with_nulls(std::string_view text) {
  std::string result;
  std::size_t copied = 0;
  for_each_scalar(text, [&](std::size_t begin, std::string_view token) {
    if (!is_not_finite(std::string(token))) return;
    result += text.substr(copied, begin - copied);
    result += "null";
    copied = begin + token.size();
  });
  if (copied == 0) return std::nullopt;
  result += text.substr(copied);
  return result;
}

}  // namespace

Status check_json_size(std::string_view text, std::size_t most_values) {
  std::size_t depth = 0;
  std::size_t values = 1;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string && c == '\\') {
      ++i;
    } else if (c == '"') {
      in_string = !in_string;
    } else if (in_string) {
      continue;
    } else if (c == '[' || c == '{') {
      ++depth;
      ++values;
    } else if (c == ',') {
      ++values;
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
    if (depth > kDeepest) {
      return Error{ErrorCode::bad_format,
                   fmt::format("expected values nested at most {} deep, found more", kDeepest)};
    }
    if (values > most_values) {
      return Error{ErrorCode::bad_format,
                   fmt::format("expected at most {} values in one, found more", most_values)};
    }
  }
  return ok_status();
}

std::optional<std::size_t> find_not_finite(std::string_view text) {
  std::optional<std::size_t> found;
  for_each_scalar(text, [&](std::size_t begin, std::string_view token) {
    if (!found && is_not_finite(std::string(token))) found = begin;
  });
  return found;
}

Result<Json> parse_json(std::string_view text) {
  const Status size = check_json_size(text);
  if (!size) return size.error();
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    if (const std::optional<std::string> mended = with_nulls(text)) {
      Json value = Json::parse(*mended, nullptr, false);
      if (!value.is_discarded()) return value;
    }
    const auto* const misread = dynamic_cast<const Json::parse_error*>(&error);
    if (misread == nullptr) return Error{ErrorCode::bad_format, "expected valid JSON"};
    return Error{ErrorCode::bad_format, fmt::format("column {}: expected valid JSON",
                                                    std::max(misread->byte, std::size_t{1}))};
  }
}

std::string kind_of(const Json& value) {
  if (value.is_null()) return "no finite number";
  return fmt::format("{} {}", value.is_structured() ? "an" : "a", value.type_name());
}

std::string unknown_text(const Json& object) {
  if (!object.is_object() || object.empty()) return {};
  return object.dump();
}

const Sketch::Member* Sketch::find(std::string_view key) const {
  const auto found = std::find_if(members.begin(), members.end(),
                                  [&](const Member& member) { return member.key == key; });
  return found == members.end() ? nullptr : &*found;
}

Sketch sketch_of(std::string_view text) {
  SketchReader reader(text);
  Sketch sketch;
  sketch.begins = reader.begins();
  if (!reader.step('{')) return sketch;
  do {
    Sketch::Member member{reader.string(), {}};
    if (!reader.step(':')) break;
    static_cast<void>(reader.at_end());
    member.begins = reader.begins();
    sketch.members.push_back(std::move(member));
    reader.skip_value();
  } while (reader.step(','));
  return sketch;
}

std::optional<char> JsonWalker::look() {
  std::string_view next = source_->peek(1);
  while (!next.empty() && is_space(next[0])) {
    static_cast<void>(source_->get());
    next = source_->peek(1);
  }
  if (next.empty()) return std::nullopt;
  return next[0];
}

bool JsonWalker::step(char expected) {
  if (look() != expected) return false;
  static_cast<void>(source_->get());
  return true;
}

bool JsonWalker::walk_value(Keep keep) {
  text_.clear();
  if (!look()) return false;
  std::size_t depth = 0;
  bool in_string = false;
  while (true) {
    const std::string_view next = source_->peek(1);
    if (next.empty()) return false;
    const char c = next[0];
    const bool ends_outer = !in_string && depth == 0 && !text_.empty() &&
                            (c == ',' || c == ']' || c == '}' || c == ':' || is_space(c));
    if (ends_outer) return true;
    static_cast<void>(source_->get());
    if (keep == Keep::text || text_.empty()) text_ += c;
    if (text_.size() > kLongestLine) {
      too_long_ = true;
      return false;
    }
    if (in_string) {
      if (c == '\\') {
        const std::optional<char> escaped = source_->get();
        if (!escaped) return false;
        if (keep == Keep::text) text_ += *escaped;
      }
      in_string = c != '"';
      if (!in_string && depth == 0) return true;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      if (depth == 0) return false;
      if (--depth == 0) return true;
    }
  }
}

std::optional<std::string_view> JsonWalker::value() {
  if (!walk_value(Keep::text)) return std::nullopt;
  return text_;
}

bool JsonWalker::skip_value() { return walk_value(Keep::nothing); }

}  // namespace nade::io
