#include "warnings.h"

#include <fmt/format.h>

#include <algorithm>

namespace nade::io {

void Warnings::add(Oddity oddity, const std::string& sentence) {
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& entry) { return entry.oddity == oddity; });
  if (found == entries_.end()) {
    entries_.push_back({oddity, sentence, 1});
  } else {
    ++found->count;
  }
}

void Warnings::add_once(Oddity oddity, const std::string& sentence) {
  const bool known = std::any_of(entries_.begin(), entries_.end(),
                                 [&](const Entry& entry) { return entry.oddity == oddity; });
  if (!known) entries_.push_back({oddity, sentence, 1});
}

std::vector<std::string> Warnings::sentences() const {
  std::vector<std::string> result;
  for (const Entry& entry : entries_) {
    result.push_back(entry.count == 1
                         ? entry.first
                         : fmt::format("{} (and {} more like it)", entry.first, entry.count - 1));
  }
  return result;
}

}  // namespace nade::io
