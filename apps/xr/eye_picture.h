#pragma once

#include <array>
#include <optional>
#include <string>

#include "nade/draw/image.h"
#include "nade/draw/renderer.h"

namespace nade::xr {

/// What a framebuffer of the current context holds.
[[nodiscard]] draw::Image read_back(const draw::Target& target);

/// "eyes.png" gives "eyes-left.png" and "eyes-right.png".
[[nodiscard]] std::array<std::string, 2> eye_paths(const std::string& path);
/// Writes both eyes' pictures there.
[[nodiscard]] Status save_eyes(const std::string& path,
                               const std::array<std::optional<draw::Image>, 2>& eyes);

}  // namespace nade::xr
