#include "nade/version.h"
#include "records.h"

namespace nade::c_abi {
namespace {

nade_status code_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::not_found:
      return NADE_IO_ERROR_NOT_FOUND;
    case ErrorCode::unreadable:
      return NADE_IO_ERROR_READ;
    case ErrorCode::unwritable:
      return NADE_IO_ERROR_WRITE;
    case ErrorCode::bad_format:
    case ErrorCode::bad_value:
      return NADE_IO_ERROR_CONTENT;
    case ErrorCode::out_of_range:
      return NADE_ERROR_ARGUMENT;
  }
  return NADE_ERROR_INTERNAL;
}

}  // namespace

nade_status fail(const Error& error) noexcept {
  return fail(code_of(error.code), "%s", error.message.c_str());
}

nade_status check_path(const char* path) noexcept {
  return Arguments()
      .given(path, "path")
      .expects(path == nullptr || *path != '\0', NADE_ERROR_ARGUMENT,
               "path: expected a file's name, found an empty one")
      .status();
}

}  // namespace nade::c_abi

extern "C" {

uint32_t nade_io_abi_version(void) noexcept { return NADE_IO_ABI_VERSION; }

const char* nade_io_version(void) noexcept { return nade::version(); }

const char* nade_io_status_text(nade_status status) noexcept {
  switch (status) {
    case NADE_IO_ERROR_NOT_FOUND:
      return "there is no such file";
    case NADE_IO_ERROR_READ:
      return "the file cannot be read";
    case NADE_IO_ERROR_WRITE:
      return "the output cannot be written";
    case NADE_IO_ERROR_CONTENT:
      return "the content is no recording, or cannot be used";
    default:
      return nade_status_text(status);
  }
}

const char* nade_io_last_error(void) noexcept { return nade_last_error(); }

}  // extern "C"
