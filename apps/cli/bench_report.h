#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nade/eval/compare.h"

namespace nade::cli {

/// Which part of the suite a case belongs to.
enum class CaseSet : std::uint8_t {
  strokes,
  held_out,  ///< strokes that nothing is tuned on
  scenes,    ///< what hands do beside strokes
};

/// What is known of a case beforehand.
struct BenchCase {
  std::string name;
  CaseSet set = CaseSet::strokes;
  bool is_flat = false;  ///< `SuiteCase::is_flat`
};

/// What `nade bench` found: every method in every case.
struct BenchReport {
  std::vector<std::string> methods;
  std::vector<BenchCase> cases;
  std::vector<CaseScore> scores;  ///< of methods within cases
  std::vector<Metrics> paper;     ///< by case: of the paper's method, which targets refer to

  [[nodiscard]] const CaseScore& at(std::size_t case_index, std::size_t method) const {
    return scores[case_index * methods.size() + method];
  }
};

/// Which cases a figure speaks of.
enum class FigureScope : std::uint8_t {
  everywhere,
  flat,  ///< where a palm could lie flat
};

/// One column of figures: a metric, or a time.
struct BenchFigure {
  std::string key;
  std::string unit;
  MetricTarget target;
  std::optional<double> (*time)(const CaseScore&) = nullptr;
  std::optional<double> Metrics::*metric = nullptr;
  FigureScope scope = FigureScope::everywhere;
};
/// Every metric, then those of flat cases alone, then the times.
[[nodiscard]] std::vector<BenchFigure> bench_figures();

/// A figure in one case by one method.
struct BenchValue {
  double value = 0.0;
  MetricBounds bounds;  ///< none where it has no target, or that is not known
};
/// No value where the case has none, or the figure does not speak of it.
[[nodiscard]] std::optional<BenchValue> value_of(const BenchReport& report,
                                                 const BenchFigure& figure, std::size_t case_index,
                                                 std::size_t method);

/// A figure of one method over cases.
struct BenchSummary {
  std::size_t measured = 0;  ///< cases that have a value
  std::size_t judged = 0;    ///< of those that have a target
  std::size_t met = 0;       ///< of those
  double median = 0.0;
  double worst = 0.0;
  std::size_t worst_case = 0;
  double shortfall = 0.0;  ///< mean distance from the target of the cases that miss it
};
/// Over all cases, or those of a set. No value where none of them has one.
[[nodiscard]] std::optional<BenchSummary> summary_of(const BenchReport& report, std::size_t method,
                                                     const BenchFigure& figure,
                                                     std::optional<CaseSet> set = std::nullopt);

/// The table for people; the tables of medians and of worst cases, and for each method the cases in
/// which it misses a target; one line a case, method and figure.
[[nodiscard]] std::string as_text(const BenchReport& report);
[[nodiscard]] std::string as_markdown(const BenchReport& report);
[[nodiscard]] std::string as_csv(const BenchReport& report);
[[nodiscard]] std::string as_json(const BenchReport& report);

}  // namespace nade::cli
