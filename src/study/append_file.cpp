#include "append_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

namespace nade::study {
namespace {

constexpr mode_t kNewFileMode = 0666;  // less what the umask takes away

Error unwritable(const std::string& path, int error_number) {
  return {ErrorCode::unwritable,
          fmt::format("{}: expected to write it, but: {}", path, std::strerror(error_number))};
}

/// Writes all of it; false with errno set.
bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

Result<AppendFile> AppendFile::open(const std::string& path) {
  const int descriptor =
      ::open(path.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, kNewFileMode);
  if (descriptor < 0) return unwritable(path, errno);
  return AppendFile(path, descriptor);
}

AppendFile::AppendFile(AppendFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

AppendFile& AppendFile::operator=(AppendFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

AppendFile::~AppendFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool AppendFile::lock() { return ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0; }

Status AppendFile::append(std::string_view line, Reach reach) {
  if (!write_all(descriptor_, line)) return unwritable(path_, errno);
  if (reach == Reach::disk && ::fdatasync(descriptor_) != 0) return unwritable(path_, errno);
  return ok_status();
}

bool AppendFile::empty() const {
  struct stat info {};
  return ::fstat(descriptor_, &info) != 0 || info.st_size == 0;
}

Result<std::size_t> AppendFile::cut_torn_line() {
  struct stat info {};
  if (::fstat(descriptor_, &info) != 0) return unwritable(path_, errno);
  off_t end = info.st_size;
  for (char last = 0; end > 0; --end) {
    if (::pread(descriptor_, &last, 1, end - 1) != 1) return unwritable(path_, errno);
    if (last == '\n') break;
  }
  if (end == info.st_size) return std::size_t{0};
  if (::ftruncate(descriptor_, end) != 0 || ::fsync(descriptor_) != 0) {
    return unwritable(path_, errno);
  }
  return static_cast<std::size_t>(info.st_size - end);
}

Status sync_folder(const std::string& path) { return sync_file(path); }

Status sync_file(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return unwritable(path, errno);
  const bool synced = ::fsync(descriptor) == 0 || errno == EINVAL;
  const int error_number = errno;
  ::close(descriptor);
  return synced ? ok_status() : Status(unwritable(path, error_number));
}

Status make_folder(const std::string& path) {
  std::error_code code;
  std::filesystem::create_directories(path, code);
  if (code) return unwritable(path, code.value());
  const std::string parent = std::filesystem::path(path).parent_path().string();
  return sync_folder(parent.empty() ? "." : parent);
}

}  // namespace nade::study
