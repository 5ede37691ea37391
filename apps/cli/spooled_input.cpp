#include "spooled_input.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "command_files.h"

namespace nade::cli {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

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
  const File from(name == kStandardStream ? ::fdopen(::dup(STDIN_FILENO), "rb")
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
  input.ours_ = true;
  std::FILE* const file = ::fdopen(descriptor, "wb");
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
  if (std::fclose(file) != 0 || !written) return unwritable();
  return input;
}

SpooledInput SpooledInput::unspooled(const std::string& name) { return SpooledInput(name); }

SpooledInput::SpooledInput(SpooledInput&& other) noexcept
    : name_(std::move(other.name_)),
      path_(std::move(other.path_)),
      ours_(std::exchange(other.ours_, false)) {}

SpooledInput& SpooledInput::operator=(SpooledInput&& other) noexcept {
  std::swap(name_, other.name_);
  std::swap(path_, other.path_);
  std::swap(ours_, other.ours_);
  return *this;
}

SpooledInput::~SpooledInput() {
  if (ours_) ::unlink(path_.c_str());
}

std::string SpooledInput::renamed(std::string sentence) const {
  const std::size_t at = ours_ ? sentence.find(path_) : std::string::npos;
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
