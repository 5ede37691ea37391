#include "spooled_input.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

#include "command_files.h"
#include "io/operating_system.h"

namespace nade::cli {
namespace {

bool can_be_read_twice(const std::string& name) {
  std::error_code ignored;
  return name != kStandardStream && !std::filesystem::is_other(name, ignored);
}

/// Whether all of it was written. What cannot be read ends it, and whoever reads the rest says so.
bool copy(int from, std::FILE* to) {
  std::vector<char> block(1U << 16U);
  while (true) {
    const std::ptrdiff_t count = os::read(from, block.data(), block.size());
    if (count <= 0) return std::fflush(to) == 0;
    const auto size = static_cast<std::size_t>(count);
    if (std::fwrite(block.data(), 1, size, to) != size) return false;
  }
}

}  // namespace

SpooledInput::SpooledInput(const std::string& name)
    : name_(name == kStandardStream ? "standard input" : name), path_(name) {}

Result<SpooledInput> SpooledInput::open(const std::string& name) {
  SpooledInput input(name);
  if (can_be_read_twice(name)) return input;
  const int from = name == kStandardStream ? os::standard_input() : os::open_to_read(name);
  if (from < 0) {
    return Error{ErrorCode::unreadable, fmt::format("{}: expected to read it, but: {}", input.name_,
                                                    std::strerror(errno))};
  }
  std::error_code ignored;
  os::PassingFile kept = os::make_passing_file(
      (std::filesystem::temp_directory_path(ignored) / "nade-XXXXXX").string());
  input.ours_.reset(kept.stream);
  input.path_ = std::move(kept.path);
  const bool copied = kept.stream != nullptr && copy(from, kept.stream);
  const int why = errno;
  os::close(from);
  if (copied) return input;
  return Error{ErrorCode::unwritable, fmt::format("{}: expected to keep {} there, but: {}",
                                                  input.path_, input.name_, std::strerror(why))};
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
