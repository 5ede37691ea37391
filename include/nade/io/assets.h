#pragma once

#include <string>
#include <string_view>

#include "nade/status.h"

namespace nade {

/// The path of a file or folder that comes with the product ("dog.glb", "hands/left.glb",
/// "scenes"): under the folder that the environment variable NADE_ASSETS names, or else under
/// ../share/nade as seen from the running program. The error says where it was looked for.
[[nodiscard]] Result<std::string> find_asset(std::string_view relative);

}  // namespace nade
