#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "nade/status.h"

namespace nade::study {

using Json = nlohmann::ordered_json;

/// A value in a JSON file, which knows where it stands. Asking for what is not there gives a
/// stand-in and notes the first thing that was wrong.
class JsonReader {
 public:
  /// `error` outlives the reader and everything it gives.
  JsonReader(const Json& value, std::string file, std::optional<Error>& error)
      : value_(&value), file_(std::move(file)), error_(&error) {}

  [[nodiscard]] const Json& json() const { return *value_; }
  [[nodiscard]] bool has(const char* key) const { return find(key) != nullptr; }
  [[nodiscard]] bool is_text() const { return value_->is_string(); }

  /// Refuses every key but these.
  void allow(std::initializer_list<std::string_view> keys) const;
  /// Refuses a file of another format or version than this.
  void be(std::string_view format, int version) const;
  /// A member, which has to be there.
  [[nodiscard]] JsonReader at(const char* key) const;
  /// An element of an array.
  [[nodiscard]] JsonReader at(std::size_t index) const;
  /// How many elements there are: at least `least`.
  [[nodiscard]] std::size_t count(std::size_t least) const;

  [[nodiscard]] std::string text() const;
  /// A name of files and tables.
  [[nodiscard]] std::string identifier() const;
  [[nodiscard]] double number(double low, double high) const;
  [[nodiscard]] std::uint64_t whole(std::uint64_t low, std::uint64_t high) const;
  void refuse(const std::string& expected) const;

 private:
  [[nodiscard]] const Json* find(const char* key) const;
  [[nodiscard]] JsonReader child(const Json& value, std::string place) const;

  const Json* value_;
  std::string file_;
  std::optional<Error>* error_;
  std::string place_;
};

/// Parses a whole text. The error names the file and the place.
[[nodiscard]] Result<Json> parse_json(std::string_view text, const std::string& name);

/// A file's content. `what` is what was expected there ("a plan").
[[nodiscard]] Result<std::string> read_text(const std::string& path, std::string_view what);

}  // namespace nade::study
