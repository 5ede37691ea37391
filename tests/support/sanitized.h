#pragma once

namespace nade::test {

/// Whether the sanitizers look on. They take ten to twenty times as long, and what only repeats
/// itself is done fewer times.
#if defined(NADE_SANITIZED)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace nade::test
