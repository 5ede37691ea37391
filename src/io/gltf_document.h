#pragma once

#include <string>
#include <string_view>

#include "nade/status.h"

namespace nade::gltf {

/// Refuses a .glb or .gltf file, given whole, for what tinygltf would pass over or not put clearly:
/// another version, an extension that must be understood and is not, numbers that are none.
[[nodiscard]] Status check_document(const std::string& path, std::string_view bytes);

}  // namespace nade::gltf
