#include "file_side.h"

#include <filesystem>

#include "mesh_words.h"

namespace nade::io {

std::optional<Handedness> side_of_file(const std::string& path) {
  const std::string name = lower(std::filesystem::path(path).filename().string());
  const bool left = name.find("left") != std::string::npos;
  const bool right = name.find("right") != std::string::npos;
  if (left == right) return std::nullopt;
  return left ? Handedness::left : Handedness::right;
}

}  // namespace nade::io
