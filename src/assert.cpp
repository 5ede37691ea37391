#include "nade/assert.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace nade {
namespace {

void print_failure(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: nade: a caller broke the precondition %s\n", file, line, condition);
}

std::atomic<AssertHandler> g_handler{print_failure};

}  // namespace

AssertHandler set_assert_handler(AssertHandler handler) {
  return g_handler.exchange(handler != nullptr ? handler : print_failure);
}

namespace detail {

void assert_failed(const char* condition, const char* file, int line) {
  g_handler.load()(condition, file, line);
  std::abort();
}

}  // namespace detail
}  // namespace nade
