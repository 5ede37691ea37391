#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "byte_source.h"
#include "json_text.h"
#include "warnings.h"

namespace nade::io {

/// The array "frames" of a large JSON object, or a large JSON array itself, an element at a time.
class FrameArray {
 public:
  explicit FrameArray(ByteSource source)
      : source_(std::make_unique<ByteSource>(std::move(source))), walker_(*source_) {}

  /// Steps into the array; `member` gets each member of the object that stands before it. The
  /// error names the file.
  using Member = std::function<Status(const std::string& key, Json value)>;
  [[nodiscard]] Status enter(const Member& member);

  /// The next element; none at the end, or where the file is cut off, which is a warning.
  [[nodiscard]] Result<std::optional<Json>> next(Warnings& warnings);

  [[nodiscard]] const std::string& name() const { return source_->name(); }
  /// The element that `next` gave last ("clip.json: frames[17]").
  [[nodiscard]] std::string place() const;

 private:
  enum class State { before_first, between, after_last };

  Status read_members(const Member& member);
  Error unfinished(const std::string& where) const;
  Result<std::optional<Json>> cut_off(Warnings& warnings);
  Status finish(Warnings& warnings);

  std::unique_ptr<ByteSource> source_;  // the walker points to it
  JsonWalker walker_;
  State state_ = State::before_first;
  bool in_object_ = false;
  std::size_t count_ = 0;
};

}  // namespace nade::io
