#include "nade/study/order.h"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <optional>
#include <random>
#include <utility>

// Based on: E. J. Williams. Experimental designs balanced for the estimation of residual effects
// of treatments. Australian Journal of Scientific Research A 2, 1949.
// Based on: G. L. Steele, D. Lea, C. H. Flood. Fast splittable pseudorandom number generators.
// OOPSLA 2014 (splitmix64).

namespace nade::study {
namespace {

constexpr std::uint64_t kFnvOffset = 0xcbf29ce484222325ULL;
constexpr std::uint64_t kFnvPrime = 0x100000001b3ULL;

std::uint64_t mixed(std::uint64_t value) {
  value += 0x9e3779b97f4a7c15ULL;
  value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  value = (value ^ (value >> 27U)) * 0x94d049bb133111ebULL;
  return value ^ (value >> 31U);
}

/// Evenly among 0 … bound - 1. The standard's own distributions differ between its makers.
std::size_t drawn(std::mt19937_64& generator, std::size_t bound) {
  const std::uint64_t limit = generator.max() - generator.max() % bound;
  std::uint64_t value = generator();
  while (value >= limit) value = generator();
  return static_cast<std::size_t>(value % bound);
}

std::vector<std::size_t> shuffled(std::size_t count, std::uint64_t seed) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937_64 generator(seed);
  for (std::size_t left = count; left > 1; --left) {
    std::swap(order[left - 1], order[drawn(generator, left)]);
  }
  return order;
}

/// The number that an id ends in.
std::optional<std::size_t> number_of(std::string_view participant) {
  std::size_t begin = participant.size();
  while (begin > 0 && std::isdigit(static_cast<unsigned char>(participant[begin - 1])) != 0) {
    --begin;
  }
  if (begin == participant.size()) return std::nullopt;
  std::size_t number = 0;
  for (const char digit : participant.substr(begin)) {
    number = 10 * number + static_cast<std::size_t>(digit - '0');
  }
  return number;
}

}  // namespace

std::uint64_t seed_of(std::uint64_t study_seed, std::string_view participant) {
  std::uint64_t hash = kFnvOffset;
  for (const char letter : participant) {
    hash = (hash ^ static_cast<unsigned char>(letter)) * kFnvPrime;
  }
  return mixed(mixed(study_seed) ^ hash);
}

std::vector<std::size_t> latin_row(std::size_t count, std::size_t row) {
  if (count == 0) return {};
  // 0, n-1, 1, n-2, 2, …: the steps between neighbours are all different.
  std::vector<std::size_t> order(count);
  const std::size_t rows = count % 2 == 0 ? count : 2 * count;
  const std::size_t at = row % rows;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t first = i % 2 == 0 ? i / 2 : count - (i + 1) / 2;
    order[i] = (first + at) % count;
  }
  // An odd number of conditions is only balanced with each row backwards too.
  if (at >= count) std::reverse(order.begin(), order.end());
  return order;
}

std::vector<std::size_t> order_of(OrderKind kind, std::size_t count, std::uint64_t study_seed,
                                  std::string_view participant) {
  const std::uint64_t own = seed_of(study_seed, participant);
  if (kind == OrderKind::random) return shuffled(count, own);
  // Which condition is which in the square is the study's; which row, the participant's.
  const std::vector<std::size_t> names = shuffled(count, mixed(study_seed));
  const std::size_t row = number_of(participant).value_or(static_cast<std::size_t>(own >> 1U));
  std::vector<std::size_t> order = latin_row(count, row);
  for (std::size_t& condition : order) condition = names[condition];
  return order;
}

}  // namespace nade::study
