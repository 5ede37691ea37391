#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace nade::study {

/// How the conditions follow one another.
enum class OrderKind : std::uint8_t {
  random,  ///< shuffled anew for each participant, as in the paper
  latin,   ///< a balanced Latin square: each condition as often in each place and after each other
};

/// Which of `count` conditions comes first, second, …: the same on every machine and in every
/// version, for the same arguments. `random` depends on the whole id; in `latin` participants
/// whose ids end in consecutive numbers ("P01", "P02", …) take consecutive rows of the square, and
/// an id without a number any row.
[[nodiscard]] std::vector<std::size_t> order_of(OrderKind kind, std::size_t count,
                                                std::uint64_t study_seed,
                                                std::string_view participant);

/// A seed for whatever belongs to one participant: FNV-1a of the id's bytes, mixed with the
/// study's seed by splitmix64.
[[nodiscard]] std::uint64_t seed_of(std::uint64_t study_seed, std::string_view participant);

/// Row `row` of the balanced Latin square of `count` conditions; it has `count` rows where that is
/// even and twice as many else, and begins again after them.
[[nodiscard]] std::vector<std::size_t> latin_row(std::size_t count, std::size_t row);

}  // namespace nade::study
