#pragma once

// Readers of single mesh formats. They name the line or element where a file goes wrong or ends
// too early, which a general importer does not.

#include <string>
#include <string_view>

#include "nade/io/mesh_file.h"
#include "nade/mesh.h"
#include "nade/status.h"

namespace nade::io {

/// A mesh file's whole content, and its name for messages.
struct MeshText {
  const std::string& path;
  std::string_view content;
};

[[nodiscard]] Result<TriangleSoup> read_obj(const MeshText& file);
[[nodiscard]] Result<TriangleSoup> read_off(const MeshText& file);
[[nodiscard]] Result<TriangleSoup> read_ply(const MeshText& file);
[[nodiscard]] Result<TriangleSoup> read_stl(const MeshText& file);
/// .glb and .gltf, as a viewer shows it before any animation: bones and morph weights where the
/// file leaves them.
[[nodiscard]] Result<MeshFile> read_gltf(const std::string& path);

}  // namespace nade::io
