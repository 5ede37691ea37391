#include "damage.h"

#include <filesystem>
#include <fstream>
#include <system_error>

#include "byte_source.h"

namespace nade::io {
namespace {

constexpr std::string_view kGzipMagic = "\x1F\x8B";

/// What can be read but once is not looked at.
bool is_gzip_file(const std::string& path) {
  std::error_code failure;
  if (!std::filesystem::is_regular_file(path, failure) || failure) return false;
  std::ifstream stream(path, std::ios::binary);
  std::string beginning(kGzipMagic.size(), '\0');
  return stream.read(beginning.data(), static_cast<std::streamsize>(beginning.size())) &&
         beginning == kGzipMagic;
}

}  // namespace

Error damage_or(const std::string& path, Error error) {
  if (error.code == ErrorCode::unreadable || !is_gzip_file(path)) return error;
  Result<ByteSource> bytes = ByteSource::open(path);
  if (!bytes) return error;
  while (bytes->get()) {
  }
  const std::optional<Error>& failure = bytes->failure();
  return failure && failure->code == ErrorCode::unreadable ? *failure : error;
}

}  // namespace nade::io
