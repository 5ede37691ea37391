#pragma once

#include <string>
#include <string_view>

namespace nade {

/// A folder of one's own that is gone again with all that is in it.
class PassingFolder {
 public:
  /// `pattern` ends in "XXXXXX", for which something new is put.
  explicit PassingFolder(std::string pattern);
  PassingFolder(const PassingFolder&) = delete;
  PassingFolder& operator=(const PassingFolder&) = delete;
  ~PassingFolder();

  /// Whether it could be made.
  [[nodiscard]] bool there() const { return there_; }
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::string path(std::string_view name) const {
    return path_ + "/" + std::string(name);
  }

 private:
  std::string path_;
  bool there_ = false;
};

}  // namespace nade
