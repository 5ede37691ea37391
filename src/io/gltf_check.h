#pragma once

#include <string>
#include <string_view>

#include "json_text.h"
#include "nade/status.h"

namespace nade::gltf {

/// An array of a document, empty where it has none.
[[nodiscard]] const io::Json& list(const io::Json& object, std::string_view key);

/// Whether an extension compresses the data of what has it.
[[nodiscard]] bool is_compression(std::string_view extension);
/// The extension that an element's data are compressed by; empty where there is none.
[[nodiscard]] std::string_view compression_of(const io::Json& element);
/// The error of a file that can only be read uncompressed.
[[nodiscard]] Error compressed(const std::string& path, std::string_view by);

/// Refuses numbers that are none and meshes whose data are only there compressed: what tinygltf
/// takes for left out, or does not name.
[[nodiscard]] Status check_elements(const std::string& path, const io::Json& document);

}  // namespace nade::gltf
