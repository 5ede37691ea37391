#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "byte_source.h"

namespace nade::io {

/// Goes through a text file word by word, a line at a time in memory.
class BvhText {
 public:
  explicit BvhText(ByteSource source) : source_(std::move(source)) {}

  /// The next word, on whatever line; empty at the end or after a failure of the source. A brace
  /// is a word by itself. Valid until the next call.
  [[nodiscard]] std::string_view word();
  /// What is left of the line, without a brace at its end and the space around it.
  [[nodiscard]] std::string_view rest_of_line();
  /// Goes to the next line that is not blank; false at the end or after a failure of the source.
  [[nodiscard]] bool next_line();
  /// The next word of this line; empty where it ends.
  [[nodiscard]] std::string_view word_of_line();
  /// Whether this line had an end: the last one of a file that is cut off has none.
  [[nodiscard]] bool line_is_whole() const { return whole_; }

  [[nodiscard]] const ByteSource& source() const { return source_; }
  /// "clip.bvh: line 3"
  [[nodiscard]] std::string place() const;
  /// "clip.bvh: line 3: expected …, found …", or the failure of the source. An empty `found` is the
  /// end of the file.
  [[nodiscard]] Error expected(std::string_view what, std::string_view found) const;

 private:
  ByteSource source_;
  std::string_view left_;  ///< of the line
  bool whole_ = true;
  std::size_t line_ = 0;
};

}  // namespace nade::io
