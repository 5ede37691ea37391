#pragma once

#include <string_view>

namespace nade::draw {

/// A file that was put into the library when it was built, by its name without folders: the
/// shaders and the font. Empty where there is none of that name.
[[nodiscard]] std::string_view embedded_file(std::string_view name);

}  // namespace nade::draw
