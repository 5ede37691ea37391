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

#include "command_files.h"

namespace nade::cli {
namespace {

bool can_be_read_twice(const std::string& name) {
  std::error_code ignored;
  return name != kStandardStream && !std::filesystem::is_other(name, ignored);
}

}  // namespace

SpooledInput::SpooledInput(const std::string& name)
    : name_(name == kStandardStream ? "standard input" : name), path_(name) {}

Result<SpooledInput> SpooledInput::open(const std::string& name) {
  SpooledInput input(name);
  if (can_be_read_twice(name)) return input;
  const SpooledFile from(name == kStandardStream ? ::fdopen(::dup(STDIN_FILENO), "rb")
                                                 : std::fopen(name.c_str(), "rb"));
  if (!from) {
    return Error{ErrorCode::unreadable, fmt::format("{}: expected to read it, but: {}", input.name_,
                                                    std::strerror(errno))};
  }
  std::error_code ignored;
  input.path_ = (std::filesystem::temp_directory_path(ignored) / "nade-XXXXXX").string();
  const auto unwritable = [&input] {
    return Error{ErrorCode::unwritable,
                 fmt::format("{}: expected to keep {} there, but: {}", input.path_, input.name_,
                             std::strerror(errno))};
  };
  const int descriptor = ::mkstemp(input.path_.data());
  if (descriptor < 0) return unwritable();
  std::FILE* const file = ::fdopen(descriptor, "wb");
  input.ours_.reset(file);
  // It goes with the program, however that ends.
  ::unlink(input.path_.c_str());
  if (file == nullptr) {
    ::close(descriptor);
    return unwritable();
  }
  std::vector<char> block(1U << 16U);
  bool written = true;
  while (written) {
    const std::size_t size = std::fread(block.data(), 1, block.size(), from.get());
    if (size == 0) break;
    written = std::fwrite(block.data(), 1, size, file) == size;
  }
  if (std::fflush(file) != 0 || !written) return unwritable();
  input.path_ = fmt::format("/proc/self/fd/{}", descriptor);
  return input;
}

SpooledInput SpooledInput::unspooled(const std::string& name) { return SpooledInput(name); }

std::string SpooledInput::renamed(std::string sentence) const {
  const std::size_t at = ours_ != nullptr ? sentence.find(path_) : std::string::npos;
  if (at != std::string::npos) sentence.replace(at, path_.size(), name_);
  return sentence;
}

Error SpooledInput::renamed(Error error) const {
  return {error.code, renamed(std::move(error.message))};
}

Status named(const Status& status, const SpooledInput& input) {
  return status ? status : Status(input.renamed(status.error()));
}

}  // namespace nade::cli
