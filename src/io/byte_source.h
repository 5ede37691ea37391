#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nade/status.h"

namespace nade::io {

/// The longest line of our format, and the longest element of an imported one.
inline constexpr std::size_t kLongestLine = std::size_t{16} << 20;

/// What some editors put before a text; it is no part of it.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// A line without its end.
struct Line {
  std::string_view text;  ///< valid until the next read
  bool terminated;        ///< whether a line end followed
};

/// The bytes of a file or of standard input, gzip taken off where its magic is found, LZString
/// where it has packed JSON, a byte order mark skipped. Of gzip there may be several members, and
/// zeros after the last.
class ByteSource {
 public:
  [[nodiscard]] static Result<ByteSource> open(const std::string& path);
  ByteSource(ByteSource&&) noexcept;
  ByteSource& operator=(ByteSource&&) noexcept;
  ~ByteSource();

  /// What to call it in a message.
  [[nodiscard]] const std::string& name() const { return name_; }

  /// Up to `count` of the next bytes, left in place; fewer only at the end.
  [[nodiscard]] std::string_view peek(std::size_t count);
  /// The next byte; none at the end or after a failure.
  [[nodiscard]] std::optional<char> get() {
    if (begin_ == end_ && !fill()) return std::nullopt;
    return buffer_[begin_++];
  }
  /// The next line; none at the end or after a failure. A line over `kLongestLine` is a failure.
  [[nodiscard]] std::optional<Line> read_line();

  /// Whether the gzip stream, or LZString's, stopped before its end.
  [[nodiscard]] bool cut_off() const { return cut_off_; }
  [[nodiscard]] const std::optional<Error>& failure() const { return failure_; }

 private:
  class Unpacker;
  struct LzLayer;

  ByteSource(std::string name, int descriptor);
  bool fill();
  std::size_t read_unpacked(char* to, std::size_t room);
  std::size_t read_lz(char* to, std::size_t room);

  std::string name_;
  std::unique_ptr<Unpacker> unpacker_;
  std::unique_ptr<LzLayer> lz_;  ///< where LZString has packed what comes out of it
  std::vector<char> buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::string line_;
  std::size_t lines_read_ = 0;
  bool cut_off_ = false;
  std::optional<Error> failure_;
};

}  // namespace nade::io
