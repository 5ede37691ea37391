#pragma once

#include <string>
#include <string_view>

namespace nade {

/// A field of a table of comma-separated values, quoted where it has to be (RFC 4180).
[[nodiscard]] std::string csv_field(std::string_view text);

}  // namespace nade
