#include "operator_words.h"

#include <poll.h>
#include <unistd.h>

#include <array>

namespace nade::xr {

std::optional<std::string> OperatorWords::next() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  if (!ended_ && poll(&input, 1, 0) > 0) {
    std::array<char, 256> bytes{};
    const ssize_t count = read(STDIN_FILENO, bytes.data(), bytes.size());
    ended_ = count <= 0;
    if (count > 0) typed_.append(bytes.data(), static_cast<std::size_t>(count));
  }
  const std::size_t end = typed_.find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string line = typed_.substr(0, end);
  typed_.erase(0, end + 1);
  return line;
}

}  // namespace nade::xr
