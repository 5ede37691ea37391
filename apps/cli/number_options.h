#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

namespace nade::cli {

/// Refuses what is no number from `low` to `high`, NaN too, which CLI::Range lets through.
[[nodiscard]] CLI::Validator number_in(double low, double high);

/// Refuses what is no whole number from `low` to `high`, in decimal digits. To be given to
/// `transform`: CLI11 takes -1 for the largest number there is, and reads 010 as 8.
[[nodiscard]] CLI::Validator whole_number_in(std::uint64_t low, std::uint64_t high);
[[nodiscard]] CLI::Validator whole_number();

}  // namespace nade::cli
