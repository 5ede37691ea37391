#pragma once

#include <assimp/Importer.hpp>
#include <string>

#include "nade/status.h"

namespace nade::io {

/// Lets `importer` find the file at `path` in the few spellings of .obj that it knows. The error
/// names the line. Whoever reads the file so counts the same vertices.
[[nodiscard]] Status read_as_plain_obj(Assimp::Importer& importer, const std::string& path);

}  // namespace nade::io
