#include <fcntl.h>
#include <io.h>
#include <process.h>
#include <share.h>
#include <sys/stat.h>
#include <windows.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cwchar>
#include <string_view>
#include <system_error>
#include <utility>

#include "nade/io/plain_text.h"
#include "operating_system.h"

#ifdef __MINGW32__
extern "C" size_t __wrap_mbrtowc(wchar_t* to, const char* from, size_t size, mbstate_t* state);

/// What g++'s library asks when it makes a path of a string, in place of msvcrt's, which knows no
/// UTF-8 (src/io/CMakeLists.txt). Of two units of UTF-16 the second waits in `state`.
size_t __wrap_mbrtowc(wchar_t* to, const char* from, size_t size, mbstate_t* state) {
  if (*state != 0) {
    *to = static_cast<wchar_t>(std::exchange(*state, 0));
    return 1;
  }
  std::string_view rest(from, size);
  const char32_t code = nade::next_character(rest);
  const std::size_t length = size - rest.size();
  if (code == nade::kReplacement) {
    errno = EILSEQ;
    return static_cast<size_t>(-1);
  }
  if (code <= 0xFFFF) {
    *to = static_cast<wchar_t>(code);
    return code == 0 ? 0 : length;
  }
  *to = static_cast<wchar_t>(0xD800U + ((code - 0x10000U) >> 10U));
  *state = static_cast<mbstate_t>(0xDC00U + ((code - 0x10000U) & 0x3FFU));
  return length - 1;
}
#endif

namespace nade::os {
namespace {

namespace fs = std::filesystem;

/// msvcrt's own for new files: all others may read and write, where the folder says nothing else.
constexpr int kReadAndWrite = _S_IREAD | _S_IWRITE;

UINT g_code_page_before = 0;

int errno_of_last_error() {
  switch (::GetLastError()) {
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
    case ERROR_INVALID_NAME:
    case ERROR_INVALID_DRIVE:
    case ERROR_BAD_NETPATH:
      return ENOENT;
    default:
      return EACCES;
  }
}

/// Puts letters that make a name new for the Xs at the end.
bool fill_in(std::string& pattern) { return ::_mktemp_s(pattern.data(), pattern.size() + 1) == 0; }

}  // namespace

// Others may rename and remove meanwhile what is read, as elsewhere.
int open_to_read(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    errno = EISDIR;
    return -1;
  }
  constexpr DWORD kShared = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
  const HANDLE handle = ::CreateFileW(fs::path(path).c_str(), GENERIC_READ, kShared, nullptr,
                                      OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr);
  if (handle == INVALID_HANDLE_VALUE) {
    errno = errno_of_last_error();
    return -1;
  }
  return ::_open_osfhandle(reinterpret_cast<std::intptr_t>(handle),
                           _O_RDONLY | _O_BINARY | _O_NOINHERIT);
}

int open_to_write(const std::string& path) {
  return ::_wopen(fs::path(path).c_str(), _O_WRONLY | _O_BINARY | _O_NOINHERIT);
}

int create(const std::string& path, fs::perms /*permissions*/) {
  return ::_wopen(fs::path(path).c_str(), _O_WRONLY | _O_CREAT | _O_EXCL | _O_BINARY | _O_NOINHERIT,
                  kReadAndWrite);
}

int create_nameless(const fs::path& /*folder*/, fs::perms /*permissions*/) {
  errno = ENOSYS;
  return -1;
}

bool give_name(int /*nameless*/, const std::string& /*path*/) {
  errno = ENOSYS;
  return false;
}

int standard_input() { return duplicate(::_fileno(stdin)); }
int standard_output() { return duplicate(::_fileno(stdout)); }

int duplicate(int descriptor) {
  const int second = ::_dup(descriptor);
  if (second >= 0) ::_setmode(second, _O_BINARY);
  return second;
}

void close(int descriptor) { ::_close(descriptor); }

std::ptrdiff_t read(int descriptor, void* to, std::size_t room) {
  return ::_read(descriptor, to, static_cast<unsigned>(room));
}

bool sync(int descriptor) { return ::_commit(descriptor) == 0; }

void sync_folder(const fs::path& /*folder*/) {}

void set_permissions(int /*descriptor*/, fs::perms /*permissions*/) {}

bool may_write(const std::string& path) {
  constexpr int kWrite = 2;
  return ::_waccess(fs::path(path).c_str(), kWrite) == 0;
}

bool may_enter(const fs::path& /*folder*/) { return true; }

bool make_own_folder(std::string& pattern) {
  return fill_in(pattern) && ::CreateDirectoryW(fs::path(pattern).c_str(), nullptr) != 0;
}

PassingFile make_passing_file(std::string pattern) {
  if (!fill_in(pattern)) return {nullptr, pattern};
  // D: Windows removes it when the last of its readers is gone.
  return {::_wfopen(fs::path(pattern).c_str(), L"wbD"), pattern};
}

fs::path program_file() {
  std::wstring path(MAX_PATH, L'\0');
  while (true) {
    const DWORD length =
        ::GetModuleFileNameW(nullptr, path.data(), static_cast<DWORD>(path.size()));
    if (length == 0) return {};
    if (length < path.size()) return path.substr(0, length);
    path.resize(2 * path.size());
  }
}

int process_number() { return ::_getpid(); }

bool person_looks() { return ::_isatty(::_fileno(stderr)) != 0; }

void prepare_streams() {
  for (std::FILE* const stream : {stdin, stdout, stderr}) {
    ::_setmode(::_fileno(stream), _O_BINARY);
  }
  if (!person_looks()) return;
  g_code_page_before = ::GetConsoleOutputCP();
  ::SetConsoleOutputCP(CP_UTF8);
  std::atexit([] { ::SetConsoleOutputCP(g_code_page_before); });
  const HANDLE console = ::GetStdHandle(STD_ERROR_HANDLE);
  // Without it, lines that are written over show their control characters.
  DWORD mode = 0;
  if (::GetConsoleMode(console, &mode) == 0) return;
  ::SetConsoleMode(console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
}

}  // namespace nade::os
