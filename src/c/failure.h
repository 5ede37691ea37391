#pragma once

#include <exception>
#include <new>

#include "nade.h"

/// What the sentence of a call has room for, its end included.
#ifndef NADE_C_SENTENCE_BYTES
#define NADE_C_SENTENCE_BYTES 256
#endif

namespace nade::c_abi {

/// Writes the sentence of a call that fails, gives it to the program's callback, and returns
/// `status`. Does not allocate.
#if defined(__MINGW32__)
__attribute__((format(gnu_printf, 2, 3)))  // where printf stands for that of Windows' C library
#elif defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
nade_status
fail(nade_status status, const char* format, ...) noexcept;

/// The function of the interface that this thread is in, for the sentences.
class FunctionName {
 public:
  explicit FunctionName(const char* name) noexcept;
  FunctionName(const FunctionName&) = delete;
  FunctionName& operator=(const FunctionName&) = delete;
  ~FunctionName();

 private:
  const char* before_;
};

/// Runs the body of a function of the interface. Nothing thrown leaves it.
template <class Body>
[[nodiscard]] nade_status guarded(const char* function, Body&& body) noexcept {
  const FunctionName name(function);
#ifndef __cpp_exceptions
  return body();
#else
  try {
    return body();
  } catch (const std::bad_alloc&) {
    return fail(NADE_ERROR_MEMORY, "no memory is left");
  } catch (const std::exception& error) {
    return fail(NADE_ERROR_INTERNAL, "%s", error.what());
  } catch (...) {
    return fail(NADE_ERROR_INTERNAL, "an unknown exception");
  }
#endif
}

}  // namespace nade::c_abi
