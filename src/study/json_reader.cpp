#include "json_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "../io/json_text.h"
#include "nade/study/plan.h"

namespace nade::study {
namespace {

constexpr std::size_t kShownMax = 40;

const Json kNothing;

/// A value as a sentence shows it.
std::string shown(const Json& value) {
  if (value.is_null()) return "nothing";
  if (value.is_object()) return "an object";
  if (value.is_array()) return fmt::format("an array of {}", value.size());
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() > kShownMax) text = text.substr(0, kShownMax) + "…";
  return text;
}

}  // namespace

const Json* JsonReader::find(const char* key) const {
  if (!value_->is_object()) return nullptr;
  const auto found = value_->find(key);
  return found == value_->end() ? nullptr : &*found;
}

JsonReader JsonReader::child(const Json& value, std::string place) const {
  JsonReader reader(value, file_, *error_);
  reader.place_ = std::move(place);
  return reader;
}

void JsonReader::refuse(const std::string& expected) const {
  if (*error_) return;
  *error_ = Error{ErrorCode::bad_value,
                  fmt::format("{}: {}{}expected {}, found {}", file_, place_,
                              place_.empty() ? "" : ": ", expected, shown(*value_))};
}

void JsonReader::be(std::string_view format, int version) const {
  if (at("format").json() != format) at("format").refuse(fmt::format("\"{}\"", format));
  if (at("version").json() != version) at("version").refuse(std::to_string(version));
}

void JsonReader::allow(std::initializer_list<std::string_view> keys) const {
  if (!value_->is_object()) return refuse("an object");
  for (const auto& [key, value] : value_->items()) {
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    if (*error_) return;
    *error_ = Error{ErrorCode::bad_value,
                    fmt::format("{}: {}{}expected only {}, found \"{}\"", file_, place_,
                                place_.empty() ? "" : ": ", fmt::join(keys, ", "), key)};
  }
}

JsonReader JsonReader::at(const char* key) const {
  const Json* const found = find(key);
  return child(found == nullptr ? kNothing : *found,
               place_.empty() ? std::string(key) : fmt::format("{}.{}", place_, key));
}

JsonReader JsonReader::at(std::size_t index) const {
  const bool there = value_->is_array() && index < value_->size();
  return child(there ? (*value_)[index] : kNothing, fmt::format("{}[{}]", place_, index));
}

std::size_t JsonReader::count(std::size_t least) const {
  if (!value_->is_array() || value_->size() < least) {
    refuse(fmt::format("an array of at least {}", least));
    return 0;
  }
  return value_->size();
}

std::string JsonReader::text() const {
  if (value_->is_string()) return value_->get<std::string>();
  refuse("a text");
  return {};
}

std::string JsonReader::identifier() const {
  if (value_->is_string() && is_identifier(value_->get_ref<const std::string&>())) return text();
  refuse("a name of letters, digits, - and _");
  return {};
}

double JsonReader::number(double low, double high) const {
  const double value = value_->is_number() ? value_->get<double>() : std::nan("");
  if (value >= low && value <= high) return value;
  refuse(fmt::format("a number from {} to {}", low, high));
  return low;
}

std::uint64_t JsonReader::whole(std::uint64_t low, std::uint64_t high) const {
  if (value_->is_number_unsigned()) {
    const auto value = value_->get<std::uint64_t>();
    if (value >= low && value <= high) return value;
  }
  refuse(fmt::format("a whole number from {} to {}", low, high));
  return low;
}

Result<Json> parse_json(std::string_view text, const std::string& name) {
  const Status size = io::check_json_size(text);
  if (!size) {
    return Error{size.error().code, fmt::format("{}: {}", name, size.error().message)};
  }
  const auto error_at = [&](std::size_t byte, std::string_view expected) {
    const std::string_view before = text.substr(0, std::min(byte, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    return Error{ErrorCode::bad_format,
                 fmt::format("{}: line {}: expected {}", name, line, expected)};
  };
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    return error_at(error.byte, "valid JSON");
  } catch (const Json::out_of_range&) {
    return error_at(io::find_not_finite(text).value_or(0),
                    "numbers that a double can hold, found a larger one");
  }
}

Result<std::string> read_text(const std::string& path, std::string_view what) {
  std::error_code aside;
  if (!std::filesystem::exists(path, aside)) {
    return Error{ErrorCode::not_found,
                 fmt::format("{}: expected {}, found no such file", path, what)};
  }
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file.good() && !file.eof()) {
    return Error{ErrorCode::unreadable,
                 fmt::format("{}: expected {}, but the file cannot be read", path, what)};
  }
  return text;
}

}  // namespace nade::study
