#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <map>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

#include "batch.h"
#include "command_files.h"
#include "commands.h"
#include "io/operating_system.h"
#include "nade/io/mesh_file.h"
#include "nade/io/output_file.h"
#include "nade/version.h"
#include "number_options.h"

namespace nade::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::array kEndings{".jsonl", ".json", ".csv", ".bvh", ".handsbin"};

bool is_recording_name(const fs::path& path) {
  if (path.filename() == kJournal) return false;
  return std::find(kEndings.begin(), kEndings.end(), content_ending_of(path.string())) !=
         kEndings.end();
}

bool is_hidden(const fs::path& path) { return path.filename().string().starts_with('.'); }

bool is_folder(const std::string& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

/// Pipes, sockets and devices would be waited for. A link to nothing is none of these.
bool is_file(const fs::directory_entry& entry) {
  std::error_code ignored;
  return entry.is_regular_file(ignored) || !entry.exists(ignored);
}

bool is_shut(const fs::directory_entry& folder) {
  return !folder.is_symlink() && !os::may_enter(folder.path());
}

}  // namespace

bool BatchOptions::many() const {
  return inputs.size() > 1 || fs::path(output).filename().empty() || is_folder(output) ||
         (inputs.size() == 1 && is_folder(inputs.front()));
}

std::size_t cores() { return std::max(1U, std::thread::hardware_concurrency()); }

void add_jobs_option(CLI::App& command, std::size_t& jobs) {
  command.add_option("--jobs", jobs, "of many recordings, so many at a time (default all cores)")
      ->type_name("N")
      ->transform(whole_number_in(1, 256));
}

void add_batch_options(CLI::App& command, BatchOptions& options) {
  command
      .add_option("input", options.inputs,
                  "the recording to read, - is stdin; or several, and folders of them")
      ->type_name("IN")
      ->required();
  command
      .add_option("-o,--output", options.output,
                  "the recording to write, - is stdout; of several the folder for them")
      ->type_name("OUT")
      ->required();
  command
      .add_option_function<std::string>(
          "--ending",
          [&options](const std::string& ending) {
            if (!is_recording_ending("x" + ending)) {
              throw CLI::ValidationError(
                  fmt::format("--ending: expected {}, found '{}'", kRecordingEndings, ending));
            }
            options.ending = ending;
          },
          "of what is written into a folder (default .jsonl.gz)")
      ->type_name("ENDING");
  add_jobs_option(command, options.jobs);
}

std::string stem_of(const std::string& recording) {
  fs::path path = recording;
  if (ending_of(recording) == ".gz") path.replace_extension();
  return path.replace_extension().string();
}

Result<std::vector<std::string>> recordings_in(const std::string& folder) {
  std::vector<std::string> found;
  std::error_code failed;
  fs::recursive_directory_iterator entry(folder, failed);
  for (; !failed && entry != fs::recursive_directory_iterator(); entry.increment(failed)) {
    std::error_code ignored;
    const bool hidden = is_hidden(entry->path());
    const bool is_directory = entry->is_directory(ignored);
    const std::string name = entry->path().lexically_relative(folder).string();
    if (is_directory && (hidden || is_shut(*entry))) {
      entry.disable_recursion_pending();
      // To be read as if it were a recording, which says why it cannot be.
      if (!hidden) found.push_back(name + "/");
    } else if (!hidden && !is_directory && is_recording_name(name) && is_file(*entry)) {
      found.push_back(name);
    }
  }
  if (failed) {
    return Error{ErrorCode::not_found,
                 fmt::format("{}: expected to read the folder, but: {}", folder, failed.message())};
  }
  std::sort(found.begin(), found.end());
  return found;
}

Result<std::vector<BatchItem>> batch_items(const BatchOptions& options) {
  std::vector<BatchItem> items;
  const auto add = [&](const fs::path& input, const std::string& within) {
    const fs::path output = fs::path(options.output) / (stem_of(within) + options.ending);
    items.push_back({input.string(), output.string()});
  };
  for (const std::string& input : options.inputs) {
    if (!is_folder(input)) {
      if (input == kStandardStream) {
        return misuse("IN: expected files or folders where there are several, found '-'");
      }
      add(input, fs::path(input).filename().string());
      continue;
    }
    const Result<std::vector<std::string>> found = recordings_in(input);
    if (!found) return found.error();
    for (const std::string& name : *found) {
      const fs::path path = fs::path(input) / name;
      // What an earlier run made is no input of this one.
      if (!lies_in(path.string(), options.output)) add(path, name);
    }
  }
  std::set<fs::path> inputs;
  std::error_code ignored;
  for (const BatchItem& item : items) inputs.insert(fs::weakly_canonical(item.input, ignored));
  std::map<std::string, std::string> taken;
  for (const BatchItem& item : items) {
    if (inputs.contains(fs::weakly_canonical(item.output, ignored))) {
      return misuse(fmt::format(
          "--output: expected a folder in which no input is replaced, found {}", options.output));
    }
    const auto [other, is_new] = taken.emplace(item.output, item.input);
    if (is_new) continue;
    return misuse(fmt::format("{} and {} would both become {}: rename one, or give their folder",
                              other->second, item.input, item.output));
  }
  if (items.empty()) {
    return Error{ErrorCode::not_found,
                 fmt::format("{}: expected recordings ({}, or .gz behind one of them), found none",
                             fmt::join(options.inputs, ", "), fmt::join(kEndings, ", "))};
  }
  return items;
}

std::string recipe_of(const CLI::App& command) {
  constexpr std::array kElsewhere{"input", "--output", "--jobs", "--json"};
  std::string recipe = fmt::format("nade {} {}", NADE_VERSION, command.get_name());
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    const bool elsewhere = std::any_of(kElsewhere.begin(), kElsewhere.end(), [&](const char* word) {
      return name.find(word) != std::string::npos;
    });
    if (option->count() == 0 || elsewhere) continue;
    recipe += fmt::format(" {} {}", name, fmt::join(option->results(), " "));
  }
  return recipe;
}

std::string stamp_of(const std::string& path) {
  std::error_code failed;
  const fs::file_time_type written = fs::last_write_time(path, failed);
  if (failed) return "none";
  const auto since_1970 = std::chrono::file_clock::to_sys(written).time_since_epoch();
  const auto seconds = std::chrono::floor<std::chrono::seconds>(since_1970);
  return fmt::format("{} bytes of {}.{:09}", fs::file_size(path, failed), seconds.count(),
                     std::chrono::nanoseconds(since_1970 - seconds).count());
}

}  // namespace nade::cli
