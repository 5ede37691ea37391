#include "nade/io/passing_folder.h"

#include <stdlib.h>

#include <filesystem>
#include <system_error>
#include <utility>

namespace nade {

PassingFolder::PassingFolder(std::string pattern) : path_(std::move(pattern)) {
  there_ = ::mkdtemp(path_.data()) != nullptr;
}

PassingFolder::~PassingFolder() {
  std::error_code aside;
  if (there_) std::filesystem::remove_all(path_, aside);
}

}  // namespace nade
