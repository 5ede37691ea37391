#pragma once

// Counts heap allocations, in a program that is linked with allocation_counter.cpp.

#include <atomic>
#include <cstddef>

namespace nade::test {

inline std::atomic<std::size_t> allocations{0};

/// How many allocations `action` made.
template <class Action>
std::size_t allocations_of(Action&& action) {
  const std::size_t before = allocations.load();
  action();
  return allocations.load() - before;
}

}  // namespace nade::test
