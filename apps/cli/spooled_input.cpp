#include "spooled_input.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

namespace nade::cli {
namespace {

Error unwritable(const std::string& path) {
  return {ErrorCode::unwritable, fmt::format("{}: expected to keep standard input there, but: {}",
                                             path, std::strerror(errno))};
}

}  // namespace

Result<SpooledInput> SpooledInput::read() {
  std::error_code ignored;
  SpooledInput input;
  std::string path = (std::filesystem::temp_directory_path(ignored) / "nade-XXXXXX").string();
  const int descriptor = ::mkstemp(path.data());
  if (descriptor < 0) return unwritable(path);
  input.path_ = path;
  std::FILE* const file = ::fdopen(descriptor, "wb");
  if (file == nullptr) {
    ::close(descriptor);
    return unwritable(path);
  }
  std::vector<char> block(1U << 16U);
  bool written = true;
  while (written) {
    const std::size_t size = std::fread(block.data(), 1, block.size(), stdin);
    if (size == 0) break;
    written = std::fwrite(block.data(), 1, size, file) == size;
  }
  if (std::fclose(file) != 0 || !written) return unwritable(path);
  return input;
}

SpooledInput::SpooledInput(SpooledInput&& other) noexcept : path_(std::exchange(other.path_, {})) {}

SpooledInput& SpooledInput::operator=(SpooledInput&& other) noexcept {
  std::swap(path_, other.path_);
  return *this;
}

SpooledInput::~SpooledInput() {
  if (!path_.empty()) ::unlink(path_.c_str());
}

Error SpooledInput::renamed(Error error) const {
  const std::size_t at = error.message.find(path_);
  if (at != std::string::npos) error.message.replace(at, path_.size(), "standard input");
  return error;
}

}  // namespace nade::cli
