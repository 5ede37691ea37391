#include "nade/io/recording.h"

#include <fmt/format.h>

#include <cctype>
#include <variant>

#include "animated_hands.h"
#include "bvh_import.h"
#include "byte_source.h"
#include "csv_import.h"
#include "csv_write.h"
#include "damage.h"
#include "frame_sketch.h"
#include "hot3d_import.h"
#include "json_text.h"
#include "leap_import.h"
#include "mcap_write.h"
#include "mediapipe_import.h"
#include "nade/io/output_file.h"
#include "recording_lines.h"
#include "unity_import.h"
#include "webxr_dump_import.h"
#include "webxr_import.h"

namespace nade {
namespace {

using io::BvhImport;
using io::ByteSource;
using io::CsvImport;
using io::FrameSketch;
using io::Hot3dImport;
using io::LeapImport;
using io::MediapipeImport;
using io::RecordingLines;
using io::Sketch;
using io::UnityImport;
using io::WebxrDumpImport;
using io::WebxrImport;

// As RecordingFormat.
using AnySource = std::variant<RecordingLines, LeapImport, WebxrImport, CsvImport, MediapipeImport,
                               WebxrDumpImport, BvhImport, Hot3dImport, UnityImport>;

/// Enough to see what a file is.
constexpr std::size_t kLookAhead = std::size_t{1} << 16;
constexpr std::string_view kKnownForms =
    "a nade recording, raw Leap Motion v2 frames (LeapJS JSON), a WebXR action recording, WebXR "
    "joints (JSON), results of MediaPipe (JSON), hands of HOT3D (JSON), a table of joints (CSV), a "
    "motion capture file (BVH) or a Unity hand recording";

template <class Source>
Result<AnySource> opened(ByteSource source) {
  Result<Source> result = Source::open(std::move(source));
  if (!result) return result.error();
  return AnySource(std::move(result).value());
}

Error unknown_form(const std::string& name, const std::string& found) {
  return {ErrorCode::bad_format,
          fmt::format("{}: expected {}, found {}", name, kKnownForms, found)};
}

Result<AnySource> recognised(ByteSource source) {
  const std::string_view beginning = source.peek(kLookAhead);
  if (source.failure()) return *source.failure();
  if (io::looks_like_unity_hands(beginning)) return opened<UnityImport>(std::move(source));
  if (io::looks_like_unity_asset(beginning)) {
    return unknown_form(source.name(),
                        "an asset of Unity's editor; take the .handsbin that it was made of");
  }
  if (io::looks_like_bvh(beginning)) return opened<BvhImport>(std::move(source));
  if (io::looks_like_joint_table(beginning)) return opened<CsvImport>(std::move(source));
  const Sketch sketch = io::sketch_of(beginning);
  if (sketch.begins.empty()) return unknown_form(source.name(), "nothing");
  if (sketch.find("format") != nullptr) return opened<RecordingLines>(std::move(source));
  if (sketch.find("schema") != nullptr) return opened<WebxrImport>(std::move(source));
  if (sketch.find("hand_poses") != nullptr) return opened<Hot3dImport>(std::move(source));
  const FrameSketch frame = io::frame_sketch_of(beginning);
  if (frame.has_landmarks()) return opened<MediapipeImport>(std::move(source));
  if (frame.has_webxr_joints()) return opened<WebxrDumpImport>(std::move(source));
  if (sketch.find("t") != nullptr) {
    return unknown_form(source.name(), "a frame in line 1, without the recording's header");
  }
  const Sketch::Member* frames = sketch.find("frames");
  const std::string frames_begin = frames == nullptr ? "" : frames->begins;
  if (sketch.begins.starts_with("[{") || frames_begin.starts_with("[{") ||
      frames_begin.starts_with("[]")) {
    return opened<LeapImport>(std::move(source));
  }
  if (frames_begin.starts_with("[[") && frames_begin.size() > 2 &&
      std::isdigit(static_cast<unsigned char>(frames_begin[2])) != 0) {
    return opened<WebxrImport>(std::move(source));
  }
  // The packed form of LeapJS Playback.
  if (frames_begin.starts_with("[[")) return opened<LeapImport>(std::move(source));
  if (sketch.find("hand_model") != nullptr) {
    return unknown_form(source.name(), "the hand of a person of HOT3D, which its recording needs");
  }
  if (sketch.members.empty()) return unknown_form(source.name(), "none of them");
  return unknown_form(source.name(),
                      fmt::format("an object that begins with \"{}\"", sketch.members[0].key));
}

}  // namespace

struct RecordingReader::Impl {
  std::string path;
  AnySource source;
};

RecordingReader::RecordingReader(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RecordingReader::RecordingReader(RecordingReader&&) noexcept = default;
RecordingReader& RecordingReader::operator=(RecordingReader&&) noexcept = default;
RecordingReader::~RecordingReader() = default;

Result<RecordingReader> RecordingReader::open(const std::string& path) {
  Result<ByteSource> bytes = ByteSource::open(path);
  if (!bytes) return bytes.error();
  Result<AnySource> source = recognised(std::move(bytes).value());
  if (!source) return io::damage_or(path, source.error());
  return RecordingReader(std::make_unique<Impl>(Impl{path, std::move(source).value()}));
}

RecordingFormat RecordingReader::format() const {
  return static_cast<RecordingFormat>(impl_->source.index());
}

const RecordingHeader& RecordingReader::header() const {
  return std::visit([](const auto& source) -> const RecordingHeader& { return source.header(); },
                    impl_->source);
}

Result<std::optional<RecordedFrame>> RecordingReader::next() {
  Result<std::optional<RecordedFrame>> next = std::visit(
      [](auto& source) {
        Result<std::optional<RecordedFrame>> frame = source.next();
        if (frame && *frame) source.intake().add_time((*frame)->time_ns);
        return frame;
      },
      impl_->source);
  if (!next) return io::damage_or(impl_->path, next.error());
  return next;
}

std::vector<std::string> RecordingReader::warnings() const {
  return std::visit(
      [](auto& source) {
        std::vector<std::string> sentences = source.warnings().sentences();
        for (std::string& doubt : source.intake().doubts(source.name())) {
          sentences.push_back(std::move(doubt));
        }
        return sentences;
      },
      impl_->source);
}

struct RecordingWriter::Impl {
  std::string name;
  OutputFile file;
  fmt::memory_buffer buffer;
  bool is_table = false;
  std::optional<io::AnimatedHands> model;
  std::optional<io::McapRecording> log;
  std::optional<std::int64_t> last_time_ns;

  Status append_frame(const RecordedFrame& frame) {
    const Status checked = io::check_frame(frame);
    if (!checked) return checked;
    if (model) {
      model->add(frame);
      return ok_status();
    }
    if (log) {
      const Status added = log->add(frame);
      if (added) append_log();
      return added;
    }
    is_table ? io::append_csv_frame(frame, buffer) : io::append_frame(frame, buffer);
    return ok_status();
  }
  void append_log() {
    const std::string bytes = log->take();
    buffer.append(bytes.data(), bytes.data() + bytes.size());
  }
  Status write_buffer() {
    Status status = file.write({buffer.data(), buffer.size()});
    buffer.clear();
    return status;
  }
};

RecordingWriter::RecordingWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RecordingWriter::RecordingWriter(RecordingWriter&&) noexcept = default;
RecordingWriter& RecordingWriter::operator=(RecordingWriter&&) noexcept = default;
RecordingWriter::~RecordingWriter() = default;

Result<RecordingWriter> RecordingWriter::create(const std::string& path,
                                                const RecordingHeader& header,
                                                OutputFile::Appears appears,
                                                const ModelOptions& model) {
  std::optional<io::AnimatedHands> hands;
  if (io::names_a_model(path)) {
    Result<io::AnimatedHands> created = io::AnimatedHands::create(header, model);
    if (!created) return created.error();
    hands = std::move(created).value();
  }
  Result<OutputFile> file = OutputFile::create(path, OutputFile::encoding_of(path), appears);
  if (!file) return file.error();
  auto impl = std::make_unique<Impl>(
      Impl{path == "-" ? "standard output" : path, std::move(file).value(), fmt::memory_buffer(),
           io::names_a_table(path), std::move(hands), std::nullopt, std::nullopt});
  if (impl->model) return RecordingWriter(std::move(impl));
  if (io::names_a_log(path)) {
    impl->log.emplace(header);
    impl->append_log();
  } else {
    impl->is_table ? io::append_csv_names(impl->buffer) : io::append_header(header, impl->buffer);
  }
  const Status status = impl->write_buffer();
  if (!status) return status.error();
  return RecordingWriter(std::move(impl));
}

Status RecordingWriter::write(const RecordedFrame& frame) {
  NADE_ASSERT(impl_ != nullptr);
  if (impl_->last_time_ns && frame.time_ns <= *impl_->last_time_ns) {
    return Error{ErrorCode::bad_value,
                 fmt::format("{}: frame at {} ns: expected a time after {} ns", impl_->name,
                             frame.time_ns, *impl_->last_time_ns)};
  }
  const Status appended = impl_->append_frame(frame);
  if (!appended) {
    impl_->buffer.clear();
    return Error{appended.error().code,
                 fmt::format("{}: {}", impl_->name, appended.error().message)};
  }
  impl_->last_time_ns = frame.time_ns;
  return impl_->write_buffer();
}

Status RecordingWriter::flush() {
  NADE_ASSERT(impl_ != nullptr);
  return impl_->file.flush();
}

Status RecordingWriter::finish() {
  NADE_ASSERT(impl_ != nullptr);
  if (impl_->model) {
    const Result<std::string> bytes = impl_->model->as_glb();
    if (!bytes) {
      return Error{bytes.error().code, fmt::format("{}: {}", impl_->name, bytes.error().message)};
    }
    const Status written = impl_->file.write(*bytes);
    if (!written) return written;
  }
  if (impl_->log) {
    impl_->log->finish();
    impl_->append_log();
    const Status written = impl_->write_buffer();
    if (!written) return written;
  }
  return impl_->file.finish();
}

}  // namespace nade
