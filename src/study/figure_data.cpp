#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "answer_sheet.h"
#include "nade/study/figure.h"
#include "nade/study/statistics.h"

namespace nade::study {
namespace {

// Of the places of methods across, and of the answers' scale up.
constexpr double kDotRow = 0.78;       ///< the widest a row of equal answers may be
constexpr double kDotStep = 0.075;     ///< between the dots of a shorter row
constexpr double kWideDotStep = 0.13;  ///< the same in the narrower panels side by side
constexpr double kDotJitter = 0.13;
constexpr double kBracketFoot = 0.14;
constexpr double kBracketInset = 0.06;
constexpr double kGoldenShare = 0.6180339887498949;

/// Answers as dots: those that are the same in a row, in the middle, none hidden by another.
void add_dots(std::string& text, std::span<const double> values, double centre, double dot_step) {
  std::map<double, std::size_t> total;
  for (const double value : values) ++total[value];
  for (const auto& [value, count] : total) {
    const double step =
        count > 1 ? std::min(dot_step, kDotRow / static_cast<double>(count - 1)) : 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const double across = static_cast<double>(i) - 0.5 * static_cast<double>(count - 1);
      const double share = std::fmod(kGoldenShare * static_cast<double>(i + 1), 1.0);
      fmt::format_to(std::back_inserter(text), "{:.4f} {:.4f}\n", centre + step * across,
                     value + kDotJitter * (2.0 * share - 1.0));
    }
  }
}

/// A block of the data file that the script asks for by its name.
void begin_block(std::string& text, std::string_view kind, std::size_t panel, std::size_t method) {
  if (!text.empty()) text += "\n\n";
  fmt::format_to(std::back_inserter(text), "# {}_{}_{}\n", kind, panel, method);
}

void add_method_data(std::string& text, const Sheet& sheet, std::size_t panel, std::size_t method) {
  const Places places(sheet);
  std::string boxes;
  std::string dots;
  for (std::size_t question = 0; question < sheet.data.questions.size(); ++question) {
    const std::vector<double> values =
        answers_to(sheet.data, sheet.data.questions[question].id, sheet.analysis.methods[method],
                   sheet.panels[panel].object);
    if (values.empty()) continue;
    const BoxSummary box = box_summary(values);
    const double centre = places.centre(question, method);
    fmt::format_to(std::back_inserter(boxes), "{:.4f} {:.4f} {:.4f} {:.4f} {:.4f} {:.4f}\n", centre,
                   box.lower_quartile, box.lower_whisker, box.upper_whisker, box.upper_quartile,
                   box.median);
    add_dots(dots, values, centre, sheet.panels.size() > 1 ? kWideDotStep : kDotStep);
  }
  begin_block(text, "boxes", panel, method);
  text += "# x, lower quartile, lower whisker, upper whisker, upper quartile, median\n" + boxes;
  begin_block(text, "dots", panel, method);
  text += "# x, answer, both moved aside a little so that every dot is seen\n" + dots;
}

/// The brackets of one panel and the marks on them.
void add_brackets(std::string& text, const Sheet& sheet, std::size_t panel) {
  const Places places(sheet);
  const auto& methods = sheet.analysis.methods;
  const auto& questions = sheet.data.questions;
  std::string lines;
  std::string marks;
  for (const Comparison& comparison : sheet.comparisons) {
    if (comparison.object != sheet.panels[panel].object) continue;
    const auto method = static_cast<std::size_t>(
        std::find(methods.begin(), methods.end(), comparison.method) - methods.begin());
    const auto question = static_cast<std::size_t>(
        std::find_if(questions.begin(), questions.end(),
                     [&](const Question& one) { return one.id == comparison.question; }) -
        questions.begin());
    const double from = places.centre(question, 0) + kBracketInset;
    const double to = places.centre(question, method) - kBracketInset;
    const double high = places.bracket(method);
    const double low = high - kBracketFoot;
    fmt::format_to(std::back_inserter(lines),
                   "{0:.4f} {2:.4f}\n{0:.4f} {3:.4f}\n{1:.4f} {3:.4f}\n{1:.4f} {2:.4f}\n\n", from,
                   to, low, high);
    fmt::format_to(std::back_inserter(marks), "{:.4f} {:.4f} {}\n", 0.5 * (from + to), high,
                   significance_mark(comparison.p_holm));
  }
  begin_block(text, "brackets", panel, 0);
  text += lines;
  begin_block(text, "marks", panel, 0);
  text += marks;
}

}  // namespace

std::string figure_data(const Sheet& sheet) {
  std::string text = sheet.data.simulated ? "# SIMULATED data\n" : "";
  for (std::size_t panel = 0; panel < sheet.panels.size(); ++panel) {
    for (std::size_t method = 0; method < sheet.analysis.methods.size(); ++method) {
      add_method_data(text, sheet, panel, method);
    }
    add_brackets(text, sheet, panel);
  }
  return text;
}

}  // namespace nade::study
