#include "failure.h"

#include <array>
#include <cstdarg>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "nade/assert.h"

namespace nade::c_abi {
namespace {

thread_local std::array<char, NADE_C_SENTENCE_BYTES> t_sentence{};
thread_local const char* t_function = "";

nade_message_callback g_callback = nullptr;
void* g_callback_user = nullptr;

#ifdef NADE_C_OWNS_CORE
// Where the core is the library's own, its assertions become errors too.
[[noreturn]] void throw_failure(const char* condition, const char* /*file*/, int /*line*/) {
  throw std::logic_error(std::string("a broken precondition, ") + condition);
}

[[maybe_unused]] const AssertHandler kHandlerBefore = set_assert_handler(throw_failure);
#endif

}  // namespace

nade_status fail(nade_status status, const char* format, ...) noexcept {
  std::array<char, t_sentence.size()> sentence{};
  const int length = std::snprintf(sentence.data(), sentence.size(), "%s: ", t_function);
  std::va_list values;
  va_start(values, format);
  if (length >= 0 && static_cast<std::size_t>(length) < sentence.size()) {
    const auto start = static_cast<std::size_t>(length);
    std::vsnprintf(sentence.data() + start, sentence.size() - start, format, values);
  }
  va_end(values);
  t_sentence = sentence;
  if (g_callback != nullptr) g_callback(g_callback_user, status, sentence.data());
  return status;
}

FunctionName::FunctionName(const char* name) noexcept : before_(t_function) { t_function = name; }
FunctionName::~FunctionName() { t_function = before_; }

}  // namespace nade::c_abi

extern "C" {

const char* nade_last_error(void) noexcept { return nade::c_abi::t_sentence.data(); }

void nade_set_message_callback(nade_message_callback callback, void* user) noexcept {
  nade::c_abi::g_callback = callback;
  nade::c_abi::g_callback_user = user;
}

}  // extern "C"
