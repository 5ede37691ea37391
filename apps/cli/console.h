#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace nade::cli {

/// One sentence on stderr: why the work ended, or what was odd and did not stop it.
void warn(const std::string& sentence);

/// One line on stderr where a person is looking; nothing in a pipe.
void say(const std::string& line);

/// How far a long piece of work is, and how long it will take still where that can be told;
/// rewritten in place, only where a person is looking.
class Progress {
 public:
  /// `total` frames, or what `unit` names; 0 where it is not known.
  Progress(std::string what, std::size_t total, std::string unit = "frames");
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  void step();

 private:
  std::string what_;
  std::string unit_;
  std::size_t total_;
  std::size_t done_ = 0;
  bool shown_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point written_ = start_;
};

}  // namespace nade::cli
