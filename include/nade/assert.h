#pragma once

namespace nade {

/// Called when a caller breaks a documented precondition. It may log, stop or throw (what is
/// noexcept stops the program then); if it returns, the program is stopped.
using AssertHandler = void (*)(const char* condition, const char* file, int line);

/// Replaces the handler (the first one prints to stderr) and returns the one before.
AssertHandler set_assert_handler(AssertHandler handler);

namespace detail {
[[noreturn]] void assert_failed(const char* condition, const char* file, int line);
}

}  // namespace nade

/// Checks a caller's promise at the public boundary, in every build type.
#define NADE_ASSERT(condition)        \
  ((condition) ? static_cast<void>(0) \
               : ::nade::detail::assert_failed(#condition, __FILE__, __LINE__))
