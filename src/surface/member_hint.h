#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "nade/surface.h"

namespace nade {

// Several surfaces that answer as one. A hint says in its first byte which of them did, and then
// that one's element.

inline constexpr std::uint32_t kElementBits = 24;
inline constexpr std::uint32_t kElementUnknown = (1U << kElementBits) - 1U;
inline constexpr std::size_t kMostMembers = 0xff;

[[nodiscard]] inline std::size_t member_of(SurfaceHint all) { return all.element >> kElementBits; }

/// What a hint of all of them is to one.
[[nodiscard]] inline SurfaceHint hint_in(std::size_t member, SurfaceHint all) {
  if (member_of(all) != member) return {};
  const std::uint32_t element = all.element & kElementUnknown;
  return {element == kElementUnknown ? SurfaceHint::kNone : element};
}

/// And what one's is to all of them.
[[nodiscard]] inline SurfaceHint hint_for_all(std::size_t member, SurfaceHint its) {
  const std::uint32_t element = std::min(its.element, kElementUnknown);
  return {static_cast<std::uint32_t>(member) << kElementBits | element};
}

/// The shape of all so far, and of one more.
[[nodiscard]] inline std::uint64_t with_shape(std::uint64_t all, std::uint64_t its) {
  constexpr std::uint64_t kMix = 0x9e3779b97f4a7c15;  // odd, so that no member's is lost
  return kMix * all + its;
}

}  // namespace nade
