#pragma once

#include <string>

#include "nade/status.h"

namespace nade::io {

/// The .obj file at `path` in the few spellings that Assimp knows: it leaves out a vertex that it
/// does not understand, without a word, and then counts all further ones wrongly. The error names
/// the line.
[[nodiscard]] Result<std::string> plain_obj(const std::string& path);

}  // namespace nade::io
