#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "nade/status.h"

namespace nade {

/// A file that appears under its name whole, in `finish`, or not at all: it is written without a
/// name, so that nothing is left of a program that is killed, or where the file system cannot do
/// that beside its place under another name. What stood there before stays until then. Standard
/// output ("-"), pipes and devices are written directly.
class OutputFile {
 public:
  enum class Encoding { plain, gzip };
  /// When the file stands under its name: `at_once` leaves, of a program that is killed, what was
  /// flushed. What stood there before is an error then.
  enum class Appears { whole, at_once };

  /// gzip where the name ends in ".gz", in small letters or capitals, else plain.
  [[nodiscard]] static Encoding encoding_of(const std::string& path);

  /// The error names the file and why it cannot be written.
  [[nodiscard]] static Result<OutputFile> create(const std::string& path, Encoding encoding,
                                                 Appears appears = Appears::whole);
  OutputFile(OutputFile&&) noexcept;
  OutputFile& operator=(OutputFile&&) noexcept;
  /// Leaves nothing behind where `finish` was not reached.
  ~OutputFile();

  [[nodiscard]] Status write(std::string_view bytes);
  /// Hands what was written so far to the system, with which it outlives the program.
  [[nodiscard]] Status flush();
  /// The file is on the disk before it has its name. Nothing may be written after it, whether it
  /// succeeded or not.
  [[nodiscard]] Status finish();

 private:
  struct Impl;
  explicit OutputFile(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// The ending of a name, without a ".gz" behind it, in small letters: ".csv" of "A.CSV.gz". Empty
/// where there is none.
[[nodiscard]] std::string content_ending_of(const std::string& path);

/// Writes a whole text, gzip where the name ends in ".gz"; "-" is standard output.
[[nodiscard]] Status write_whole(const std::string& path, std::string_view text);

}  // namespace nade
