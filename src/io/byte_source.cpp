#include "byte_source.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "lz_text.h"
#include "operating_system.h"

namespace nade::io {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 18;
constexpr std::size_t kLzLookAhead = 64;

/// Text of hands that move becomes ten times smaller, of one that lies still a hundred times.
constexpr std::size_t kMostRatio = 200;
constexpr std::size_t kMostUnpacked = std::size_t{64} << 20;  // before that is looked at

bool is_bomb(std::size_t unpacked, std::size_t packed) {
  return unpacked > kMostUnpacked && unpacked / kMostRatio > packed;
}

Error cannot_open(const std::string& path, int error_number) {
  if (error_number == ENOENT) {
    return {ErrorCode::not_found,
            fmt::format("{}: expected a recording, found no such file", path)};
  }
  return {ErrorCode::unreadable,
          fmt::format("{}: expected a readable file, but: {}", path, std::strerror(error_number))};
}

}  // namespace

/// Takes gzip off what a descriptor gives. zlib's own files end without a word where something else
/// follows a member.
class ByteSource::Unpacker {
 public:
  /// How a read ended.
  enum class End { more, whole, cut_off, damaged, bomb, unreadable };

  explicit Unpacker(int descriptor) : descriptor_(descriptor), input_(kBufferBytes / 2) {}
  Unpacker(const Unpacker&) = delete;
  Unpacker& operator=(const Unpacker&) = delete;
  ~Unpacker() {
    ::inflateEnd(&stream_);
    os::close(descriptor_);
  }

  /// Moves up to `room` bytes to `to`, at least one where there are `more`; `count` is how many.
  /// errno says why something is unreadable.
  [[nodiscard]] End read(char* to, std::size_t room, std::size_t& count) {
    count = 0;
    if (form_ == Form::unknown && !tell_form()) return End::unreadable;
    if (form_ == Form::plain) {
      if (stream_.avail_in == 0 && !read_on()) return End::unreadable;
      count = std::min(room, std::size_t{stream_.avail_in});
      std::copy_n(stream_.next_in, count, to);
      skip(count);
      return count > 0 ? End::more : End::whole;
    }
    stream_.next_out = reinterpret_cast<Bytef*>(to);
    stream_.avail_out = static_cast<uInt>(room);
    while (true) {
      if (stream_.avail_in == 0 && !read_on()) return End::unreadable;
      if (stream_.avail_in == 0) return form_ == Form::member ? End::cut_off : End::whole;
      if (form_ == Form::between && *stream_.next_in == 0) form_ = Form::padding;
      if (form_ == Form::padding) {
        if (*stream_.next_in != 0) return End::damaged;
        skip(1);
        continue;
      }
      if (form_ == Form::between) ::inflateReset(&stream_);
      form_ = Form::member;
      const int code = ::inflate(&stream_, Z_NO_FLUSH);
      if (code == Z_STREAM_END) form_ = Form::between;
      // What came out right before damage is likely damaged too.
      if (code != Z_OK && code != Z_STREAM_END) return End::damaged;
      count = room - stream_.avail_out;
      unpacked_ += count;
      if (is_bomb(unpacked_, packed_)) return End::bomb;
      if (count > 0) return End::more;
    }
  }

 private:
  enum class Form { unknown, plain, member, between, padding };

  void skip(std::size_t count) {
    stream_.next_in += count;
    stream_.avail_in -= static_cast<uInt>(count);
  }
  /// Reads behind what there is already; no more bytes at the end.
  [[nodiscard]] bool read_on() {
    if (stream_.avail_in == 0) stream_.next_in = input_.data();
    Bytef* const end = stream_.next_in + stream_.avail_in;
    const std::ptrdiff_t count =
        os::read(descriptor_, end, static_cast<std::size_t>(input_.data() + input_.size() - end));
    if (count > 0) stream_.avail_in += static_cast<uInt>(count);
    if (count > 0) packed_ += static_cast<std::size_t>(count);
    return count >= 0;
  }
  [[nodiscard]] bool tell_form() {
    uInt before = 0;
    do {
      before = stream_.avail_in;
      if (!read_on()) return false;
    } while (stream_.avail_in < kMagic.size() && stream_.avail_in > before);
    const bool gzip = stream_.avail_in >= kMagic.size() &&
                      std::equal(kMagic.begin(), kMagic.end(), stream_.next_in);
    form_ = gzip ? Form::member : Form::plain;
    if (!gzip || ::inflateInit2(&stream_, kGzipWindow) == Z_OK) return true;
    errno = ENOMEM;
    return false;
  }

  static constexpr std::array<Bytef, 2> kMagic{0x1F, 0x8B};
  static constexpr int kGzipWindow = 15 + 16;  // zlib's: the largest window, with gzip around it
  int descriptor_;
  std::size_t packed_ = 0;
  std::size_t unpacked_ = 0;
  std::vector<Bytef> input_;
  z_stream stream_{};
  Form form_ = Form::unknown;
};

/// LZString taken off what comes out of the unpacker.
struct ByteSource::LzLayer {
  explicit LzLayer(std::string_view beginning) : bytes(beginning), packed(bytes) {}

  LzText lz;
  std::string bytes;
  std::string_view packed;  ///< of them what is not yet unpacked
  std::string text;
  std::size_t given = 0;  ///< of the text
  std::size_t packed_count = 0;
  std::size_t unpacked_count = 0;
};

ByteSource::ByteSource(std::string name, int descriptor)
    : name_(std::move(name)),
      unpacker_(std::make_unique<Unpacker>(descriptor)),
      buffer_(kBufferBytes) {}
ByteSource::ByteSource(ByteSource&&) noexcept = default;
ByteSource& ByteSource::operator=(ByteSource&&) noexcept = default;
ByteSource::~ByteSource() = default;

Result<ByteSource> ByteSource::open(const std::string& path) {
  const bool standard_input = path == "-";
  std::string name = standard_input ? "standard input" : path;
  const int descriptor = standard_input ? os::standard_input() : os::open_to_read(path);
  if (descriptor < 0) return cannot_open(name, errno);
  ByteSource source(std::move(name), descriptor);
  if (source.peek(kByteOrderMark.size()) == kByteOrderMark) source.begin_ += kByteOrderMark.size();
  if (source.failure_) return *source.failure_;
  if (!looks_like_lz_text(source.peek(kLzLookAhead))) return source;
  source.lz_ = std::make_unique<LzLayer>(
      std::string_view(source.buffer_.data() + source.begin_, source.end_ - source.begin_));
  source.lz_->packed_count = source.end_ - source.begin_;
  source.begin_ = source.end_ = 0;
  return source;
}

bool ByteSource::fill() {
  if (failure_) return false;
  if (begin_ > 0) {
    std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
              buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
    end_ -= begin_;
    begin_ = 0;
  }
  char* const to = buffer_.data() + end_;
  const std::size_t room = buffer_.size() - end_;
  const std::size_t count = lz_ ? read_lz(to, room) : read_unpacked(to, room);
  end_ += count;
  return count > 0;
}

std::size_t ByteSource::read_unpacked(char* to, std::size_t room) {
  std::size_t count = 0;
  switch (unpacker_->read(to, room, count)) {
    case Unpacker::End::more:
      return count;
    case Unpacker::End::whole:
      break;
    case Unpacker::End::cut_off:
      cut_off_ = true;
      break;
    case Unpacker::End::damaged:
      failure_ = Error{ErrorCode::unreadable,
                       fmt::format("{}: expected whole gzip data, found them damaged", name_)};
      break;
    case Unpacker::End::bomb:
      failure_ = Error{ErrorCode::bad_format,
                       fmt::format("{}: expected a recording, found gzip data that unpack to more "
                                   "than {} times their size",
                                   name_, kMostRatio)};
      break;
    case Unpacker::End::unreadable:
      failure_ = cannot_open(name_, errno);
      break;
  }
  return 0;
}

std::size_t ByteSource::read_lz(char* to, std::size_t room) {
  LzLayer& layer = *lz_;
  const auto fail = [&](ErrorCode code, const std::string& sentence) {
    failure_ = Error{code, fmt::format("{}: {}", name_, sentence)};
    return std::size_t{0};
  };
  while (layer.given == layer.text.size()) {
    layer.text.clear();
    layer.given = 0;
    if (layer.packed.empty()) {
      layer.bytes.resize(kBufferBytes);
      layer.bytes.resize(read_unpacked(layer.bytes.data(), layer.bytes.size()));
      layer.packed = layer.bytes;
      layer.packed_count += layer.bytes.size();
      if (layer.bytes.empty()) {
        if (!failure_ && !layer.lz.whole()) cut_off_ = true;
        return 0;
      }
    }
    const LzText::End end = layer.lz.read(layer.packed, layer.text, kBufferBytes);
    layer.unpacked_count += layer.text.size();
    if (end == LzText::End::damaged) {
      return fail(ErrorCode::unreadable, "expected whole LZString data, found them damaged");
    }
    if (end == LzText::End::too_many_words) {
      return fail(ErrorCode::bad_format,
                  fmt::format("expected LZString data of at most {} words, found more",
                              LzText::kMostWords));
    }
    if (is_bomb(layer.unpacked_count, layer.packed_count)) {
      return fail(ErrorCode::bad_format,
                  fmt::format("expected a recording, found LZString data that unpack to more than "
                              "{} times their size",
                              kMostRatio));
    }
  }
  const std::size_t count = std::min(room, layer.text.size() - layer.given);
  std::copy_n(layer.text.data() + layer.given, count, to);
  layer.given += count;
  return count;
}

std::string_view ByteSource::peek(std::size_t count) {
  count = std::min(count, buffer_.size());
  while (end_ - begin_ < count && fill()) {
  }
  return {buffer_.data() + begin_, std::min(count, end_ - begin_)};
}

std::optional<Line> ByteSource::read_line() {
  line_.clear();
  bool terminated = false;
  while (!terminated && (begin_ < end_ || fill())) {
    const char* start = buffer_.data() + begin_;
    const void* newline = std::memchr(start, '\n', end_ - begin_);
    terminated = newline != nullptr;
    const auto length = terminated
                            ? static_cast<std::size_t>(static_cast<const char*>(newline) - start)
                            : end_ - begin_;
    line_.append(start, length);
    begin_ += length + (terminated ? 1 : 0);
    if (line_.size() > kLongestLine) {
      failure_ = Error{ErrorCode::bad_format,
                       fmt::format("{}: line {}: expected at most {} MiB in a line, found more",
                                   name_, lines_read_ + 1, kLongestLine >> 20)};
      return std::nullopt;
    }
  }
  if (failure_ || (!terminated && line_.empty())) return std::nullopt;
  ++lines_read_;
  return Line{line_, terminated};
}

}  // namespace nade::io
