#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "operating_system.h"

namespace nade::os {
namespace {

mode_t mode_of(std::filesystem::perms permissions) { return static_cast<mode_t>(permissions); }

std::string by_descriptor(int descriptor) { return fmt::format("/proc/self/fd/{}", descriptor); }

}  // namespace

int open_to_read(const std::string& path) { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC); }

int open_to_write(const std::string& path) { return ::open(path.c_str(), O_WRONLY | O_CLOEXEC); }

int create(const std::string& path, std::filesystem::perms permissions) {
  return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode_of(permissions));
}

#ifdef O_TMPFILE
int create_nameless(const std::filesystem::path& folder, std::filesystem::perms permissions) {
  const int descriptor =
      ::open(folder.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, mode_of(permissions));
  if (descriptor < 0 || ::access(by_descriptor(descriptor).c_str(), F_OK) == 0) return descriptor;
  ::close(descriptor);
  return -1;
}
#else
int create_nameless(const std::filesystem::path& /*folder*/, std::filesystem::perms /*p*/) {
  errno = ENOTSUP;
  return -1;
}
#endif

bool give_name(int nameless, const std::string& path) {
  return ::linkat(AT_FDCWD, by_descriptor(nameless).c_str(), AT_FDCWD, path.c_str(),
                  AT_SYMLINK_FOLLOW) == 0;
}

int standard_input() { return duplicate(STDIN_FILENO); }
int standard_output() { return duplicate(STDOUT_FILENO); }
int duplicate(int descriptor) { return ::fcntl(descriptor, F_DUPFD_CLOEXEC, 0); }
void close(int descriptor) { ::close(descriptor); }

std::ptrdiff_t read(int descriptor, void* to, std::size_t room) {
  ssize_t count = -1;
  do {
    count = ::read(descriptor, to, room);
  } while (count < 0 && errno == EINTR);
  return count;
}

bool sync(int descriptor) { return ::fsync(descriptor) == 0; }

void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  static_cast<void>(::fsync(descriptor));
  ::close(descriptor);
}

void set_permissions(int descriptor, std::filesystem::perms permissions) {
  static_cast<void>(::fchmod(descriptor, mode_of(permissions)));
}

bool may_write(const std::string& path) { return ::access(path.c_str(), W_OK) == 0; }

bool may_enter(const std::filesystem::path& folder) {
  return ::access(folder.c_str(), R_OK | X_OK) == 0;
}

bool make_own_folder(std::string& pattern) { return ::mkdtemp(pattern.data()) != nullptr; }

PassingFile make_passing_file(std::string pattern) {
  const int descriptor = ::mkstemp(pattern.data());
  if (descriptor < 0) return {nullptr, pattern};
  ::unlink(pattern.c_str());
  std::FILE* const stream = ::fdopen(descriptor, "wb");
  if (stream != nullptr) return {stream, by_descriptor(descriptor)};
  ::close(descriptor);
  return {nullptr, pattern};
}

std::filesystem::path program_file() {
  std::error_code unknown;
  return std::filesystem::read_symlink("/proc/self/exe", unknown);
}

int process_number() { return ::getpid(); }

bool person_looks() { return ::isatty(STDERR_FILENO) == 1; }

void prepare_streams() {}

}  // namespace nade::os
