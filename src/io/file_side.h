#pragma once

#include <optional>
#include <string>

#include "nade/hand.h"

namespace nade::io {

/// The side that the name of a file of one hand says; folders say nothing.
[[nodiscard]] std::optional<Handedness> side_of_file(const std::string& path);

}  // namespace nade::io
