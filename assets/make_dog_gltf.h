#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "make_dog_body.h"
#include "make_dog_mesh.h"

namespace dog {

/// Writes the mesh with normals and coat colours, and the places as nodes, as binary glTF. The file
/// appears whole or not at all. What went wrong, in a sentence; nothing where it is written.
[[nodiscard]] std::optional<std::string> write_glb(const Body& body, const Mesh& mesh,
                                                   const std::vector<Place>& places,
                                                   const std::filesystem::path& path);

}  // namespace dog
