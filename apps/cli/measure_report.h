#pragma once

#include <array>
#include <optional>
#include <string>

#include "nade/eval/metrics.h"
#include "nade/hand.h"

namespace nade::cli {

/// What `nade measure` found, and of what.
struct MeasureReport {
  std::string tracked;
  std::string corrected;
  std::string method;  ///< as the corrected recording's header has it; may be empty
  std::string object;
  double hand_scale = 1.0;
  Metrics both;
  std::array<std::optional<Metrics>, 2> hands{};  ///< by index_of(Handedness); those seen
};

/// A table for people: each metric with its target and whether that is met.
[[nodiscard]] std::string as_text(const MeasureReport& report);

/// One JSON object: the metrics over both hands under their keys, those of each hand under
/// "hands"; null where there was nothing to measure.
[[nodiscard]] std::string as_json(const MeasureReport& report);

/// The names and the values of a row, over both hands; empty where nothing was measured.
[[nodiscard]] std::string csv_names();
[[nodiscard]] std::string csv_values(const MeasureReport& report);

}  // namespace nade::cli
