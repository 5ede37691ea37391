#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nade/hand.h"
#include "nade/io/output_file.h"
#include "nade/mesh.h"
#include "nade/status.h"

namespace nade {

/// Where a part touches, as recorded. World frame.
struct RecordedContact {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitY();
  double depth_m = 0.0;  ///< how far the tracked skin lay below the surface
};

/// One hand of a recorded frame.
struct RecordedHand {
  HandPose pose;
  /// Only in corrected recordings.
  std::optional<HandStatus> status;
  std::array<std::optional<RecordedContact>, kPartCount> contact{};
  /// Keys we do not know, as the text of a JSON object; empty where there are none.
  std::string unknown_json;
};

/// One frame: the hands that were tracked in it.
struct RecordedFrame {
  std::int64_t time_ns = 0;
  std::array<std::optional<RecordedHand>, 2> hands{};  ///< by index_of(Handedness)
  std::optional<Pose> head;                            ///< midway between the eyes, where known
  std::string unknown_json;
};

/// The first line of a recording.
struct RecordingHeader {
  std::string source;   ///< "leap", "webxr", "synth", …
  std::string created;  ///< ISO 8601, UTC; empty where unknown
  bool hand_scale_known = false;
  std::string unknown_json;  ///< every other key ("method", "object", "tool", …), as a JSON object
};

/// What a file is, told from its content.
enum class RecordingFormat : std::uint8_t {
  nade,
  leap_v2,
  webxr_actions,
  joint_table,
  mediapipe_hands,
  webxr_joints,
  bvh,
  hot3d,
  unity_hands
};

/// Reads a recording of any known format, plain or gzip, a frame at a time, in memory that does
/// not grow with its length.
class RecordingReader {
 public:
  /// `path` may be "-" for standard input. The error names the file and what was expected.
  [[nodiscard]] static Result<RecordingReader> open(const std::string& path);
  RecordingReader(RecordingReader&&) noexcept;
  RecordingReader& operator=(RecordingReader&&) noexcept;
  ~RecordingReader();

  [[nodiscard]] RecordingFormat format() const;
  [[nodiscard]] const RecordingHeader& header() const;

  /// The next frame; no value at the end. Times are strictly increasing: a frame whose time does
  /// not advance is an error in our own format, and is left out, with a warning, when imported.
  /// Every hand is `is_usable`: one that is not is left out of its frame, with a warning.
  [[nodiscard]] Result<std::optional<RecordedFrame>> next();

  /// What was odd but not fatal so far, a sentence each ("…: cut off in line 17, which is left
  /// out"). At most one of each kind, with a count.
  [[nodiscard]] std::vector<std::string> warnings() const;

 private:
  struct Impl;
  explicit RecordingReader(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// How a recording becomes an animated model.
struct ModelOptions {
  bool chained = true;  ///< each joint hangs on the one before it; else all on the hand
  /// Shown beside the hands, in world coordinates; may be none.
  std::shared_ptr<const TriangleSoup> object;
};

/// Writes our format, or, where the path ends in ".csv" or ".csv.gz", a table with a row for each
/// hand of a frame, or, where it ends in ".mcap", messages for Foxglove, or, where it ends in
/// ".glb", a glTF model of the skinned hands that is animated (docs/formats.md): gzip where it ends
/// in ".gz", standard output for "-". A model is written in `finish`, and takes 700 bytes of memory
/// for each hand of a frame until then. The file appears under its name, whole, in `finish`, and
/// not at all if that is never reached; or, where asked for, at once.
class RecordingWriter {
 public:
  [[nodiscard]] static Result<RecordingWriter> create(const std::string& path,
                                                      const RecordingHeader& header,
                                                      OutputFile::Appears appears = {},
                                                      const ModelOptions& model = {});
  RecordingWriter(RecordingWriter&&) noexcept;
  RecordingWriter& operator=(RecordingWriter&&) noexcept;
  ~RecordingWriter();

  [[nodiscard]] Status write(const RecordedFrame& frame);
  /// Hands what was written so far to the system, so that of a program that is killed it can be
  /// read; of use only for a file that appears at once.
  [[nodiscard]] Status flush();
  [[nodiscard]] Status finish();

 private:
  struct Impl;
  explicit RecordingWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace nade
