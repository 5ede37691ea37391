#include "csv_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "csv_columns.h"
#include "file_side.h"
#include "mesh_words.h"
#include "nade/io/plain_text.h"
#include "recording_limits.h"

namespace nade::io {
namespace {

constexpr std::size_t kLeastColumns = 20;

std::string_view first_line(std::string_view text) {
  return text.substr(0, text.find_first_of("\r\n"));
}

/// The separator that a line of names has most of.
char separator_of(std::string_view names) {
  char best = ',';
  for (const char c : {';', '\t'}) {
    if (std::count(names.begin(), names.end(), c) > std::count(names.begin(), names.end(), best)) {
      best = c;
    }
  }
  return best;
}

std::string_view trimmed(std::string_view text) {
  const auto is_around = [](char c) { return c == ' ' || c == '"' || c == '\t'; };
  while (!text.empty() && is_around(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_around(text.back())) text.remove_suffix(1);
  return text;
}

void split(std::string_view line, char separator, std::vector<std::string_view>& cells) {
  cells.clear();
  while (true) {
    const std::size_t end = line.find(separator);
    cells.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return;
    line.remove_prefix(end + 1);
  }
}

std::string quoted(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  return fmt::format("'{}'", plain_text(text.substr(0, kLongest)));
}

std::optional<Handedness> side_from(std::string_view text) {
  if (text.empty()) return std::nullopt;
  const char c = text.front();
  if (c == 'l' || c == 'L' || text == "0") return Handedness::left;
  if (c == 'r' || c == 'R' || text == "1") return Handedness::right;
  return std::nullopt;
}

bool says_no(std::string_view text) {
  return text == "0" || text == "false" || text == "False" || text == "FALSE" || text == "no";
}

}  // namespace

bool looks_like_joint_table(std::string_view beginning) {
  const std::string_view names = first_line(beginning);
  if (names.empty() || names.front() == '{' || names.front() == '[') return false;
  const char separator = separator_of(names);
  return static_cast<std::size_t>(std::count(names.begin(), names.end(), separator)) >=
         kLeastColumns;
}

Result<CsvImport> CsvImport::open(ByteSource source) {
  CsvImport import(std::move(source));
  import.header_.source = "csv";
  const Status status = import.read_names();
  if (!status) return status.error();
  return import;
}

Error CsvImport::wrong(ErrorCode code, const std::string& sentence) const {
  return {code, fmt::format("{}: {}", place(), sentence)};
}

std::string CsvImport::place() const { return fmt::format("{}: line {}", name(), line_); }

std::string_view CsvImport::cell(std::size_t column) const { return cells_[column]; }

Status CsvImport::read_names() {
  const std::optional<Line> line = source_.read_line();
  if (source_.failure()) return *source_.failure();
  ++line_;
  if (!line) return wrong(ErrorCode::bad_format, "expected names of columns, found nothing");
  separator_ = separator_of(line->text);
  split(line->text, separator_, cells_);
  columns_ = cells_.size();
  for (HandColumns& hand : hands_) {
    for (auto& joint : hand.at) joint.fill(kNone);
  }
  for (std::size_t i = 0; i < columns_; ++i) take_column(cells_[i], i);
  return check_columns();
}

void CsvImport::take_column(std::string_view name, std::size_t column) {
  const std::optional<JointColumn> known = column_from(name);
  if (!known) return;
  if (known->kind == JointColumn::Kind::time) {
    if (time_column_ != kNone && time_unit_ns_ > 0.0) return;
    time_column_ = column;
    time_unit_ns_ = known->time_unit_ns;
    return;
  }
  if (known->kind == JointColumn::Kind::side) {
    side_column_ = column;
    return;
  }
  // Names without a side are of the hand that a column or the file's name says, or of both.
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    if (known->side && *known->side != side) continue;
    HandColumns& hand = hands_[index_of(side)];
    switch (known->kind) {
      case JointColumn::Kind::joint:
        hand.at[index_of(known->joint)][known->number] = column;
        hand.any = true;
        if (known->joint == Joint::palm) has_palm_ = true;
        break;
      case JointColumn::Kind::valid:
        hand.valid = column;
        break;
      default:
        hand.confidence = column;
        break;
    }
  }
}

Status CsvImport::check_columns() {
  if (time_column_ == kNone) {
    return wrong(ErrorCode::bad_format, "expected a column of times, as 'time_ns', found none");
  }
  bool sided = side_column_ != kNone;
  if (!sided && hands_[0].any && hands_[1].any && hands_[0].at == hands_[1].at) {
    const std::optional<Handedness> side = side_of_file(name());
    if (!side) {
      return wrong(ErrorCode::bad_format,
                   "expected a column 'hand', or left and right in the names of columns or the "
                   "file's, found none of them");
    }
    hands_[1 - index_of(*side)].any = false;
  }
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    const HandColumns& hand = hands_[index_of(side)];
    if (!hand.any) continue;
    for (std::size_t joint = has_palm_ ? 0 : 1; joint < kJointCount; ++joint) {
      for (std::size_t number = 0; number + 1 < kJointNumbers; ++number) {
        if (hand.at[joint][number] != kNone) continue;
        return wrong(ErrorCode::bad_format,
                     fmt::format("expected a column '{}_{}'{}, found none",
                                 name_of(joint_at(joint)), kJointNumberNames[number],
                                 sided ? "" : fmt::format(" of the {} hand", name_of(side))));
      }
    }
  }
  if (hands_[0].any || hands_[1].any) return ok_status();
  return wrong(ErrorCode::bad_format, "expected columns of joints, as 'index_tip_px', found none");
}

Result<std::optional<RecordedFrame>> CsvImport::next() {
  while (true) {
    Result<std::optional<Row>> row = ahead_ ? Result(std::exchange(ahead_, {})) : read_row();
    if (!row) return row.error();
    if (!*row) return std::optional<RecordedFrame>();
    RecordedFrame frame;
    frame.time_ns = (*row)->time_ns;
    frame.hands = std::move((*row)->hands);
    // The other hand of the same time stands in the next row.
    Result<std::optional<Row>> other = read_row();
    if (!other) return other.error();
    if (*other && (*other)->time_ns == frame.time_ns && side_column_ != kNone) {
      for (std::size_t side = 0; side < 2; ++side) {
        if (!frame.hands[side]) frame.hands[side] = std::move((*other)->hands[side]);
      }
    } else {
      ahead_ = std::move(*other);
    }
    if (!last_time_ns_ || frame.time_ns > *last_time_ns_) {
      last_time_ns_ = frame.time_ns;
      return std::optional<RecordedFrame>(std::move(frame));
    }
    warnings_.add(Oddity::time_not_advancing,
                  fmt::format("{}: the time does not advance; the frame is left out", place()));
  }
}

Result<std::optional<CsvImport::Row>> CsvImport::read_row() {
  std::optional<Line> line;
  do {
    line = source_.read_line();
    if (source_.failure()) return *source_.failure();
    if (!line) return std::optional<Row>();
    ++line_;
  } while (trimmed(line->text).empty());
  split(line->text, separator_, cells_);
  if (cells_.size() != columns_) {
    if (!line->terminated) {
      warnings_.add(Oddity::cut_off, fmt::format("{}: cut off, and left out", place()));
      return std::optional<Row>();
    }
    return wrong(ErrorCode::bad_format,
                 fmt::format("expected {} columns, found {}", columns_, cells_.size()));
  }
  Row row;
  const Result<std::int64_t> time_ns = time_of_row();
  if (!time_ns) return time_ns.error();
  row.time_ns = *time_ns;
  std::optional<Handedness> only;
  if (side_column_ != kNone) {
    only = side_from(cell(side_column_));
    if (!only) {
      return wrong(ErrorCode::bad_value,
                   fmt::format("expected left or right, found {}", quoted(cell(side_column_))));
    }
  }
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    const HandColumns& columns = hands_[index_of(side)];
    if (!columns.any || (only && *only != side)) continue;
    Result<std::optional<RecordedHand>> hand = hand_of(columns, side);
    if (!hand) return hand.error();
    row.hands[index_of(side)] = std::move(*hand);
  }
  return std::optional<Row>(std::move(row));
}

Result<std::int64_t> CsvImport::time_of_row() {
  const std::string_view text = cell(time_column_);
  // Whole numbers without a unit are nanoseconds, others seconds.
  if (time_unit_ns_ == 0.0) time_unit_ns_ = text.find('.') == std::string_view::npos ? 1.0 : 1e9;
  std::int64_t whole = 0;
  if (time_unit_ns_ == 1.0 && parse_word(text, whole) && std::abs(whole) <= kLatest_ns)
    return whole;
  double number = 0.0;
  if (parse_word(text, number) &&
      std::abs(number * time_unit_ns_) <= static_cast<double>(kLatest_ns)) {
    return static_cast<std::int64_t>(std::llround(number * time_unit_ns_));
  }
  return wrong(ErrorCode::bad_value, fmt::format("expected a time, found {}", quoted(text)));
}

Result<std::optional<RecordedHand>> CsvImport::hand_of(const HandColumns& columns,
                                                       Handedness side) {
  RecordedHand hand;
  hand.pose.side = side;
  if (columns.valid != kNone && says_no(cell(columns.valid))) return std::optional<RecordedHand>();
  std::size_t empty = 0;
  std::size_t asked = 0;
  bool finite = true;
  for (std::size_t joint = has_palm_ ? 0 : 1; joint < kJointCount; ++joint) {
    std::array<double, kJointNumbers> numbers{};
    for (std::size_t number = 0; number < kJointNumbers; ++number) {
      const std::size_t column = columns.at[joint][number];
      if (column == kNone) continue;
      ++asked;
      const std::string_view text = cell(column);
      if (text.empty()) {
        ++empty;
      } else if (!parse_word(text, numbers[number])) {
        return wrong(ErrorCode::bad_value, fmt::format("column {}: expected a number, found {}",
                                                       column + 1, quoted(text)));
      }
      finite = finite && std::isfinite(numbers[number]) && std::abs(numbers[number]) <= kFarthest_m;
    }
    hand.pose.joints[joint] = {{numbers[0], numbers[1], numbers[2]},
                               Quat(numbers[6], numbers[3], numbers[4], numbers[5])};
    hand.pose.radius[joint] = std::max(0.0, numbers[7]);
  }
  if (empty == asked) return std::optional<RecordedHand>();
  if (empty > 0 || !finite) {
    warnings_.add(Oddity::unusable_hand,
                  fmt::format("{}: {}: a number is missing or not finite; the hand is left out of "
                              "the frame",
                              place(), name_of(side)));
    return std::optional<RecordedHand>();
  }
  if (!has_palm_) hand.pose[Joint::palm] = palm_from_middle_metacarpal(hand.pose);
  if (columns.confidence != kNone) {
    double confidence = 0.0;
    if (parse_word(cell(columns.confidence), confidence) && confidence >= 0.0 &&
        confidence <= 1.0) {
      hand.pose.confidence = confidence;
    }
  }
  if (!intake_.admit(hand.pose, place(), warnings_)) return std::optional<RecordedHand>();
  return std::optional<RecordedHand>(std::move(hand));
}

}  // namespace nade::io
