#pragma once

#include <string>
#include <vector>

#include "nade/study/analysis.h"
#include "nade/study/contact_metrics.h"
#include "nade/study/study_data.h"

namespace nade::study {

/// Everything that a report tells of.
struct ReportContent {
  const StudyData& data;
  const Analysis& analysis;
  const AnalysisOptions& options;
  const ContactMetrics& contact;
  std::string tool;                   ///< what made it: "nade 0.1.0"
  std::vector<std::string> pictures;  ///< that were drawn: "fig3.svg", …
  std::vector<std::string> problems;  ///< why others were not, a sentence each

  /// Everything odd that did not stop the analysis, a sentence each.
  [[nodiscard]] std::vector<std::string> remarks() const;
};

/// The report in Markdown: design, participants and who was left out, figure, tables, contact, how
/// everything was computed. Says SIMULATED in its title and first lines where the data are.
[[nodiscard]] std::string report_markdown(const ReportContent& content);

/// Every comparison with all its numbers, a row each.
[[nodiscard]] std::string comparisons_csv(const StudyData& data, const Analysis& analysis);

/// Every metric of every trial that was measured, a row each.
[[nodiscard]] std::string trial_metrics_csv(const StudyData& data, const ContactMetrics& contact);

}  // namespace nade::study
