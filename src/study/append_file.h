#pragma once

#include <string>
#include <string_view>

#include "nade/status.h"

namespace nade::study {

/// When bytes are on the disk: at once, or when the system likes.
enum class Reach { disk, system };

/// A file to which whole lines are added; made where it is not there.
class AppendFile {
 public:
  [[nodiscard]] static Result<AppendFile> open(const std::string& path);
  AppendFile(AppendFile&& other) noexcept;
  AppendFile& operator=(AppendFile&& other) noexcept;
  ~AppendFile();

  /// Takes the file for this program until it ends; false where another has it.
  [[nodiscard]] bool lock();
  /// Adds a line, which comes with its end, in one piece.
  [[nodiscard]] Status append(std::string_view line, Reach reach);
  /// Cuts away what follows the last line end; how many bytes that was.
  [[nodiscard]] Result<std::size_t> cut_torn_line();
  [[nodiscard]] bool empty() const;

 private:
  AppendFile(std::string path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}

  std::string path_;
  int descriptor_ = -1;
};

/// Makes a folder and those above it, and puts them on disk.
[[nodiscard]] Status make_folder(const std::string& path);
/// Puts a file that was written on disk.
[[nodiscard]] Status sync_file(const std::string& path);
/// Puts a folder's list of files on disk.
[[nodiscard]] Status sync_folder(const std::string& path);

}  // namespace nade::study
