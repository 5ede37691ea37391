#include "nade/io/assets.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "operating_system.h"

namespace nade {

Result<std::string> find_asset(std::string_view relative) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::path folder;
  const char* const chosen = std::getenv("NADE_ASSETS");
  if (chosen != nullptr && *chosen != '\0') {
    folder = chosen;
  } else {
    folder = os::program_file().parent_path().parent_path() / "share" / "nade";
  }
  const fs::path file = folder / relative;
  if (fs::exists(file, error)) return file.string();
  return Error{ErrorCode::not_found,
               fmt::format("{}: not found in {} (NADE_ASSETS names another folder to look in)",
                           relative, folder.string())};
}

}  // namespace nade
