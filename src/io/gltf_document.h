#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "json_text.h"
#include "nade/status.h"

namespace nade::gltf {

/// Repeats a node's mesh. It is not read; the nodes that have it keep its name.
inline constexpr std::string_view kInstancing = "EXT_mesh_gpu_instancing";

/// A .glb or .gltf file taken apart, with nothing of it left that we do not use.
// Json moves as noexcept does, whatever its own checks might throw.
// NOLINTNEXTLINE(bugprone-exception-escape)
struct Document {
  io::Json json;                     ///< without pictures, extras, and what the buffers' uris were
  std::vector<std::string> buffers;  ///< each as long as the file says
  io::Json pictures;                 ///< its "images"; an array
};

/// Takes a file apart, given whole. Refuses what tinygltf would pass over or not put clearly:
/// another version, an extension that must be understood and is not, numbers that are none,
/// buffers that are not there, values nested too deep.
[[nodiscard]] Result<Document> read_document(const std::string& path, std::string_view bytes);

}  // namespace nade::gltf
