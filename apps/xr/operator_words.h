#pragma once

#include <optional>
#include <string>

namespace nade::xr {

/// Lines that the operator types while frames go on.
class OperatorWords {
 public:
  /// The next whole line of standard input, without its end, if there is one now. Never waits.
  [[nodiscard]] std::optional<std::string> next();

 private:
  std::string typed_;
  bool ended_ = false;
};

}  // namespace nade::xr
