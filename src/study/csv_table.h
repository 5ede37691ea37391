#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nade/status.h"

namespace nade::study {

/// A line of a table: as many fields as there are columns, without the blanks around them.
struct CsvRecord {
  std::size_t line = 0;  ///< where it begins, from 1
  std::vector<std::string> fields;
};

/// A table of text with a line of names at its top.
struct CsvTable {
  std::string path;
  std::vector<std::string> columns;
  std::vector<CsvRecord> records;
  /// What was odd but not fatal, a sentence each.
  std::vector<std::string> warnings;

  /// The place of a column by its name; capitals do not matter.
  [[nodiscard]] std::optional<std::size_t> column(std::string_view name) const;
};

/// Reads a table as spreadsheets write them: commas, semicolons or tabs, quotes, either line end,
/// with or without a byte order mark. A last line that was cut off is left out, with a warning.
/// The error names file and line.
[[nodiscard]] Result<CsvTable> read_csv(const std::string& path);

}  // namespace nade::study
