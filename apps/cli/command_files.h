#pragma once

#include <optional>
#include <string>
#include <vector>

#include "nade/status.h"

namespace nade::cli {

/// Standard input where a file is to be read, standard output where one is to be written.
inline constexpr const char* kStandardStream = "-";

/// A file of the command line.
struct NamedFile {
  std::string name;                 ///< what the command line calls it: "--json", "IN"
  std::optional<std::string> path;  ///< without one it was not given
};

/// Refuses two outputs that are one file, and an output that is an input, too: what was there
/// would be lost. Pipes and devices may be given twice; standard output may not.
[[nodiscard]] Status check_apart(const std::vector<NamedFile>& outputs,
                                 const std::vector<NamedFile>& inputs);

/// What a recording's name may end in, in words, and whether one does.
inline constexpr const char* kRecordingEndings = ".jsonl, .jsonl.gz, .csv, .csv.gz, .mcap or .glb";
[[nodiscard]] bool is_recording_ending(const std::string& name);

/// Refuses a recording's name with an ending that says it is something else. One without an
/// ending, standard output, pipes and devices are none.
[[nodiscard]] Status check_recording_name(const std::string& option, const std::string& name);

/// Whether a path is a folder, or lies in it.
[[nodiscard]] bool lies_in(const std::string& path, const std::string& folder);

}  // namespace nade::cli
