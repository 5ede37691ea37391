#include "nade/io/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "nade/io/mesh_file.h"

namespace nade {
namespace {

constexpr unsigned kBufferBytes = 1U << 17;
constexpr int kNameTries = 100;
constexpr int kLinkTries = 40;
constexpr mode_t kNewFileMode = 0666;  // less what the umask takes away
constexpr mode_t kPermissions = 0777;

std::string shown(const std::string& path) { return path == "-" ? "standard output" : path; }

Error unwritable(const std::string& path, int error_number) {
  return {ErrorCode::unwritable, fmt::format("{}: expected to write the output, but: {}",
                                             shown(path), std::strerror(error_number))};
}

/// Where the file really lies, or will, so that a link is written through and not replaced.
std::string resolved(const std::string& path) {
  if (char* real = ::realpath(path.c_str(), nullptr); real != nullptr) {
    std::string result = real;
    std::free(real);
    return result;
  }
  std::filesystem::path target = path;
  std::error_code none;
  for (int i = 0; i < kLinkTries && !std::filesystem::exists(target, none); ++i) {
    const std::filesystem::path next = std::filesystem::read_symlink(target, none);
    if (next.empty()) break;
    target = target.parent_path() / next;
  }
  return target.string();
}

/// An open file to write to, and where it is to be renamed from.
struct OpenedFile {
  int descriptor = -1;
  std::string target;
  std::string temporary{};  ///< empty where written directly, and while it has no name
  int nameless = -1;        ///< a second descriptor, by which a file without a name gets one
};

std::filesystem::path folder_of(const std::string& target) {
  const std::filesystem::path folder = std::filesystem::path(target).parent_path();
  return folder.empty() ? "." : folder;
}

/// So that a new name outlives the machine's stopping. Not every file system can do it.
void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  static_cast<void>(::fsync(descriptor));
  ::close(descriptor);
}

/// Calls `make` with names beside `target` until it has made something under one of them; that
/// name, or empty with errno set. They do not hold the target's own, which may be as long as a
/// name can be.
template <class Make>
std::string make_beside(const std::string& target, Make&& make) {
  for (int attempt = 0; attempt < kNameTries; ++attempt) {
    std::string name = folder_of(target) / fmt::format("nade-{}-{}.part", ::getpid(), attempt);
    if (make(name.c_str())) return name;
    if (errno != EEXIST) break;
  }
  return {};
}

std::string by_descriptor(int descriptor) { return fmt::format("/proc/self/fd/{}", descriptor); }

/// A file without a name, which goes with the program however that ends; no value where the
/// system has no such thing.
std::optional<OpenedFile> open_nameless([[maybe_unused]] const std::string& target,
                                        [[maybe_unused]] mode_t mode) {
#if defined(O_TMPFILE)
  const int descriptor = ::open(folder_of(target).c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, mode);
  if (descriptor < 0) return std::nullopt;
  const int second = ::fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
  if (second >= 0 && ::access(by_descriptor(second).c_str(), F_OK) == 0) {
    return OpenedFile{descriptor, target, {}, second};
  }
  if (second >= 0) ::close(second);
  ::close(descriptor);
#endif
  return std::nullopt;
}

Result<OpenedFile> open_beside(const std::string& path, const std::string& target, mode_t mode) {
  if (auto nameless = open_nameless(target, mode)) return *std::move(nameless);
  int descriptor = -1;
  std::string temporary = make_beside(target, [&](const char* name) {
    descriptor = ::open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    return descriptor >= 0;
  });
  if (descriptor < 0) return unwritable(path, errno);
  return OpenedFile{descriptor, target, std::move(temporary)};
}

Result<OpenedFile> open_at_once(const std::string& path) {
  const int descriptor =
      ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kNewFileMode);
  if (descriptor < 0) return unwritable(path, errno);
  return OpenedFile{descriptor, path};
}

Result<OpenedFile> open_for_writing(const std::string& path) {
  if (path == "-") {
    const int descriptor = ::dup(STDOUT_FILENO);
    if (descriptor < 0) return unwritable(path, errno);
    return OpenedFile{descriptor, path};
  }
  struct stat info {};
  const std::string target = resolved(path);
  if (::stat(target.c_str(), &info) != 0) {
    if (errno != ENOENT) return unwritable(path, errno);
    return open_beside(path, target, kNewFileMode);
  }
  if (S_ISDIR(info.st_mode)) return unwritable(path, EISDIR);
  if (!S_ISREG(info.st_mode)) {
    const int descriptor = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) return unwritable(path, errno);
    return OpenedFile{descriptor, target};
  }
  // A rename would replace a file that its owner made read-only.
  if (::access(target.c_str(), W_OK) != 0) return unwritable(path, errno);
  // Nobody may read it who may not read what it replaces.
  const mode_t mode = info.st_mode & kPermissions;
  Result<OpenedFile> file = open_beside(path, target, mode);
  if (file) static_cast<void>(::fchmod(file->descriptor, mode));  // what the umask took away
  return file;
}

}  // namespace

struct OutputFile::Impl {
  std::string path;
  OpenedFile file;
  gzFile stream = nullptr;

  Impl(std::string path_in, OpenedFile file_in)
      : path(std::move(path_in)), file(std::move(file_in)) {}
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() { abandon(); }

  void remove_temporary() {
    if (file.nameless >= 0) ::close(file.nameless);
    file.nameless = -1;
    if (file.temporary.empty()) return;
    ::unlink(file.temporary.c_str());
    file.temporary.clear();
  }
  /// Gives a file without a name one beside its place, since only a name can replace another.
  [[nodiscard]] bool name_temporary() {
    if (file.nameless < 0) return true;
    const std::string nameless = by_descriptor(file.nameless);
    file.temporary = make_beside(file.target, [&](const char* name) {
      return ::linkat(AT_FDCWD, nameless.c_str(), AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0;
    });
    return !file.temporary.empty();
  }
  void abandon() {
    if (stream != nullptr) ::gzclose_w(stream);
    stream = nullptr;
    remove_temporary();
  }
};

OutputFile::Encoding OutputFile::encoding_of(const std::string& path) {
  return ending_of(path) == ".gz" ? Encoding::gzip : Encoding::plain;
}

Result<OutputFile> OutputFile::create(const std::string& path, Encoding encoding, Appears appears) {
  if (path.empty()) return Error{ErrorCode::unwritable, "expected the output's name, found none"};
  Result<OpenedFile> file =
      appears == Appears::at_once ? open_at_once(path) : open_for_writing(path);
  if (!file) return file.error();
  auto impl = std::make_unique<Impl>(path, std::move(file).value());
  // zlib's "T" writes plain bytes. Level 4 takes less than half the time of the usual 6 and makes
  // recordings 3 % larger.
  impl->stream = ::gzdopen(impl->file.descriptor, encoding == Encoding::gzip ? "wb4" : "wbT");
  if (impl->stream == nullptr) {
    ::close(impl->file.descriptor);
    return unwritable(path, ENOMEM);
  }
  ::gzbuffer(impl->stream, kBufferBytes);
  return OutputFile(std::move(impl));
}

OutputFile::OutputFile(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
OutputFile::OutputFile(OutputFile&&) noexcept = default;
OutputFile& OutputFile::operator=(OutputFile&&) noexcept = default;
OutputFile::~OutputFile() = default;

Status OutputFile::write(std::string_view bytes) {
  NADE_ASSERT(impl_ != nullptr && impl_->stream != nullptr);
  if (bytes.empty()) return ok_status();
  errno = 0;
  if (::gzfwrite(bytes.data(), 1, bytes.size(), impl_->stream) == bytes.size()) return ok_status();
  return unwritable(impl_->path, errno != 0 ? errno : EIO);
}

Status OutputFile::flush() {
  NADE_ASSERT(impl_ != nullptr && impl_->stream != nullptr);
  errno = 0;
  if (::gzflush(impl_->stream, Z_SYNC_FLUSH) == Z_OK) return ok_status();
  return unwritable(impl_->path, errno != 0 ? errno : EIO);
}

Status OutputFile::finish() {
  NADE_ASSERT(impl_ != nullptr && impl_->stream != nullptr);
  OpenedFile& file = impl_->file;
  const bool to_be_renamed = !file.temporary.empty() || file.nameless >= 0;
  const int kept = to_be_renamed ? ::fcntl(file.descriptor, F_DUPFD_CLOEXEC, 0) : -1;
  errno = 0;
  bool written = ::gzclose_w(impl_->stream) == Z_OK;
  impl_->stream = nullptr;
  // What has its name has its content too, even where the machine stops.
  if (to_be_renamed) written = written && ::fsync(kept) == 0;
  const int error_number = errno != 0 ? errno : EIO;
  if (kept >= 0) ::close(kept);
  if (!written) {
    impl_->remove_temporary();
    return unwritable(impl_->path, error_number);
  }
  if (!to_be_renamed) return ok_status();
  if (!impl_->name_temporary() || std::rename(file.temporary.c_str(), file.target.c_str()) != 0) {
    const int rename_error = errno;
    impl_->remove_temporary();
    return unwritable(impl_->path, rename_error);
  }
  file.temporary.clear();
  impl_->remove_temporary();
  sync_folder(folder_of(file.target));
  return ok_status();
}

std::string content_ending_of(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".gz" ? ending_of(std::filesystem::path(path).stem().string()) : ending;
}

Status write_whole(const std::string& path, std::string_view text) {
  Result<OutputFile> file = OutputFile::create(path, OutputFile::encoding_of(path));
  if (!file) return file.error();
  const Status written = file->write(text);
  if (!written) return written;
  return file->finish();
}

}  // namespace nade
