#pragma once

#include <string>
#include <string_view>

#include "nade/status.h"

namespace nade {

/// The path of a file that comes with the product ("dog.glb", "hands/left.glb"): under the folder
/// that the environment variable NADE_ASSETS names, or else under ../share/nade as seen from the
/// running program. The error says where it was looked for.
[[nodiscard]] Result<std::string> find_asset(std::string_view relative);

}  // namespace nade
