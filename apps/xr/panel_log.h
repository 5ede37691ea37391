#pragma once

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "room.h"

namespace nade::xr {

/// Writes a line of JSON whenever the panel shows something else or stands elsewhere.
class PanelLog {
 public:
  /// The error names the file and why it cannot be written.
  [[nodiscard]] static Result<PanelLog> create(const std::string& path);

  [[nodiscard]] Status note(const Room& room);

 private:
  struct Closer {
    void operator()(std::FILE* file) const { static_cast<void>(std::fclose(file)); }
  };
  using File = std::unique_ptr<std::FILE, Closer>;
  PanelLog(std::string path, File file) : path_(std::move(path)), file_(std::move(file)) {}

  std::string path_;
  File file_;
  std::uint64_t revision_ = 0;
  std::optional<Vec3> place_;
};

}  // namespace nade::xr
