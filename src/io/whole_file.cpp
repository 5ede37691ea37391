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

bool is_below_folder_of(const std::string& path, const std::string& named) {
  namespace fs = std::filesystem;
  std::error_code failure;
  const fs::path folder = fs::weakly_canonical(fs::absolute(path).parent_path(), failure);
  if (failure) return false;
  const fs::path file = fs::weakly_canonical(fs::absolute(named), failure);
  if (failure) return false;
  const fs::path from_folder = file.lexically_relative(folder);
  return !from_folder.empty() && from_folder != "." && *from_folder.begin() != "..";
}

}  // namespace nade::io
