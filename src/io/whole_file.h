#pragma once

#include <string>

#include "nade/status.h"

namespace nade::io {

/// All that is in a file, as it is.
[[nodiscard]] Result<std::string> read_whole(const std::string& path);

/// Whether `named`, as a file at `path` names it from where the program runs, lies below the folder
/// of `path`, symbolic links followed. So it need not be there.
[[nodiscard]] bool is_below_folder_of(const std::string& path, const std::string& named);

}  // namespace nade::io
