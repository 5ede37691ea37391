#include "whole_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

namespace nade::io {

Result<std::string> read_whole(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    return Error{ErrorCode::not_found, fmt::format("{}: no such file", path)};
  }
  std::ifstream stream(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream.is_open() || stream.bad() || std::filesystem::is_directory(path, ignored)) {
    return Error{ErrorCode::unreadable, fmt::format("{}: cannot be read", path)};
  }
  return bytes;
}

}  // namespace nade::io
