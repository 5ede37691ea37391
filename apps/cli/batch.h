#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "nade/status.h"

namespace nade::cli {

/// What was done in a folder, for the next run.
inline constexpr const char* kJournal = "nade-done.jsonl";

/// The recordings a command works on, and where what comes of each goes: one file to one file, or
/// several files and folders into a folder.
struct BatchOptions {
  std::vector<std::string> inputs;
  std::string output;
  std::string ending = ".jsonl.gz";  ///< of what is written into a folder
  std::size_t jobs = 0;              ///< recordings worked on at a time; 0: as many as cores

  /// Several inputs, or a folder as input or output.
  [[nodiscard]] bool many() const;
};

/// IN..., -o OUT, --ending and --jobs.
void add_batch_options(CLI::App& command, BatchOptions& options);
/// --jobs alone.
void add_jobs_option(CLI::App& command, std::size_t& jobs);
[[nodiscard]] std::size_t cores();

/// All recordings of a folder and its folders by their names' endings, in the order of their
/// paths, against it; hidden ones, pipes and devices are left out. A folder among them that may not
/// be entered is one, too, with "/" behind its name. The error names the folder.
[[nodiscard]] Result<std::vector<std::string>> recordings_in(const std::string& folder);

/// A recording's name without the endings that say how it is written: "a/b" of "a/b.csv.gz".
[[nodiscard]] std::string stem_of(const std::string& recording);

/// One of many.
struct BatchItem {
  std::string input;
  std::string output;
};

/// The items of `options`, in order. The error names two inputs that would become one output, or
/// what cannot be read.
[[nodiscard]] Result<std::vector<BatchItem>> batch_items(const BatchOptions& options);

/// The words of a command that decide what it writes: what is done by the same words, from the same
/// input by the same version, need not be done again.
[[nodiscard]] std::string recipe_of(const CLI::App& command);

/// What is known of a file without reading it: its size and when it changed.
[[nodiscard]] std::string stamp_of(const std::string& path);

/// Makes an item's output. Gives what was done as a JSON object of numbers, with "frames" and
/// "seconds" among them. Called on several threads, each of which has a number from 0.
using BatchWork =
    std::function<Result<nlohmann::ordered_json>(const BatchItem& item, std::size_t worker)>;

/// Does all of it, as far as it is not done: keeps a line for each output in nade-done.jsonl beside
/// them. Goes on past what fails; at the end a table of sums on standard output, and the failures'
/// sentences. `done` says what was done with a recording: "corrected". An error where any failed.
[[nodiscard]] Status run_batch(const BatchOptions& options, const std::string& recipe,
                               const std::string& done, const BatchWork& work);

/// Calls `work` with each index below `count` and a worker's number, on so many threads, and shows
/// how far it is.
void on_threads(std::size_t jobs, std::size_t count, const std::string& done,
                const std::function<void(std::size_t index, std::size_t worker)>& work);

}  // namespace nade::cli
