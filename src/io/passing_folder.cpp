#include "nade/io/passing_folder.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include "operating_system.h"

namespace nade {

PassingFolder::PassingFolder(std::string pattern) : path_(std::move(pattern)) {
  there_ = os::make_own_folder(path_);
}

PassingFolder::~PassingFolder() {
  std::error_code aside;
  if (there_) std::filesystem::remove_all(path_, aside);
}

}  // namespace nade
