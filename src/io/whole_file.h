#pragma once

#include <string>

#include "nade/status.h"

namespace nade::io {

/// All that is in a file, as it is.
[[nodiscard]] Result<std::string> read_whole(const std::string& path);

}  // namespace nade::io
