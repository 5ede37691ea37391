#include "console.h"

#include <chrono>
#include <cstdio>
#include <utility>

#include "io/operating_system.h"
#include "nade/io/plain_text.h"

namespace nade::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBetween{200};

}  // namespace

void warn(const std::string& sentence) {
  std::fprintf(stderr, "nade: %s\n", plain_text(sentence).c_str());
}

void say(const std::string& line) {
  if (os::person_looks()) std::fprintf(stderr, "%s\n", plain_text(line).c_str());
}

Progress::Progress(std::string what, std::size_t total, std::string unit)
    : what_(std::move(what)), unit_(std::move(unit)), total_(total), shown_(os::person_looks()) {}

Progress::~Progress() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void Progress::step() {
  ++done_;
  if (!shown_) return;
  const Clock::time_point now = Clock::now();
  if (now - written_ < kBetween) return;
  written_ = now;
  std::fprintf(stderr, "\r%s %zu", what_.c_str(), done_);
  if (total_ > 0) std::fprintf(stderr, " of %zu", total_);
  std::fprintf(stderr, " %s", unit_.c_str());
  if (total_ > done_) {
    const double spent_s = std::chrono::duration<double>(now - start_).count();
    const double left_s =
        spent_s / static_cast<double>(done_) * static_cast<double>(total_ - done_);
    std::fprintf(stderr, ", %.0f s left", left_s);
  }
  std::fputs("\033[K", stderr);
}

}  // namespace nade::cli
