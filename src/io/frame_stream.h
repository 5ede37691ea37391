#pragma once

#include <optional>
#include <string>
#include <variant>

#include "byte_source.h"
#include "frame_array.h"
#include "json_text.h"
#include "warnings.h"

namespace nade::io {

/// JSON Lines: a value in each line.
class JsonLines {
 public:
  explicit JsonLines(ByteSource source) : source_(std::move(source)) {}

  /// The value of the next line that is not blank; none at the end, or where the file is cut off,
  /// which is a warning.
  [[nodiscard]] Result<std::optional<Json>> next(Warnings& warnings);
  [[nodiscard]] const std::string& name() const { return source_.name(); }
  /// The line that `next` gave last ("clip.jsonl: line 17").
  [[nodiscard]] std::string place() const;

 private:
  ByteSource source_;
  std::size_t line_ = 0;
};

/// The frames of a file one at a time: of an array, of an object's array "frames", or of JSON
/// Lines.
class FrameStream {
 public:
  /// `member` gets each member of an object that stands before its "frames".
  [[nodiscard]] static Result<FrameStream> open(ByteSource source,
                                                const FrameArray::Member& member);

  [[nodiscard]] Result<std::optional<Json>> next(Warnings& warnings);
  [[nodiscard]] const std::string& name() const;
  /// The frame that `next` gave last ("clip.json: frames[17]").
  [[nodiscard]] std::string place() const;

 private:
  explicit FrameStream(std::variant<FrameArray, JsonLines> frames) : frames_(std::move(frames)) {}

  std::variant<FrameArray, JsonLines> frames_;
};

}  // namespace nade::io
