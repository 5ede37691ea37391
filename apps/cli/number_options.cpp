#include "number_options.h"

#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace nade::cli {
namespace {

std::optional<std::uint64_t> whole_from(std::string_view text) {
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, number);
  if (code != std::errc{} || stop != end) return std::nullopt;
  return number;
}

struct Bounds {
  std::uint64_t low = 0;
  std::uint64_t high = 0;
};

CLI::Validator whole(const Bounds& bounds, const std::string& expected, const std::string& help) {
  return CLI::Validator(
      [=](std::string& text) {
        const std::optional<std::uint64_t> number = whole_from(text);
        if (!number || *number < bounds.low || *number > bounds.high) {
          return fmt::format("expected {}, found '{}'", expected, text);
        }
        text = std::to_string(*number);
        return std::string();
      },
      help);
}

}  // namespace

CLI::Validator number_in(double low, double high) {
  const std::string range = fmt::format("{} to {}", low, high);
  return CLI::Validator(
      [=](const std::string& text) {
        double number = 0.0;
        const bool fits =
            CLI::detail::lexical_cast(text, number) && number >= low && number <= high;
        return fits ? std::string()
                    : fmt::format("expected a number from {}, found '{}'", range, text);
      },
      range);
}

CLI::Validator whole_number_in(std::uint64_t low, std::uint64_t high) {
  const std::string range = fmt::format("{} to {}", low, high);
  return whole({low, high}, "a whole number from " + range, range);
}

CLI::Validator whole_number() {
  return whole({0, std::numeric_limits<std::uint64_t>::max()}, "a whole number", "");
}

}  // namespace nade::cli
