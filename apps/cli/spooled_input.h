#pragma once

#include <cstdio>
#include <memory>
#include <string>

#include "nade/status.h"

namespace nade::cli {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using SpooledFile = std::unique_ptr<std::FILE, CloseFile>;

/// An input that has to be read twice. What can be read but once (standard input, a pipe) is put
/// into a file first, which has no name and goes with this object, or with the program.
class SpooledInput {
 public:
  /// What is not there at all is left to whoever reads it.
  [[nodiscard]] static Result<SpooledInput> open(const std::string& name);
  /// One that is read once only, as it is.
  [[nodiscard]] static SpooledInput unspooled(const std::string& name);

  /// Where to read it.
  [[nodiscard]] const std::string& path() const { return path_; }
  /// What the person calls it.
  [[nodiscard]] const std::string& name() const { return name_; }

  /// A sentence with the file called what it is to the person.
  [[nodiscard]] std::string renamed(std::string sentence) const;
  [[nodiscard]] Error renamed(Error error) const;

 private:
  explicit SpooledInput(const std::string& name);

  std::string name_;
  std::string path_;
  SpooledFile ours_;
};

/// How it went, with the same done to an error.
[[nodiscard]] Status named(const Status& status, const SpooledInput& input);

}  // namespace nade::cli
