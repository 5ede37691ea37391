#include "frame_array.h"

#include <fmt/format.h>

namespace nade::io {

std::string FrameArray::place() const {
  return fmt::format("{}: frames[{}]", name(), count_ == 0 ? 0 : count_ - 1);
}

Error FrameArray::unfinished(const std::string& where) const {
  if (source_->failure()) return *source_->failure();
  if (walker_.too_long()) {
    return {ErrorCode::bad_format, fmt::format("{}: expected at most {} MiB in one value, found "
                                               "more",
                                               where, kLongestLine >> 20)};
  }
  return {ErrorCode::bad_format,
          fmt::format("{}: expected an array \"frames\", found the file cut off before it", where)};
}

Status FrameArray::enter(const Member& member) {
  if (walker_.step('[')) return ok_status();
  in_object_ = true;
  if (!walker_.step('{')) return unfinished(name());
  return read_members(member);
}

Status FrameArray::read_members(const Member& member) {
  while (true) {
    const std::optional<std::string_view> quoted = walker_.value();
    if (!quoted) return unfinished(name());
    const Result<Json> key = parse_json(*quoted);
    if (!key || !key->is_string() || !walker_.step(':')) {
      return Error{ErrorCode::bad_format,
                   fmt::format("{}: expected valid JSON before \"frames\"", name())};
    }
    const auto key_text = key->get<std::string>();
    if (key_text == "frames" && walker_.step('[')) return ok_status();
    const std::optional<std::string_view> text = walker_.value();
    if (!text) return unfinished(fmt::format("{}: {}", name(), key_text));
    Result<Json> value = parse_json(*text);
    if (!value) {
      return Error{value.error().code,
                   fmt::format("{}: {}: {}", name(), key_text, value.error().message)};
    }
    const Status status = member(key_text, std::move(value).value());
    if (!status) return status.error();
    if (!walker_.step(',')) {
      return Error{ErrorCode::bad_format,
                   fmt::format("{}: expected an array \"frames\", found none", name())};
    }
  }
}

Result<std::optional<Json>> FrameArray::next(Warnings& warnings) {
  if (state_ == State::after_last) return std::optional<Json>();
  if (walker_.step(']')) {
    const Status finished = finish(warnings);
    if (!finished) return finished.error();
    return std::optional<Json>();
  }
  if (state_ == State::between && !walker_.step(',')) {
    if (!walker_.look()) return cut_off(warnings);
    return Error{ErrorCode::bad_format,
                 fmt::format("{}: expected a comma or the array's end after it", place())};
  }
  state_ = State::between;
  ++count_;
  const std::optional<std::string_view> text = walker_.value();
  if (!text) return cut_off(warnings);
  Result<Json> value = parse_json(*text);
  if (!value) {
    return Error{value.error().code, fmt::format("{}: {}", place(), value.error().message)};
  }
  return std::optional<Json>(std::move(value).value());
}

Result<std::optional<Json>> FrameArray::cut_off(Warnings& warnings) {
  state_ = State::after_last;
  if (source_->failure() || walker_.too_long()) return unfinished(place());
  if (walker_.look()) {
    return Error{ErrorCode::bad_format, fmt::format("{}: expected a value", place())};
  }
  warnings.add(Oddity::cut_off,
               fmt::format("{}: cut off here; what is not whole is left out", place()));
  return std::optional<Json>();
}

Status FrameArray::finish(Warnings& warnings) {
  state_ = State::after_last;
  bool whole = true;
  if (in_object_) {
    while (walker_.step(',')) {
      const std::optional<std::string_view> key = walker_.value();
      if (key == R"("frames")") {
        return Error{ErrorCode::bad_format,
                     fmt::format("{}: expected one array \"frames\", found a second", name())};
      }
      if (!key || !walker_.step(':') || !walker_.skip_value()) break;
    }
    whole = walker_.step('}');
  }
  const std::optional<char> next = walker_.look();
  if (source_->failure()) return *source_->failure();
  if (next) {
    return Error{ErrorCode::bad_format,
                 fmt::format("{}: expected the {} end after the frames, found '{}'", name(),
                             whole ? "file's" : "object's", *next)};
  }
  if (!whole) {
    warnings.add(Oddity::cut_off, fmt::format("{}: cut off after the frames", name()));
  }
  return ok_status();
}

}  // namespace nade::io
