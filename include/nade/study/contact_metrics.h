#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "nade/eval/metrics.h"
#include "nade/study/analysis.h"
#include "nade/study/study_data.h"

namespace nade::study {

/// How the drawn hand met the object in one trial.
struct TrialMetrics {
  RecordedTrial trial;
  Metrics metrics;
};

struct ContactMetrics {
  std::vector<TrialMetrics> trials;
  /// Recordings that could not be measured and what was odd about others, a sentence each.
  std::vector<std::string> warnings;
};

/// Measures the recordings beside the answers, as `nade measure` does; a recording that cannot be
/// read is left out. `before_trial`, where given, is called before each.
[[nodiscard]] ContactMetrics measure_trials(const StudyData& data,
                                            const std::function<void()>& before_trial = {});

/// The metrics that a report gives for each condition: mean penetration, contact ratio, the 95th
/// percentile of the gap, linkage gain.
[[nodiscard]] std::span<const MetricInfo> reported_metrics();

/// A metric over the trials of a condition; of all objects where `object` is empty. No value where
/// it was measured in none.
struct MetricSummary {
  std::size_t trials = 0;
  Quartiles quartiles;
};
[[nodiscard]] std::optional<MetricSummary> summary_of(const ContactMetrics& contact,
                                                      const MetricInfo& metric,
                                                      const std::string& object,
                                                      const std::string& method);

}  // namespace nade::study
