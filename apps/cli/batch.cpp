#include "batch.h"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <unordered_map>
#include <utility>

#include "console.h"
#include "nade/io/output_file.h"

namespace nade::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// What was done in a folder, by output: a line of JSON each, so that nothing of a run that is
/// ended is lost but what it was at.
class Journal {
 public:
  explicit Journal(const std::string& folder) : path_(fs::path(folder) / kJournal) {
    std::ifstream file(path_);
    for (std::string line; std::getline(file, line);) {
      cut_off_ = file.eof();
      Json entry = Json::parse(line, nullptr, false);
      if (!entry.is_object() || !entry.contains("output")) continue;
      const std::string output = entry["output"].dump();
      done_.insert_or_assign(output, std::move(entry));
    }
  }

  /// The figures of an output that is there and would become the same.
  [[nodiscard]] std::optional<Json> find(const BatchItem& item, const std::string& recipe) const {
    const auto found = done_.find(Json(name(item)).dump());
    std::error_code ignored;
    if (found == done_.end() || !fs::exists(item.output, ignored)) return std::nullopt;
    const Json& entry = found->second;
    if (entry.value("input", Json()) != item.input ||
        entry.value("stamp", Json()) != stamp_of(item.input) ||
        entry.value("recipe", Json()) != recipe || !entry.contains("figures")) {
      return std::nullopt;
    }
    return entry["figures"];
  }

  /// What cannot be kept is done again next time.
  void add(const BatchItem& item, const std::string& stamp, const std::string& recipe,
           const Json& figures) {
    const Json entry{{"output", name(item)},
                     {"input", item.input},
                     {"stamp", stamp},
                     {"recipe", recipe},
                     {"figures", figures}};
    std::string line = std::exchange(cut_off_, false) ? "\n" : "";
    line += entry.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    std::ofstream(path_, std::ios::app) << line;
  }

 private:
  [[nodiscard]] std::string name(const BatchItem& item) const {
    return fs::path(item.output).lexically_relative(path_.parent_path()).string();
  }

  fs::path path_;
  std::unordered_map<std::string, Json> done_;
  bool cut_off_ = false;  ///< in the middle of its last line
};

/// Sums over recordings, and what went wrong.
struct Outcome {
  std::size_t done = 0;
  std::size_t skipped = 0;
  std::vector<std::optional<Error>> failures;  ///< by item
  Json sums = Json::object();                  ///< of all figures
  double new_frames = 0.0;

  void add(const Json& figures) {
    for (const auto& [key, value] : figures.items()) {
      if (value.is_number()) sums[key] = sums.value(key, 0.0) + value.get<double>();
    }
  }
};

void add_row(std::string& text, const std::string& name, const std::string& value) {
  fmt::format_to(std::back_inserter(text), "{:<24}{:>14}\n", name, value);
}

std::string table_of(const Outcome& outcome, const std::string& done, double took_s,
                     std::size_t jobs) {
  std::string text;
  add_row(text, "recordings", std::to_string(outcome.failures.size()));
  add_row(text, done, std::to_string(outcome.done));
  add_row(text, "done before", std::to_string(outcome.skipped));
  add_row(text, "failed", std::to_string(outcome.failures.size() - outcome.done - outcome.skipped));
  for (const auto& [key, value] : outcome.sums.items()) {
    add_row(text, key, fmt::format("{:.0f}", value.get<double>()));
  }
  add_row(text, "took", fmt::format("{:.1f} s", took_s));
  if (outcome.new_frames > 0.0 && took_s > 0.0) {
    add_row(text, fmt::format("frames a second, {} job{}", jobs, jobs == 1 ? "" : "s"),
            fmt::format("{:.0f}", outcome.new_frames / took_s));
  }
  return text;
}

Status make_folder_of(const std::string& file) {
  const fs::path folder = fs::path(file).parent_path();
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (!failed) return ok_status();
  return Error{ErrorCode::unwritable, fmt::format("{}: expected to make the folder, but: {}",
                                                  folder.string(), failed.message())};
}

}  // namespace

void on_threads(std::size_t jobs, std::size_t count, const std::string& done,
                const std::function<void(std::size_t index, std::size_t worker)>& work) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  Progress progress(done, count, "recordings");
  const auto take = [&](std::size_t worker) {
    for (std::size_t i = next++; i < count; i = next++) {
      work(i, worker);
      const std::scoped_lock lock(mutex);
      progress.step();
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t worker = 1; worker < std::min(jobs, count); ++worker) {
    threads.emplace_back(take, worker);
  }
  take(0);
  for (std::thread& thread : threads) thread.join();
}

Status run_batch(const BatchOptions& options, const std::string& recipe, const std::string& done,
                 const BatchWork& work) {
  const auto start = std::chrono::steady_clock::now();
  const Result<std::vector<BatchItem>> items = batch_items(options);
  if (!items) return items.error();
  if (const Status made = make_folder_of(options.output + "/"); !made) return made;
  Journal journal(options.output);
  Outcome outcome;
  outcome.failures.resize(items->size());
  std::mutex mutex;
  const std::size_t jobs = options.jobs > 0 ? options.jobs : cores();
  on_threads(jobs, items->size(), done, [&](std::size_t index, std::size_t worker) {
    const BatchItem& item = (*items)[index];
    if (const auto figures = journal.find(item, recipe)) {
      const std::scoped_lock lock(mutex);
      ++outcome.skipped;
      outcome.add(*figures);
      return;
    }
    // Before it is read: of what changes meanwhile, it is the old one that is done.
    const std::string stamp = stamp_of(item.input);
    const Status made = make_folder_of(item.output);
    const Result<Json> figures = made ? work(item, worker) : Result<Json>(made.error());
    const std::scoped_lock lock(mutex);
    if (!figures) {
      outcome.failures[index] = figures.error();
      return;
    }
    ++outcome.done;
    outcome.add(*figures);
    outcome.new_frames += figures->value("frames", 0.0);
    journal.add(item, stamp, recipe, *figures);
  });
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  for (const auto& failure : outcome.failures) {
    if (failure) warn(failure->message);
  }
  const Status written =
      write_whole("-", table_of(outcome, done, took.count(), std::min(jobs, items->size())));
  if (!written) return written;
  const std::size_t failed = items->size() - outcome.done - outcome.skipped;
  if (failed == 0) return ok_status();
  return Error{ErrorCode::bad_value,
               fmt::format("{} of {} recordings could not be {}", failed, items->size(), done)};
}

}  // namespace nade::cli
