#pragma once

#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "room.h"

namespace nade::xr {

/// Writes a line of JSON whenever the panel shows something else or stands elsewhere.
class PanelLog {
 public:
  /// Without effect where the file cannot be written.
  explicit PanelLog(const std::string& path);

  void note(const Room& room);

 private:
  struct Closer {
    void operator()(std::FILE* file) const { static_cast<void>(std::fclose(file)); }
  };
  std::unique_ptr<std::FILE, Closer> file_;
  std::uint64_t revision_ = 0;
  std::optional<Vec3> place_;
};

}  // namespace nade::xr
