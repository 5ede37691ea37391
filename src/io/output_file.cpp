#include "nade/io/output_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "nade/io/mesh_file.h"
#include "operating_system.h"

namespace nade {
namespace {

namespace fs = std::filesystem;

constexpr unsigned kBufferBytes = 1U << 17;
constexpr int kNameTries = 100;
constexpr int kLinkTries = 40;
/// Of a new file, less what the umask takes away.
constexpr fs::perms kReadAndWrite = static_cast<fs::perms>(0666);

std::string shown(const std::string& path) { return path == "-" ? "standard output" : path; }

Error unwritable(const std::string& path, std::string_view why) {
  return {ErrorCode::unwritable,
          fmt::format("{}: expected to write the output, but: {}", shown(path), why)};
}
Error unwritable(const std::string& path, int error_number) {
  return unwritable(path, std::strerror(error_number));
}

/// Where the file really lies, or will, so that a link is written through and not replaced.
std::string resolved(const std::string& path) {
  std::error_code none;
  fs::path target = fs::canonical(path, none);
  if (!none) return target.string();
  target = path;
  for (int i = 0; i < kLinkTries && !fs::exists(target, none); ++i) {
    const fs::path next = fs::read_symlink(target, none);
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

fs::path folder_of(const std::string& target) {
  const fs::path folder = fs::path(target).parent_path();
  return folder.empty() ? "." : folder;
}

/// Calls `make` with names beside `target` until it has made something under one of them; that
/// name, or empty with errno set. They do not hold the target's own, which may be as long as a
/// name can be.
template <class Make>
std::string make_beside(const std::string& target, Make&& make) {
  for (int attempt = 0; attempt < kNameTries; ++attempt) {
    const fs::path name =
        folder_of(target) / fmt::format("nade-{}-{}.part", os::process_number(), attempt);
    if (make(name.string())) return name.string();
    if (errno != EEXIST) break;
  }
  return {};
}

/// A file without a name, which goes with the program however that ends; no value where the
/// system has no such thing.
std::optional<OpenedFile> open_nameless(const std::string& target, fs::perms permissions) {
  const int descriptor = os::create_nameless(folder_of(target), permissions);
  if (descriptor < 0) return std::nullopt;
  const int second = os::duplicate(descriptor);
  if (second >= 0) return OpenedFile{descriptor, target, {}, second};
  os::close(descriptor);
  return std::nullopt;
}

Result<OpenedFile> open_beside(const std::string& path, const std::string& target,
                               fs::perms permissions) {
  if (auto nameless = open_nameless(target, permissions)) return *std::move(nameless);
  int descriptor = -1;
  std::string temporary = make_beside(target, [&](const std::string& name) {
    descriptor = os::create(name, permissions);
    return descriptor >= 0;
  });
  if (descriptor < 0) return unwritable(path, errno);
  return OpenedFile{descriptor, target, std::move(temporary)};
}

Result<OpenedFile> open_at_once(const std::string& path) {
  const int descriptor = os::create(path, kReadAndWrite);
  if (descriptor < 0) return unwritable(path, errno);
  return OpenedFile{descriptor, path};
}

Result<OpenedFile> open_for_writing(const std::string& path) {
  if (path == "-") {
    const int descriptor = os::standard_output();
    if (descriptor < 0) return unwritable(path, errno);
    return OpenedFile{descriptor, path};
  }
  const std::string target = resolved(path);
  std::error_code failure;
  const fs::file_status there = fs::status(target, failure);
  if (there.type() == fs::file_type::not_found) return open_beside(path, target, kReadAndWrite);
  if (failure) return unwritable(path, failure.message());
  if (fs::is_directory(there)) return unwritable(path, EISDIR);
  if (!fs::is_regular_file(there)) {
    const int descriptor = os::open_to_write(target);
    if (descriptor < 0) return unwritable(path, errno);
    return OpenedFile{descriptor, target};
  }
  // A rename would replace a file that its owner made read-only.
  if (!os::may_write(target)) return unwritable(path, errno);
  // Nobody may read it who may not read what it replaces.
  const fs::perms permissions = there.permissions() & fs::perms::all;
  Result<OpenedFile> file = open_beside(path, target, permissions);
  if (file) os::set_permissions(file->descriptor, permissions);  // what the umask took away
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
    if (file.nameless >= 0) os::close(file.nameless);
    file.nameless = -1;
    if (file.temporary.empty()) return;
    std::error_code gone_already;
    fs::remove(file.temporary, gone_already);
    file.temporary.clear();
  }
  /// Gives a file without a name one beside its place, since only a name can replace another.
  [[nodiscard]] bool name_temporary() {
    if (file.nameless < 0) return true;
    file.temporary = make_beside(
        file.target, [&](const std::string& name) { return os::give_name(file.nameless, name); });
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
    os::close(impl->file.descriptor);
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
  const int kept = to_be_renamed ? os::duplicate(file.descriptor) : -1;
  errno = 0;
  bool written = ::gzclose_w(impl_->stream) == Z_OK;
  impl_->stream = nullptr;
  // What has its name has its content too, even where the machine stops.
  if (to_be_renamed) written = written && os::sync(kept);
  const int error_number = errno != 0 ? errno : EIO;
  if (kept >= 0) os::close(kept);
  if (!written) {
    impl_->remove_temporary();
    return unwritable(impl_->path, error_number);
  }
  if (!to_be_renamed) return ok_status();
  std::error_code failure;
  if (!impl_->name_temporary()) {
    failure.assign(errno, std::generic_category());
  } else {
    fs::rename(file.temporary, file.target, failure);
  }
  if (failure) {
    impl_->remove_temporary();
    return unwritable(impl_->path, failure.message());
  }
  file.temporary.clear();
  impl_->remove_temporary();
  os::sync_folder(folder_of(file.target));
  return ok_status();
}

std::string content_ending_of(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".gz" ? ending_of(fs::path(path).stem().string()) : ending;
}

Status write_whole(const std::string& path, std::string_view text) {
  Result<OutputFile> file = OutputFile::create(path, OutputFile::encoding_of(path));
  if (!file) return file.error();
  const Status written = file->write(text);
  if (!written) return written;
  return file->finish();
}

}  // namespace nade
