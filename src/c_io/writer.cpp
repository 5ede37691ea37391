#include <nlohmann/json.hpp>
#include <utility>

#include "records.h"

using nade::c_abi::Arguments;
using nade::c_abi::guarded;

namespace nade::c_abi {
namespace {

std::string text_or_none(const char* text) { return text == nullptr ? "" : text; }

/// NADE_OK, with what `info` says in `header`, or what is wrong with it; NULL is none.
nade_status read_info(const nade_io_info* info, RecordingHeader& header) {
  if (info == nullptr) return NADE_OK;
  Arguments arguments;
  arguments.read(info, "info");
  if (!arguments.ok()) return arguments.status();
  arguments.within(info->hand_scale_known, 0, 1, "info: hand_scale_known");
  header.hand_scale_known = info->hand_scale_known != 0;
  header.source = text_or_none(info->source);
  header.created = text_or_none(info->created);
  header.unknown_json = text_or_none(info->more);
  const bool is_object =
      header.unknown_json.empty() ||
      nlohmann::json::parse(header.unknown_json, nullptr, /*allow_exceptions=*/false).is_object();
  return arguments
      .expects(is_object, NADE_ERROR_ARGUMENT, "info: more: expected the text of a JSON object")
      .status();
}

nade_status check_open(const HeldWriter& held) {
  return Arguments()
      .expects(!held.finished, NADE_ERROR_HANDLE, "writer: expected one that is not yet finished")
      .status();
}

nade_status write_frame(HeldWriter& held, const nade_io_frame& frame) {
  RecordedFrame recorded;
  const nade_status read = read_frame(frame, recorded);
  if (read != NADE_OK) return read;
  const Status written = held.writer.write(recorded);
  if (written) return NADE_OK;
  // What cannot be used was given by the program, and is no content of a file.
  if (written.error().code != ErrorCode::bad_value) return fail(written.error());
  return fail(NADE_ERROR_ARGUMENT, "%s", written.error().message.c_str());
}

}  // namespace
}  // namespace nade::c_abi

extern "C" {

nade_status nade_io_writer_create(const char* path, const nade_io_info* info,
                                  nade_io_writer** writer) noexcept {
  return guarded(__func__, [&] {
    const nade_status named = nade::c_abi::check_path(path);
    if (named != NADE_OK) return named;
    const Arguments arguments = Arguments().given(writer, "writer");
    if (!arguments.ok()) return arguments.status();
    nade::RecordingHeader header;
    const nade_status read = nade::c_abi::read_info(info, header);
    if (read != NADE_OK) return read;
    nade::Result<nade::RecordingWriter> created = nade::RecordingWriter::create(path, header);
    if (!created) return nade::c_abi::fail(created.error());
    *writer =
        nade::c_abi::HandlePool<nade_io_writer>::take(nade::c_abi::HeldWriter{std::move(*created)});
    return arguments.status();
  });
}

nade_status nade_io_writer_write(nade_io_writer* writer, const nade_io_frame* frame) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments = Arguments().handle(writer, "writer").read(frame, "frame");
    if (!arguments.ok()) return arguments.status();
    const nade_status open = nade::c_abi::check_open(*writer->contents);
    if (open != NADE_OK) return open;
    return nade::c_abi::write_frame(*writer->contents, *frame);
  });
}

nade_status nade_io_writer_finish(nade_io_writer* writer) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments = Arguments().handle(writer, "writer");
    if (!arguments.ok()) return arguments.status();
    nade::c_abi::HeldWriter& held = *writer->contents;
    const nade_status open = nade::c_abi::check_open(held);
    if (open != NADE_OK) return open;
    held.finished = true;
    const nade::Status finished = held.writer.finish();
    return finished ? nade_status{NADE_OK} : nade::c_abi::fail(finished.error());
  });
}

nade_status nade_io_writer_destroy(nade_io_writer* writer) noexcept {
  return nade::c_abi::destroy(__func__, writer);
}

}  // extern "C"
