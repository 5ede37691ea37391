#include "frame_stream.h"

#include <fmt/format.h>

#include <algorithm>

#include "sketch_reader.h"

namespace nade::io {
namespace {

/// Enough to find "frames" behind what describes them.
constexpr std::size_t kStreamLookAhead = std::size_t{1} << 16;

}  // namespace

std::string JsonLines::place() const { return fmt::format("{}: line {}", name(), line_); }

Result<std::optional<Json>> JsonLines::next(Warnings& warnings) {
  std::optional<Line> line;
  do {
    line = source_.read_line();
    if (source_.failure()) return *source_.failure();
    if (!line) {
      if (source_.cut_off()) {
        warnings.add(Oddity::cut_off, fmt::format("{}: cut off after it", place()));
      }
      return std::optional<Json>();
    }
    ++line_;
  } while (std::all_of(line->text.begin(), line->text.end(), is_space));
  Result<Json> value = parse_json(line->text);
  if (value) return std::optional<Json>(std::move(value).value());
  if (line->terminated) {
    return Error{value.error().code, fmt::format("{}: {}", place(), value.error().message)};
  }
  warnings.add(Oddity::cut_off, fmt::format("{}: cut off here; the line is left out", place()));
  return std::optional<Json>();
}

Result<FrameStream> FrameStream::open(ByteSource source, const FrameArray::Member& member) {
  const Sketch sketch = sketch_of(source.peek(kStreamLookAhead));
  const Sketch::Member* const frames = sketch.find("frames");
  const bool is_array = sketch.begins.starts_with('[');
  if (!is_array && (frames == nullptr || !frames->begins.starts_with('['))) {
    return FrameStream(JsonLines(std::move(source)));
  }
  FrameArray array(std::move(source));
  const Status entered = array.enter(member);
  if (!entered) return entered.error();
  return FrameStream(std::move(array));
}

Result<std::optional<Json>> FrameStream::next(Warnings& warnings) {
  return std::visit([&](auto& frames) { return frames.next(warnings); }, frames_);
}

const std::string& FrameStream::name() const {
  return std::visit([](const auto& frames) -> const std::string& { return frames.name(); },
                    frames_);
}

std::string FrameStream::place() const {
  return std::visit([](const auto& frames) { return frames.place(); }, frames_);
}

}  // namespace nade::io
