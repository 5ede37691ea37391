#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nade/eval/compare.h"

namespace nade::cli {

/// What `nade bench` found: every method in every case.
struct BenchReport {
  std::vector<std::string> methods;
  std::vector<std::string> cases;  ///< their names
  std::vector<CaseScore> scores;   ///< of methods within cases
  std::vector<bool> held_out;      ///< by case: nothing is tuned on it

  [[nodiscard]] const CaseScore& at(std::size_t case_index, std::size_t method) const {
    return scores[case_index * methods.size() + method];
  }
};

/// One column of figures: a metric, or a time.
struct BenchFigure {
  std::string key;
  std::string unit;
  MetricTarget target;
  std::optional<double> (*time)(const CaseScore&) = nullptr;
  std::optional<double> Metrics::*metric = nullptr;

  [[nodiscard]] std::optional<double> of(const CaseScore& score) const {
    return metric != nullptr ? score.metrics.*metric : time(score);
  }
};
/// Every metric, then the times.
[[nodiscard]] std::vector<BenchFigure> bench_figures();

/// A figure of one method over the suite.
struct BenchSummary {
  std::size_t measured = 0;  ///< cases that have a value
  std::size_t met = 0;       ///< of those with a value; 0 without a target
  double median = 0.0;
  double worst = 0.0;
  std::size_t worst_case = 0;
  double shortfall = 0.0;  ///< mean distance from the target of the cases that miss it
};
enum class CaseSet : std::uint8_t { all, suite, held_out };
/// No value where no case of the set has one.
[[nodiscard]] std::optional<BenchSummary> summary_of(const BenchReport& report, std::size_t method,
                                                     const BenchFigure& figure,
                                                     CaseSet set = CaseSet::all);

/// The table for people; the tables of medians and of worst cases, and for each method the cases in
/// which it misses a target; one line a case, method and figure.
[[nodiscard]] std::string as_text(const BenchReport& report);
[[nodiscard]] std::string as_markdown(const BenchReport& report);
[[nodiscard]] std::string as_csv(const BenchReport& report);
[[nodiscard]] std::string as_json(const BenchReport& report);

}  // namespace nade::cli
