#include "nade/io/assets.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace nade {

Result<std::string> find_asset(std::string_view relative) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::path folder;
  const char* const chosen = std::getenv("NADE_ASSETS");
  if (chosen != nullptr && *chosen != '\0') {
    folder = chosen;
  } else {
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    folder = program.parent_path().parent_path() / "share" / "nade";
  }
  const fs::path file = folder / relative;
  if (fs::exists(file, error)) return file.string();
  return Error{ErrorCode::not_found,
               fmt::format("{}: not found in {} (NADE_ASSETS names another folder to look in)",
                           relative, folder.string())};
}

}  // namespace nade
