#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "byte_source.h"
#include "nade/status.h"

namespace nade::io {

using Json = nlohmann::json;

/// Parses one JSON text. NaN, Infinity and numbers too large for a double, which JSON has not but
/// programs write, become null. The error is only the place and what was expected there, to be
/// prefixed with the file's name and the line ("column 41: expected valid JSON").
[[nodiscard]] Result<Json> parse_json(std::string_view text);

/// Refuses a text that is nested deeper than 64, or of more values than said, before it is parsed.
/// The error is without the file's name.
[[nodiscard]] Status check_json_size(std::string_view text, std::size_t most_values = 1'000'000);

/// Where the first number stands that is not finite as a double; none where there is none.
[[nodiscard]] std::optional<std::size_t> find_not_finite(std::string_view text);

/// What a value is, with its article, for "expected …, found …".
[[nodiscard]] std::string kind_of(const Json& value);

/// The text of an object of unknown keys; empty for an empty one.
[[nodiscard]] std::string unknown_text(const Json& object);

/// The beginning of a JSON text: what stands at its top level.
struct Sketch {
  struct Member {
    std::string key;
    /// The first characters of the value that are not white space ("[[0").
    std::string begins;
  };
  /// The first three characters that are not white space.
  std::string begins;
  std::vector<Member> members;  ///< of an object

  [[nodiscard]] const Member* find(std::string_view key) const;
};
/// `text` may end anywhere.
[[nodiscard]] Sketch sketch_of(std::string_view text);

/// Walks through one large JSON object or array an element at a time, without holding it.
class JsonWalker {
 public:
  explicit JsonWalker(ByteSource& source) : source_(&source) {}

  /// Steps past white space and `expected`; false where something else stands.
  [[nodiscard]] bool step(char expected);
  /// The next character that is not white space, left in place.
  [[nodiscard]] std::optional<char> look();
  /// The text of the next value; none where the input ends within it, on a failure of the source
  /// or past `kLongestLine` bytes (see `too_long`). Valid until the next call.
  [[nodiscard]] std::optional<std::string_view> value();
  /// Steps past the next value; false where the input ends within it.
  [[nodiscard]] bool skip_value();

  [[nodiscard]] bool too_long() const { return too_long_; }

 private:
  enum class Keep { text, nothing };
  bool walk_value(Keep keep);

  ByteSource* source_;
  std::string text_;
  bool too_long_ = false;
};

}  // namespace nade::io
