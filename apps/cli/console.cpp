#include "console.h"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace nade::cli {
namespace {

constexpr std::size_t kFramesAStep = 500;

bool person_looks() { return ::isatty(STDERR_FILENO) == 1; }

}  // namespace

void warn(const std::string& sentence) { std::fprintf(stderr, "nade: %s\n", sentence.c_str()); }

void say(const std::string& line) {
  if (person_looks()) std::fprintf(stderr, "%s\n", line.c_str());
}

Progress::Progress(std::string what, std::size_t total)
    : what_(std::move(what)), total_(total), shown_(person_looks()) {}

Progress::~Progress() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void Progress::step() {
  ++done_;
  if (!shown_ || done_ % kFramesAStep != 0) return;
  std::fprintf(stderr, "\r%s %zu", what_.c_str(), done_);
  if (total_ > 0) std::fprintf(stderr, " of %zu", total_);
  std::fputs(" frames", stderr);
}

}  // namespace nade::cli
