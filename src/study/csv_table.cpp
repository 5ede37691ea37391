#include "csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "json_reader.h"

// Based on: Shafranovich. RFC 4180, Common Format and MIME Type for CSV Files. 2005.

namespace nade::study {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::string_view kBlanks = " \t";

bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) ==
           std::tolower(static_cast<unsigned char>(y));
  });
}

std::string trimmed(std::string_view text) {
  const std::size_t from = text.find_first_not_of(kBlanks);
  if (from == std::string_view::npos) return {};
  return std::string(text.substr(from, text.find_last_not_of(kBlanks) - from + 1));
}

/// What parts the fields: of commas, semicolons and tabs the one the first line has most of.
char separator_of(std::string_view text) {
  const std::string_view first = text.substr(0, text.find_first_of("\r\n"));
  constexpr std::array kSeparators{',', ';', '\t'};
  return *std::max_element(kSeparators.begin(), kSeparators.end(), [&](char a, char b) {
    return std::count(first.begin(), first.end(), a) < std::count(first.begin(), first.end(), b);
  });
}

/// Takes a text apart, a record at a time.
class Scanner {
 public:
  Scanner(std::string path, std::string_view text)
      : path_(std::move(path)), text_(text), separator_(separator_of(text)) {}

  /// No value at the end. Lines with nothing on them are passed over.
  Result<std::optional<CsvRecord>> next() {
    while (at_ < text_.size() && (text_[at_] == '\n' || text_[at_] == '\r')) pass_line_end();
    if (at_ == text_.size()) return std::optional<CsvRecord>{};
    CsvRecord record{line_, {}};
    while (true) {
      Result<std::string> field = next_field();
      if (!field) return field.error();
      record.fields.push_back(std::move(field).value());
      if (at_ == text_.size() || text_[at_] != separator_) break;
      ++at_;
    }
    ended_by_line_end_ = at_ < text_.size();
    if (ended_by_line_end_) pass_line_end();
    return std::optional<CsvRecord>(std::move(record));
  }

  /// Whether the last record was whole as far as its end shows.
  [[nodiscard]] bool ended_by_line_end() const { return ended_by_line_end_; }

 private:
  [[nodiscard]] Error wrong(std::size_t line, std::string_view what) const {
    return {ErrorCode::bad_format, fmt::format("{}: line {}: {}", path_, line, what)};
  }

  void pass_line_end() {
    const bool both = text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n';
    at_ += both ? 2 : 1;
    ++line_;
  }

  Result<std::string> next_field() {
    const std::size_t quote = text_.find_first_not_of(separator_ == '\t' ? " " : kBlanks, at_);
    if (quote < text_.size() && text_[quote] == '"') {
      at_ = quote + 1;
      return quoted_field();
    }
    const std::array<char, 3> ends{separator_, '\r', '\n'};
    const std::size_t end = std::min(
        text_.find_first_of(std::string_view(ends.data(), ends.size()), at_), text_.size());
    const std::string_view field = text_.substr(at_, end - at_);
    at_ = end;
    return trimmed(field);
  }

  Result<std::string> quoted_field() {
    const std::size_t opened = line_;
    std::string field;
    while (true) {
      if (at_ == text_.size()) return wrong(opened, "expected a closing quote, found the end");
      const char character = text_[at_++];
      if (character == '\n') ++line_;
      if (character != '"') {
        field += character;
      } else if (at_ < text_.size() && text_[at_] == '"') {
        field += text_[at_++];
      } else {
        break;
      }
    }
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    const bool ended =
        at_ == text_.size() || text_[at_] == separator_ || text_[at_] == '\r' || text_[at_] == '\n';
    if (!ended) return wrong(line_, "expected a separator after a closing quote");
    return trimmed(field);
  }

  std::string path_;
  std::string_view text_;
  char separator_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  bool ended_by_line_end_ = true;
};

Status check_columns(const CsvTable& table) {
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (table.columns[i].empty()) continue;
    if (table.column(table.columns[i]) == i) continue;
    return Error{ErrorCode::bad_format, fmt::format("{}: line 1: expected each column once, found "
                                                    "'{}' twice",
                                                    table.path, table.columns[i])};
  }
  return ok_status();
}

}  // namespace

std::optional<std::size_t> CsvTable::column(std::string_view name) const {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const std::string& column) {
    return same_name(column, name);
  });
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
}

Result<CsvTable> read_csv(const std::string& path) {
  const Result<std::string> read = read_text(path, "a table of answers");
  if (!read) return read.error();
  std::string_view text = *read;
  if (text.find('\0') != std::string_view::npos) {
    return Error{ErrorCode::bad_format,
                 fmt::format("{}: expected text in UTF-8, found a zero byte", path)};
  }
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
    text.remove_prefix(kByteOrderMark.size());
  }
  Scanner scanner(path, text);
  CsvTable table;
  table.path = path;
  Result<std::optional<CsvRecord>> record = scanner.next();
  if (!record) return record.error();
  if (!record->has_value()) {
    return Error{ErrorCode::bad_format,
                 fmt::format("{}: expected a line of column names, found nothing", path)};
  }
  table.columns = std::move((*record)->fields);
  const Status distinct = check_columns(table);
  if (!distinct) return distinct.error();
  while (true) {
    record = scanner.next();
    if (!record) return record.error();
    if (!record->has_value()) return table;
    const std::size_t fields = (*record)->fields.size();
    if (fields < table.columns.size() && !scanner.ended_by_line_end()) {
      table.warnings.push_back(
          fmt::format("{}: cut off in line {}, which is left out", path, (*record)->line));
      return table;
    }
    if (fields != table.columns.size()) {
      return Error{ErrorCode::bad_format,
                   fmt::format("{}: line {}: expected {} fields, found {}", path, (*record)->line,
                               table.columns.size(), fields)};
    }
    table.records.push_back(std::move(**record));
  }
}

}  // namespace nade::study
