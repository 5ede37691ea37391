#include "nade/study/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string_view>

#include "nade/study/figure.h"

namespace nade::study {
namespace {

constexpr std::string_view kSimulated =
    "> **SIMULATED.** Some or all of these answers were invented by a program to try out the\n"
    "> analysis. They say nothing about people and nothing about any method.\n\n";

constexpr std::string_view kMethods =
    R"(- Each person's answer under a method is paired with the same person's answer without correction.
  "Averaged" pairs each person's mean over all objects; answers are never pooled over objects as if
  they came from different people.
- Medians and quartiles: linear between order statistics (R's type 7) [1].
- W+: sum of the ranks of the pairs in which the method was rated higher; midranks under ties.
- p exact: two-sided, from the permutation distribution of these ranks, ties and all [2, 3], with
  pairs without a difference dropped as Wilcoxon has it [2], and ranked but left out as Pratt has
  it [4]. With ties R's `wilcox.test` gives no exact p; its `coin::wilcoxsign_test` does.
- p normal: zeros dropped, continuity correction, as R's `wilcox.test(exact = FALSE)` gives it.
- p Holm: the exact p with zeros dropped, adjusted by Holm [5] within its table. Marks follow
  it: ** below 0.01, * below 0.05.
- r: matched-pairs rank-biserial correlation (W+ - W-) / (W+ + W-), zeros dropped [6], with
  a {:.0f} % percentile bootstrap interval over persons [7], {} resamples, seed {}. An interval
  without width only says that all differences have the same sign.
- Boxes in the figures show the quartiles and the median of all answers drawn beside them, whiskers
  the farthest answers within one and a half box lengths [8]; every dot is one answer, moved aside
  a little so that it can be seen.

1. Hyndman, Fan. Sample Quantiles in Statistical Packages. 1996.
2. Wilcoxon. Individual Comparisons by Ranking Methods. 1945.
3. Streitberg, Röhmel. Exact Distributions for Permutation and Rank Tests. 1986.
4. Pratt. Remarks on Zeros and Ties in the Wilcoxon Signed Rank Procedures. 1959.
5. Holm. A Simple Sequentially Rejective Multiple Test Procedure. 1979.
6. Kerby. The Simple Difference Formula: An Approach to Teaching Nonparametric Correlation. 2014.
7. Efron, Tibshirani. An Introduction to the Bootstrap. 1993.
8. Tukey. Exploratory Data Analysis. 1977.
)";

/// Up to two decimals, no zeros at the end.
std::string shown(double value) {
  std::string text = fmt::format("{:.2f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string shown(const Quartiles& quartiles) {
  return fmt::format("{} [{}, {}]", shown(quartiles.median), shown(quartiles.lower),
                     shown(quartiles.upper));
}

/// Three digits that count, at least three decimals.
std::string shown_p(const std::optional<double>& p) {
  if (!p) return "-";
  const int decimals =
      *p > 0.0 ? std::clamp(2 - static_cast<int>(std::floor(std::log10(*p))), 3, 12) : 3;
  return fmt::format("{:.{}f}", *p, decimals);
}

/// A text in a table's cell.
std::string cell(std::string_view text) {
  std::string result;
  for (const char character : text) {
    if (character == '|') result += '\\';
    result += character == '\n' ? ' ' : character;
  }
  return result;
}

std::string listed(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

class Report {
 public:
  explicit Report(const ReportContent& content) : content_(content) {}

  std::string text() {
    add_head();
    add_design();
    add_participants();
    add_answers();
    add_contact();
    add_methods();
    add_remarks();
    return std::move(text_);
  }

 private:
  [[nodiscard]] const StudyData& data() const { return content_.data; }
  [[nodiscard]] const Analysis& analysis() const { return content_.analysis; }

  template <class... Values>
  void add(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
  }

  void add_head() {
    const std::string title = data().plan ? data().plan->title : std::string();
    add("# {}{}\n\n", data().simulated ? "SIMULATED: " : "",
        title.empty() ? "Answers of a stroking study" : title);
    if (data().simulated) text_ += kSimulated;
    add("Made by {} from `{}`.\n\n", content_.tool, data().source);
  }

  void add_design() {
    text_ += "## Design\n\n";
    add("Objects: {}. Methods: {}; the others are compared with `{}`.\n", listed(data().objects),
        listed(data().methods), analysis().methods.front());
    if (data().plan) {
      const Plan& plan = *data().plan;
      add("Each object under each method for {:g} s, {}.\n", plan.trial_s,
          plan.order == OrderKind::latin ? "in the orders of a balanced Latin square"
                                         : "in an order random for each participant");
    }
    add("Answers from {:g} to {:g}", data().scale_low, data().scale_high);
    if (data().plan) {
      add(" ({:g}: {}; {:g}: {})", data().scale_low, data().plan->scale.low.in(Language::english),
          data().scale_high, data().plan->scale.high.in(Language::english));
    }
    text_ += ".\n\n";
    for (const Question& question : data().questions) {
      const std::string& english = question.text.english;
      const std::string& japanese = question.text.japanese;
      add("- **{}**{}{}{}{}\n", question.id, english.empty() ? "" : " ", english,
          japanese.empty() ? "" : " / ", japanese);
    }
    text_ += '\n';
  }

  void add_participants() {
    std::set<std::string> incomplete;
    for (const MissingAnswers& missing : analysis().missing) incomplete.insert(missing.participant);
    add("## Participants\n\n{} participants, {} answers; {} answered everything.\n\n",
        data().participants.size(), data().answers.size(),
        data().participants.size() - incomplete.size());
    if (incomplete.empty()) return;
    text_ +=
        "Left out of every comparison that needs an answer they did not give, and of the average "
        "over the objects to that question:\n\n"
        "| participant | object | method | questions | why |\n|---|---|---|---|---|\n";
    for (const MissingAnswers& missing : analysis().missing) {
      add("| {} | {} | {} | {} | {} |\n", cell(missing.participant), cell(missing.object),
          cell(missing.method), cell(listed(missing.questions)), cell(missing.why));
    }
    text_ += '\n';
  }

  void add_answers() {
    text_ += "## Answers\n\n";
    add_picture("fig3",
                "Answers to each question without and with correction, all objects "
                "together. Brackets: averaged over the objects");
    add("### Averaged over the objects\n\n");
    add_family(analysis().averaged, "");
    add_words();
    add_picture("fig3_by_object", "The same for each object. Brackets: per object");
    add("### Per object\n\n");
    add_family(analysis().by_object, " object |");
    add_disagreements();
  }

  void add_picture(std::string_view name, std::string_view caption) {
    const std::string file = fmt::format("{}.png", name);
    const auto& pictures = content_.pictures;
    if (std::find(pictures.begin(), pictures.end(), file) == pictures.end()) return;
    const std::string_view mark = data().simulated ? "SIMULATED. " : "";
    add("![{0}{1}]({2})\n\n*{0}{1}, Holm-adjusted: \\*\\* p < 0.01, \\* p < 0.05.*\n\n", mark,
        caption, file);
  }

  void add_family(const std::vector<Comparison>& family, std::string_view object_column) {
    if (family.empty()) {
      text_ += "Nobody answered everything that this needs.\n\n";
      return;
    }
    const bool several = analysis().methods.size() > 2;
    add("| question |{}{} n | `{}`: median [quartiles] | {} | W+ | p exact, zeros dropped | p "
        "exact, "
        "Pratt | p normal | p Holm | | r [{:.0f} % interval] |\n",
        object_column, several ? " method |" : "", analysis().methods.front(),
        several ? "method" : "`" + analysis().methods.back() + "`",
        100.0 * content_.options.bootstrap.confidence);
    add("|---|{}{}--:|---|---|--:|--:|--:|--:|--:|---|---|\n", object_column.empty() ? "" : "---|",
        several ? "---|" : "");
    for (const Comparison& comparison : family) add_row(comparison, several);
    add("\n{} comparison{} adjusted together.{}\n\n", family.size(), family.size() == 1 ? "" : "s",
        data().simulated ? " SIMULATED." : "");
  }

  void add_row(const Comparison& comparison, bool several) {
    const std::string object =
        comparison.object.empty() ? "" : fmt::format(" {} |", cell(comparison.object));
    const std::string method = several ? fmt::format(" `{}` |", cell(comparison.method)) : "";
    const SignedRankTest& test = comparison.dropped;
    const std::string zeros = test.zeros > 0 ? fmt::format(" ({} zero)", test.zeros) : "";
    add("| {} |{}{} {}{} | {} | {} | {} | {} | {} | {} | {} | {} | {} [{}, {}] |\n",
        cell(comparison.question), object, method, test.pairs, zeros,
        shown(comparison.baseline_answers), shown(comparison.method_answers), shown(test.w_plus),
        shown_p(test.p_exact), shown_p(comparison.pratt.p_exact), shown_p(test.p_corrected),
        shown_p(comparison.p_holm), mark_of(comparison), shown(test.rank_biserial),
        shown(comparison.effect_interval.low), shown(comparison.effect_interval.high));
  }

  /// As Markdown takes it.
  static std::string mark_of(const Comparison& comparison) {
    std::string mark;
    for (const char character : significance_mark(comparison.p_holm)) {
      if (character == '*') mark += '\\';
      mark += character;
    }
    return mark;
  }

  void add_words() {
    for (const Comparison& comparison : analysis().averaged) {
      const SignedRankTest& test = comparison.dropped;
      const std::string_view direction = test.w_plus > test.w_minus   ? "higher"
                                         : test.w_plus < test.w_minus ? "lower"
                                                                      : "neither higher nor lower";
      add("- {}: with `{}` {} than with `{}` (median {} against {}, n = {}, W+ = {}, p = {}, Holm "
          "{}, r = {}){}.\n",
          comparison.question, comparison.method, direction, analysis().methods.front(),
          shown(comparison.method_answers.median), shown(comparison.baseline_answers.median),
          test.pairs, shown(test.w_plus), shown_p(comparison.p), shown_p(comparison.p_holm),
          shown(test.rank_biserial),
          comparison.p_holm < 0.05 ? "" : ", which chance alone may explain");
    }
    text_ += '\n';
  }

  /// Where it matters what becomes of pairs without a difference, the reader has to know.
  void add_disagreements() {
    for (const std::vector<Comparison>* family : {&analysis().averaged, &analysis().by_object}) {
      for (const Comparison& comparison : *family) {
        if ((comparison.p_holm < 0.05) == (comparison.p_holm_pratt < 0.05)) continue;
        add("{}, {}: the verdict depends on what becomes of pairs without a difference (Holm {} "
            "with zeros dropped, {} with Pratt's).\n\n",
            comparison.question,
            comparison.object.empty() ? std::string("averaged") : comparison.object,
            shown_p(comparison.p_holm), shown_p(comparison.p_holm_pratt));
      }
    }
  }

  void add_contact() {
    text_ += "## Contact\n\n";
    if (content_.contact.trials.empty()) {
      text_ += "No recordings lie beside the answers, so contact was not measured.\n\n";
      return;
    }
    add("Of the drawn hand in {} recorded trials: median [quartiles] over trials, measured as "
        "`nade measure` does (docs/metrics.md). Skin inside the object leaves no gap, so "
        "penetration and gap belong together.{}\n\n| object | method | trials |",
        content_.contact.trials.size(), data().simulated ? " SIMULATED." : "");
    for (const MetricInfo& info : reported_metrics()) add(" `{}` |", info.key);
    text_ += "\n|---|---|--:|";
    for (std::size_t i = 0; i < reported_metrics().size(); ++i) text_ += "---|";
    text_ += '\n';
    for (const std::string& object : data().objects) {
      for (const std::string& method : analysis().methods) add_condition(object, method);
    }
    if (data().objects.size() > 1) {
      for (const std::string& method : analysis().methods) add_condition("", method);
    }
    text_ += '\n';
  }

  void add_condition(const std::string& object, const std::string& method) {
    const auto& trials = content_.contact.trials;
    const auto count = std::count_if(trials.begin(), trials.end(), [&](const TrialMetrics& one) {
      return one.trial.method == method && (object.empty() || one.trial.object == object);
    });
    if (count == 0) return;
    add("| {} | `{}` | {} |", object.empty() ? "all" : cell(object), cell(method), count);
    for (const MetricInfo& info : reported_metrics()) {
      const auto summary = summary_of(content_.contact, info, object, method);
      add(" {} |", summary ? shown(summary->quartiles) : "-");
    }
    text_ += '\n';
  }

  void add_methods() {
    text_ += "## How it was computed\n\n";
    const BootstrapOptions& bootstrap = content_.options.bootstrap;
    text_ +=
        fmt::format(kMethods, 100.0 * bootstrap.confidence, bootstrap.resamples, bootstrap.seed);
    text_ += '\n';
  }

  void add_remarks() {
    const std::vector<std::string> remarks = content_.remarks();
    text_ += "## Files\n\n`comparisons.csv`: every comparison with all its numbers.\n";
    if (!content_.contact.trials.empty()) {
      text_ += "`metrics.csv`: every metric of every recorded trial.\n";
    }
    text_ +=
        "`fig3.gp`, `fig3_by_object.gp` and the `.dat` files beside them: the figures, to be drawn "
        "anew by gnuplot.\n";
    if (remarks.empty()) return;
    text_ += "\n## Remarks\n\n";
    for (const std::string& remark : remarks) add("- {}\n", remark);
  }

  const ReportContent& content_;
  std::string text_;
};

}  // namespace

std::vector<std::string> ReportContent::remarks() const {
  std::vector<std::string> all = data.warnings;
  all.insert(all.end(), contact.warnings.begin(), contact.warnings.end());
  all.insert(all.end(), problems.begin(), problems.end());
  return all;
}

std::string report_markdown(const ReportContent& content) { return Report(content).text(); }

}  // namespace nade::study
