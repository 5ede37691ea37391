#pragma once

#include <fmt/format.h>

#include <string>

#include "nade/io/recording.h"

namespace nade::io {

/// Whether a file's name says that it holds a table: ".csv", ".csv.gz".
[[nodiscard]] bool names_a_table(const std::string& path);

/// Appends the names of the columns, or a row for each hand of a frame.
void append_csv_names(fmt::memory_buffer& out);
void append_csv_frame(const RecordedFrame& frame, fmt::memory_buffer& out);

}  // namespace nade::io
