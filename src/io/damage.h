#pragma once

#include <string>

#include "nade/status.h"

namespace nade::io {

/// What is wrong with a file, where reading it failed with `error`: what comes out of damaged gzip
/// data is often read as wrong text before their checksum tells. Reads such a file to its end.
[[nodiscard]] Error damage_or(const std::string& path, Error error);

}  // namespace nade::io
