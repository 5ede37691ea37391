#pragma once

#include <assimp/Importer.hpp>
#include <string>

#include "mesh_formats.h"
#include "nade/status.h"

namespace nade::io {

/// An .obj file's vertices, faces, groups and materials, a statement a line, in the few spellings
/// that Assimp knows: it leaves out a vertex that it does not understand, without a word, and
/// then counts all further ones wrongly. The error names the line.
[[nodiscard]] Result<std::string> plain_obj(const MeshText& file);

/// Lets `importer` find the `plain_obj` of the file at `path` in the file's place. Whoever reads
/// the file so counts the same vertices.
[[nodiscard]] Status read_as_plain_obj(Assimp::Importer& importer, const std::string& path);

}  // namespace nade::io
