#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace nade::cli {

/// "X,Y,Z" as finite numbers; no value where it is anything else.
template <std::size_t count>
[[nodiscard]] std::optional<std::array<double, count>> parse_numbers(std::string_view text,
                                                                     char between = ',') {
  std::array<double, count> values{};
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t end_at = text.find(between);
    const bool last = i + 1 == count;
    if (last != (end_at == std::string_view::npos)) return std::nullopt;
    const std::string_view number = text.substr(0, end_at);
    const char* const end = number.data() + number.size();
    const auto [stop, code] = std::from_chars(number.data(), end, values[i]);
    if (code != std::errc{} || stop != end || !std::isfinite(values[i])) return std::nullopt;
    if (!last) text.remove_prefix(end_at + 1);
  }
  return values;
}

}  // namespace nade::cli
