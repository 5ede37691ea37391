#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "measure_report.h"
#include "nade/status.h"

namespace nade::cli {

/// A data set: a folder of tracked recordings, and of what became of them.
struct MeasureMany {
  std::string tracked;
  std::string corrected;  ///< empty: each NAME-corrected lies beside its NAME
  std::optional<std::string> json;
  std::optional<std::string> csv;
  std::size_t jobs = 0;  ///< 0: as many as cores
};

/// Measures each corrected recording against the tracked one of the same name by `measure`, on
/// several threads: a row for each, and over all of them each metric's median, the worst with its
/// recording, and in how many its target is met. Goes on past what fails, and is an error then.
[[nodiscard]] Status measure_many(
    const MeasureMany& set,
    const std::function<Result<MeasureReport>(const std::string& tracked,
                                              const std::string& corrected)>& measure);

}  // namespace nade::cli
