#include <fmt/format.h>

#include <iterator>
#include <optional>

#include "nade/io/csv.h"
#include "nade/study/report.h"

namespace nade::study {
namespace {

/// A further field; empty where there is no number.
void add_number(std::string& text, const std::optional<double>& value) {
  text += ',';
  if (value) fmt::format_to(std::back_inserter(text), "{:.10g}", *value);
}

/// Every file that invented data lead to says so.
std::string mark_column(const StudyData& data) { return data.simulated ? ",simulated" : ""; }
std::string mark(const StudyData& data) { return data.simulated ? ",SIMULATED" : ""; }

void add_comparison(std::string& text, const StudyData& data, const Analysis& analysis,
                    const Comparison& comparison) {
  const auto& [question, object, method, before, after, dropped, pratt, interval, p, holm,
               holm_pratt] = comparison;
  fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{}", csv_field(question),
                 object.empty() ? "averaged" : csv_field(object),
                 csv_field(analysis.methods.front()), csv_field(method), dropped.pairs,
                 dropped.zeros);
  for (const double value : {before.lower, before.median, before.upper, after.lower, after.median,
                             after.upper, dropped.w_plus, dropped.w_minus}) {
    add_number(text, value);
  }
  for (const std::optional<double>& value :
       {dropped.p_exact, dropped.p_corrected, dropped.p_normal}) {
    add_number(text, value);
  }
  for (const double value :
       {holm, dropped.rank_biserial, interval.low, interval.high, pratt.w_plus, pratt.w_minus}) {
    add_number(text, value);
  }
  for (const std::optional<double>& value : {pratt.p_exact, pratt.p_corrected, pratt.p_normal}) {
    add_number(text, value);
  }
  add_number(text, holm_pratt);
  add_number(text, pratt.rank_biserial);
  text += mark(data) + "\n";
}

}  // namespace

std::string comparisons_csv(const StudyData& data, const Analysis& analysis) {
  std::string text =
      "question,object,baseline,method,n,zeros,"
      "baseline_lower_quartile,baseline_median,baseline_upper_quartile,"
      "method_lower_quartile,method_median,method_upper_quartile,"
      "w_plus,w_minus,p_exact,p_corrected,p_normal,p_holm,"
      "rank_biserial,rank_biserial_low,rank_biserial_high,"
      "w_plus_pratt,w_minus_pratt,p_exact_pratt,p_corrected_pratt,p_normal_pratt,p_holm_pratt,"
      "rank_biserial_pratt" +
      mark_column(data) + "\n";
  for (const std::vector<Comparison>* family : {&analysis.averaged, &analysis.by_object}) {
    for (const Comparison& comparison : *family) add_comparison(text, data, analysis, comparison);
  }
  return text;
}

std::string trial_metrics_csv(const StudyData& data, const ContactMetrics& contact) {
  std::string text = "participant,object,method,frames,pressing_frames";
  for (const MetricInfo& info : metric_table()) text += std::string(",") + info.key;
  text += mark_column(data) + "\n";
  for (const TrialMetrics& measured : contact.trials) {
    const auto& [trial, metrics] = measured;
    text += fmt::format("{},{},{},{},{}", csv_field(trial.participant), csv_field(trial.object),
                        csv_field(trial.method), metrics.frames, metrics.pressing_frames);
    for (const MetricInfo& info : metric_table()) add_number(text, metrics.*info.value);
    text += mark(data) + "\n";
  }
  return text;
}

}  // namespace nade::study
