#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "byte_source.h"
#include "hand_intake.h"
#include "nade/io/recording.h"
#include "recording_limits.h"
#include "warnings.h"

namespace nade::io {

/// Whether a text begins like a table of joints: a line of many names.
[[nodiscard]] bool looks_like_joint_table(std::string_view beginning);

/// Reads a table of joints: a column for each number of each joint, a row for a frame or for a hand
/// of one. Columns are told by their names, in the spellings of OpenXR, WebXR, Unity and ours.
class CsvImport {
 public:
  [[nodiscard]] static Result<CsvImport> open(ByteSource source);

  [[nodiscard]] const RecordingHeader& header() const { return header_; }
  [[nodiscard]] Result<std::optional<RecordedFrame>> next();
  [[nodiscard]] const Warnings& warnings() const { return warnings_; }
  [[nodiscard]] HandIntake& intake() { return intake_; }
  [[nodiscard]] const std::string& name() const { return source_.name(); }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  /// Where the numbers of a hand are in a row.
  struct HandColumns {
    std::array<std::array<std::size_t, kJointNumbers>, kJointCount> at{};
    std::size_t valid = kNone;
    std::size_t confidence = kNone;
    bool any = false;
  };
  /// What a row says: the frame's time, and the hands in it.
  struct Row {
    std::int64_t time_ns = 0;
    std::array<std::optional<RecordedHand>, 2> hands{};
  };

  explicit CsvImport(ByteSource source) : source_(std::move(source)) {}

  Status read_names();
  void take_column(std::string_view name, std::size_t column);
  Status check_columns();
  /// None at the end.
  Result<std::optional<Row>> read_row();
  Result<std::int64_t> time_of_row();
  Result<std::optional<RecordedHand>> hand_of(const HandColumns& columns, Handedness side);
  [[nodiscard]] std::string place() const;
  [[nodiscard]] Error wrong(ErrorCode code, const std::string& sentence) const;
  [[nodiscard]] std::string_view cell(std::size_t column) const;

  ByteSource source_;
  RecordingHeader header_;
  Warnings warnings_;
  HandIntake intake_{1e-9};
  char separator_ = ',';
  std::vector<std::string_view> cells_;  ///< of the row that is read
  std::size_t columns_ = 0;
  std::size_t line_ = 0;
  std::size_t time_column_ = kNone;
  double time_unit_ns_ = 0.0;  ///< 0 until the first row has told
  std::size_t side_column_ = kNone;
  std::array<HandColumns, 2>
      hands_;  ///< by index_of(Handedness); the first where a column says which
  bool has_palm_ = false;
  std::optional<Row> ahead_;
  std::optional<std::int64_t> last_time_ns_;
};

}  // namespace nade::io
