#include "byte_source.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace nade::io {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 18;

gzFile as_gz(void* stream) { return static_cast<gzFile>(stream); }

Error cannot_open(const std::string& path, int error_number) {
  if (error_number == ENOENT) {
    return {ErrorCode::not_found,
            fmt::format("{}: expected a recording, found no such file", path)};
  }
  return {ErrorCode::unreadable,
          fmt::format("{}: expected a readable file, but: {}", path, std::strerror(error_number))};
}

}  // namespace

void ByteSource::Closer::operator()(void* stream) const { ::gzclose_r(as_gz(stream)); }

ByteSource::ByteSource(std::string name, void* stream)
    : name_(std::move(name)), stream_(stream), buffer_(kBufferBytes) {}

Result<ByteSource> ByteSource::open(const std::string& path) {
  const bool standard_input = path == "-";
  std::string name = standard_input ? "standard input" : path;
  const int descriptor =
      standard_input ? ::dup(STDIN_FILENO) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return cannot_open(name, errno);
  struct stat info {};
  if (::fstat(descriptor, &info) == 0 && S_ISDIR(info.st_mode)) {
    ::close(descriptor);
    return cannot_open(name, EISDIR);
  }
  gzFile stream = ::gzdopen(descriptor, "rb");
  if (stream == nullptr) {
    ::close(descriptor);
    return cannot_open(name, ENOMEM);
  }
  ::gzbuffer(stream, kBufferBytes / 2);
  ByteSource source(std::move(name), stream);
  if (source.peek(kByteOrderMark.size()) == kByteOrderMark) source.begin_ += kByteOrderMark.size();
  if (source.failure_) return *source.failure_;
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
  errno = 0;
  const int count = ::gzread(as_gz(stream_.get()), buffer_.data() + end_,
                             static_cast<unsigned>(buffer_.size() - end_));
  if (count > 0) {
    end_ += static_cast<std::size_t>(count);
    return true;
  }
  const int error_number = errno;
  int code = Z_OK;
  ::gzerror(as_gz(stream_.get()), &code);
  if (code == Z_BUF_ERROR) {
    cut_off_ = true;
  } else if (code == Z_ERRNO) {
    failure_ = cannot_open(name_, error_number);
  } else if (code != Z_OK && code != Z_STREAM_END) {
    failure_ = Error{ErrorCode::unreadable,
                     fmt::format("{}: expected whole gzip data, found them damaged", name_)};
  }
  return false;
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
