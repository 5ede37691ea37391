#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "nade/status.h"

namespace nade::cli {

/// What `inspect` says of a mesh file: its meshes, size, animations and what is odd about it.
[[nodiscard]] Result<nlohmann::ordered_json> inspect_model(const std::string& path);
/// The same for a person.
[[nodiscard]] std::string model_as_text(const nlohmann::ordered_json& report);

}  // namespace nade::cli
