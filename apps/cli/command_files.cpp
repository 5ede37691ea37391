#include "command_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "commands.h"
#include "nade/io/output_file.h"

namespace nade::cli {
namespace {

namespace fs = std::filesystem;

/// Where a file is, or would be; links are followed.
fs::path place_of(const std::string& path) {
  std::error_code failed;
  const fs::path place = fs::weakly_canonical(fs::absolute(path, failed), failed);
  return failed ? fs::path(path).lexically_normal() : place;
}

bool same_file(const std::string& a, const std::string& b) {
  std::error_code failed;
  if (fs::is_other(a, failed)) return false;
  return fs::equivalent(a, b, failed) || place_of(a) == place_of(b);
}

}  // namespace

Status check_apart(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs) {
  std::vector<NamedFile> taken = inputs;
  std::erase_if(
      taken, [](const NamedFile& input) { return !input.path || *input.path == kStandardStream; });
  for (const NamedFile& output : outputs) {
    if (!output.path) continue;
    for (const NamedFile& other : taken) {
      if (!same_file(*other.path, *output.path)) continue;
      if (*output.path == kStandardStream) {
        return misuse(
            fmt::format("{} and {} cannot both be standard output", other.name, output.name));
      }
      return misuse(fmt::format("{}: expected another file than that of {}, found {}", output.name,
                                other.name, *output.path));
    }
    taken.push_back(output);
  }
  return ok_status();
}

bool is_recording_ending(const std::string& name) {
  const std::string ending = content_ending_of(name);
  return ending == ".jsonl" || ending == ".csv" ||
         ((ending == ".glb" || ending == ".mcap") &&
          OutputFile::encoding_of(name) == OutputFile::Encoding::plain);
}

Status check_recording_name(const std::string& option, const std::string& name) {
  std::error_code ignored;
  if (name == kStandardStream || fs::is_other(name, ignored)) return ok_status();
  const std::string ending = content_ending_of(name);
  if (ending.empty() || is_recording_ending(name)) return ok_status();
  return misuse(
      fmt::format("{}: expected a name ending in {}, found '{}'", option, kRecordingEndings, name));
}

bool lies_in(const std::string& path, const std::string& folder) {
  const fs::path inside = place_of(path);
  const fs::path outside = place_of(folder + "/.");
  return std::mismatch(outside.begin(), outside.end(), inside.begin(), inside.end()).first ==
         outside.end();
}

}  // namespace nade::cli
