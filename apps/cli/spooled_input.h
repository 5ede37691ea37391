#pragma once

#include <string>

#include "nade/status.h"

namespace nade::cli {

/// Standard input put into a file, for what has to be read twice. The file goes with this object.
class SpooledInput {
 public:
  [[nodiscard]] static Result<SpooledInput> read();
  SpooledInput(SpooledInput&& other) noexcept;
  SpooledInput& operator=(SpooledInput&& other) noexcept;
  ~SpooledInput();

  [[nodiscard]] const std::string& path() const { return path_; }

  /// The error with the file called what it is to the person.
  [[nodiscard]] Error renamed(Error error) const;

 private:
  SpooledInput() = default;

  std::string path_;
};

}  // namespace nade::cli
