#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace nade::fuzz {

/// A target's input.
[[nodiscard]] inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// A file with an input's bytes, in the temporary folder, as long as it lives.
class InputFile {
 public:
  InputFile(std::string_view bytes, const std::string& ending)
      : path_(std::filesystem::temp_directory_path() /
              ("nade_fuzz_" + std::to_string(::getpid()) + ending)) {
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~InputFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// What a target demands of the library; the fuzzer keeps the input that ends here.
inline void demand(bool holds) {
  if (!holds) std::abort();
}

}  // namespace nade::fuzz
