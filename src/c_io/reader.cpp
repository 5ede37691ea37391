#include <utility>

#include "records.h"

using nade::c_abi::Arguments;
using nade::c_abi::guarded;

namespace nade::c_abi {
namespace {

static_assert(static_cast<int>(RecordingFormat::nade) == NADE_IO_FORMAT_NADE);
static_assert(static_cast<int>(RecordingFormat::leap_v2) == NADE_IO_FORMAT_LEAP_V2);
static_assert(static_cast<int>(RecordingFormat::webxr_actions) == NADE_IO_FORMAT_WEBXR_ACTIONS);
static_assert(static_cast<int>(RecordingFormat::joint_table) == NADE_IO_FORMAT_JOINT_TABLE);
static_assert(static_cast<int>(RecordingFormat::mediapipe_hands) == NADE_IO_FORMAT_MEDIAPIPE_HANDS);
static_assert(static_cast<int>(RecordingFormat::webxr_joints) == NADE_IO_FORMAT_WEBXR_JOINTS);
static_assert(static_cast<int>(RecordingFormat::bvh) == NADE_IO_FORMAT_BVH);
static_assert(static_cast<int>(RecordingFormat::hot3d) == NADE_IO_FORMAT_HOT3D);
static_assert(static_cast<int>(RecordingFormat::unity_hands) == NADE_IO_FORMAT_UNITY_HANDS);

nade_io_info info_of(const RecordingReader& reader) {
  const RecordingHeader& header = reader.header();
  nade_io_info info{};
  info.size = sizeof info;
  info.format = static_cast<nade_io_format>(reader.format());
  info.hand_scale_known = header.hand_scale_known ? 1 : 0;
  info.source = header.source.c_str();
  info.created = header.created.c_str();
  info.more = header.unknown_json.c_str();
  return info;
}

nade_status read_next(HeldReader& held, nade_io_frame& frame, int32_t& found) {
  if (held.failure) return fail(*held.failure);
  const Result<std::optional<RecordedFrame>> next = held.reader.next();
  if (!next) {
    held.failure = next.error();
    return fail(next.error());
  }
  found = next->has_value() ? 1 : 0;
  if (found != 0) write(frame_from(**next), frame);
  return NADE_OK;
}

}  // namespace
}  // namespace nade::c_abi

extern "C" {

nade_status nade_io_reader_open(const char* path, nade_io_reader** reader) noexcept {
  return guarded(__func__, [&] {
    const nade_status named = nade::c_abi::check_path(path);
    if (named != NADE_OK) return named;
    const Arguments arguments = Arguments().given(reader, "reader");
    if (!arguments.ok()) return arguments.status();
    nade::Result<nade::RecordingReader> opened = nade::RecordingReader::open(path);
    if (!opened) return nade::c_abi::fail(opened.error());
    *reader = nade::c_abi::HandlePool<nade_io_reader>::take(
        nade::c_abi::HeldReader{std::move(*opened), {}, {}});
    return arguments.status();
  });
}

nade_status nade_io_reader_info(const nade_io_reader* reader, nade_io_info* info) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments = Arguments().handle(reader, "reader").sized(info, "info");
    if (arguments.ok()) {
      nade::c_abi::write(nade::c_abi::info_of(reader->contents->reader), *info);
    }
    return arguments.status();
  });
}

nade_status nade_io_reader_next(nade_io_reader* reader, nade_io_frame* frame,
                                int32_t* found) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments =
        Arguments().handle(reader, "reader").sized(frame, "frame").given(found, "found");
    if (!arguments.ok()) return arguments.status();
    return nade::c_abi::read_next(*reader->contents, *frame, *found);
  });
}

nade_status nade_io_reader_warning_count(const nade_io_reader* reader, size_t* count) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments = Arguments().handle(reader, "reader").given(count, "count");
    if (arguments.ok()) *count = reader->contents->reader.warnings().size();
    return arguments.status();
  });
}

nade_status nade_io_reader_warning(nade_io_reader* reader, size_t index,
                                   const char** sentence) noexcept {
  return guarded(__func__, [&] {
    const Arguments arguments = Arguments().handle(reader, "reader").given(sentence, "sentence");
    if (!arguments.ok()) return arguments.status();
    nade::c_abi::HeldReader& held = *reader->contents;
    std::vector<std::string> warnings = held.reader.warnings();
    if (index >= warnings.size()) {
      return nade::c_abi::fail(NADE_ERROR_ARGUMENT, "index: expected less than %zu, found %zu",
                               warnings.size(), index);
    }
    held.warnings = std::move(warnings);
    *sentence = held.warnings[index].c_str();
    return arguments.status();
  });
}

nade_status nade_io_reader_destroy(nade_io_reader* reader) noexcept {
  return nade::c_abi::destroy(__func__, reader);
}

}  // extern "C"
