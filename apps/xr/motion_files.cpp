#include "motion_files.h"

#include <fmt/format.h>

#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "nade/io/object_file.h"

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
  if (as.method == Method::nade) {
    if (as.settle.softness_m > 0.0) json["softness"] = as.settle.softness_m;
    const double friction = as.settle.friction.coefficient;
    if (friction > 0.0) json["friction"] = friction;
  }
  files.corrected_header.unknown_json = json.dump();
  std::error_code ignored;  // what cannot be taken away is told when it is written
  std::filesystem::remove(files.tracked_path, ignored);
  std::filesystem::remove(files.corrected_path, ignored);
  return files;
}

}  // namespace nade::xr
