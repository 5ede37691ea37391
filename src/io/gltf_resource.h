#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "nade/status.h"

namespace nade::gltf {

/// What a `uri` of a glTF file stands for.
struct Resource {
  std::string bytes;
  std::filesystem::path file;  ///< without links; empty where the uri holds the bytes itself
};

/// Reads a data URI of any type, or a file below the folder of the glTF file at `path`. A uri that
/// leads out of that folder, by "..", as an absolute path or through a link, is an error before
/// anything is opened. `where` says what names it ("buffer 0").
[[nodiscard]] Result<Resource> read_resource(const std::string& path, std::string_view where,
                                             const std::string& uri);

/// The beginning of a text of a file, fit to stand in a sentence.
[[nodiscard]] std::string shortened(std::string_view text);

}  // namespace nade::gltf
