#pragma once

#include <string>
#include <utility>
#include <variant>

#include "nade/assert.h"

namespace nade {

/// What went wrong, for a program. For a person there is `Error::message`.
enum class ErrorCode {
  not_found,     ///< no such file
  unreadable,    ///< the file exists but could not be read
  unwritable,    ///< the output could not be written whole (no permission, disk full)
  bad_format,    ///< the content is not of a known form
  bad_value,     ///< the form is known, a value in it cannot be used
  out_of_range,  ///< an option outside what it may be
};

/// One sentence that names the file, the line or element, and what was expected.
struct Error {
  ErrorCode code;
  std::string message;
};

/// A value, or why there is none.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}      // NOLINT(google-explicit-constructor)
  Result(Error error) : state_(std::move(error)) {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] bool ok() const { return std::holds_alternative<T>(state_); }
  explicit operator bool() const { return ok(); }

  /// Only where `ok()`.
  [[nodiscard]] T& value() & {
    NADE_ASSERT(ok());
    return *std::get_if<T>(&state_);
  }
  [[nodiscard]] const T& value() const& {
    NADE_ASSERT(ok());
    return *std::get_if<T>(&state_);
  }
  [[nodiscard]] T&& value() && {
    NADE_ASSERT(ok());
    return std::move(*std::get_if<T>(&state_));
  }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }

  /// Only where not `ok()`.
  [[nodiscard]] const Error& error() const {
    NADE_ASSERT(!ok());
    return *std::get_if<Error>(&state_);
  }

 private:
  std::variant<T, Error> state_;
};

/// Success, or why not.
using Status = Result<std::monostate>;
inline Status ok_status() { return std::monostate{}; }

}  // namespace nade
