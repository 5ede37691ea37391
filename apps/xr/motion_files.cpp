#include "motion_files.h"

#include <fmt/format.h>

#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "nade/io/object_file.h"
#include "nade/io/output_file.h"
#include "nade/version.h"

namespace nade::xr {
namespace {

std::string now_as_text() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", parts.tm_year + 1900, parts.tm_mon + 1,
                     parts.tm_mday, parts.tm_hour, parts.tm_min, parts.tm_sec);
}

std::string with_word(const std::string& path, const std::string& word) {
  const std::string_view whole(path);
  for (const std::string_view ending : {".jsonl.gz", ".jsonl", ".gz"}) {
    if (whole.size() > ending.size() && whole.ends_with(ending)) {
      return path.substr(0, path.size() - ending.size()) + word + std::string(ending);
    }
  }
  return path + word;
}

bool is_there(const std::string& path) {
  std::error_code none;
  return std::filesystem::exists(std::filesystem::symlink_status(path, none));
}

}  // namespace

std::string corrected_path(const std::string& path) { return with_word(path, "-corrected"); }

std::string numbered_path(const std::string& path, int number) {
  return number == 1 ? path : with_word(path, fmt::format("-{}", number));
}

study::MotionFiles motion_files(const std::string& path, const RecordedAs& as) {
  study::MotionFiles files;
  files.tracked_path = path;
  files.corrected_path = corrected_path(path);
  files.tracked_header.source = "openxr";
  files.tracked_header.created = now_as_text();
  files.tracked_header.hand_scale_known = true;
  auto json = nlohmann::ordered_json::parse(
      with_placing({}, {as.object, as.placement, as.animation_start_ns}));
  json["headset"] = as.headset;
  json["tool"] = fmt::format("nade {}", NADE_VERSION);
  files.tracked_header.unknown_json = json.dump();
  files.corrected_header = files.tracked_header;
  json["method"] = name_of(as.method);
  files.corrected_header.unknown_json =
      as.method == Method::nade ? with_settle(json.dump(), as.settle) : json.dump();
  std::error_code ignored;  // what cannot be taken away is told when it is written
  std::filesystem::remove(files.tracked_path, ignored);
  return files;
}

Status check_recordable(const std::string& path) {
  std::error_code none;
  if (path == "-" || std::filesystem::is_other(path, none)) {
    return Error{ErrorCode::out_of_range,
                 fmt::format("--record: expected the name of a file, found {}", path)};
  }
  const std::string beside = corrected_path(path);
  if (is_there(beside)) {
    return Error{
        ErrorCode::unwritable,
        fmt::format("{}: the corrected hands of --record {} would replace it: move it away, "
                    "or record elsewhere",
                    beside, path)};
  }
  const auto opened = OutputFile::create(path, OutputFile::Encoding::plain);
  return opened ? ok_status() : Status(opened.error());
}

int next_number(const std::string& path, int number) {
  do {
    ++number;
  } while (is_there(numbered_path(path, number)) ||
           is_there(corrected_path(numbered_path(path, number))));
  return number;
}

}  // namespace nade::xr
