#pragma once

#include <string_view>

namespace nade::study {

/// "P2" before "P10": runs of digits count as numbers.
[[nodiscard]] bool natural_less(std::string_view a, std::string_view b);

}  // namespace nade::study
