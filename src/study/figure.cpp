#include "nade/study/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <string_view>

#include "nade/study/statistics.h"
#include "wrapped_text.h"

namespace nade::study {
namespace {

// Across, one is the place of one method.
constexpr double kGroupGap = 0.7;
constexpr double kDotRow = 0.78;       ///< the widest a row of equal answers may be
constexpr double kDotStep = 0.075;     ///< between the dots of a shorter row
constexpr double kDotJitter = 0.13;    ///< of the scale, up and down
constexpr double kBracketStep = 0.62;  ///< of the scale, from one bracket to the next above
constexpr double kBracketFoot = 0.14;
constexpr double kBracketInset = 0.06;
constexpr std::size_t kLabelLetters = 24;  ///< in a line under two boxes
constexpr double kGoldenShare = 0.6180339887498949;

/// Answers that are drawn side by side: one panel of a figure.
struct Panel {
  std::string title;
  std::string object;  ///< empty: all of them
};

/// What a figure is made from.
struct Sheet {
  const StudyData& data;
  const Analysis& analysis;
  std::span<const Comparison> comparisons;  ///< the family of its marks
  std::vector<Panel> panels;
  Language language;
};

/// Where things are in a panel.
class Places {
 public:
  explicit Places(const Sheet& sheet)
      : methods_(static_cast<double>(sheet.analysis.methods.size())),
        questions_(static_cast<double>(sheet.data.questions.size())),
        scale_high_(sheet.data.scale_high) {}

  [[nodiscard]] double centre(std::size_t question, std::size_t method) const {
    return static_cast<double>(question) * (methods_ + kGroupGap) + static_cast<double>(method);
  }
  [[nodiscard]] double group_centre(std::size_t question) const {
    return centre(question, 0) + 0.5 * (methods_ - 1.0);
  }
  [[nodiscard]] double left() const { return -0.5 - 0.5 * kGroupGap; }
  [[nodiscard]] double right() const { return left() + questions_ * (methods_ + kGroupGap); }
  /// The height of the bracket from the baseline to a method.
  [[nodiscard]] double bracket(std::size_t method) const {
    return scale_high_ + kBracketStep * static_cast<double>(method) - 0.1;
  }
  [[nodiscard]] double top() const { return scale_high_ + kBracketStep * methods_ - 0.05; }

 private:
  double methods_;
  double questions_;
  double scale_high_;
};

/// How a method looks, told apart without colour.
struct Look {
  std::string_view fill;
  std::string_view dots;
};
constexpr std::array<Look, 4> kLooks{{
    {"fillstyle solid 1.0 border rgb '#000000' fillcolor rgb '#ffffff'",
     "pointtype 6 pointsize 0.42 linewidth 0.8 linecolor rgb '#303030'"},
    {"fillstyle solid 1.0 border rgb '#000000' fillcolor rgb '#bdbdbd'",
     "pointtype 7 pointsize 0.42 linecolor rgb '#303030'"},
    {"fillstyle pattern 4 border rgb '#000000' fillcolor rgb '#808080'",
     "pointtype 8 pointsize 0.5 linewidth 0.8 linecolor rgb '#000000'"},
    {"fillstyle pattern 2 border rgb '#000000' fillcolor rgb '#808080'",
     "pointtype 4 pointsize 0.42 linewidth 0.8 linecolor rgb '#000000'"},
}};
const Look& look_of(std::size_t method) { return kLooks[method % kLooks.size()]; }

/// A string of gnuplot's, in double quotes.
std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char character : text) {
    if (character == '\n') {
      result += "\\n";
    } else {
      if (character == '"' || character == '\\') result += '\\';
      result += character;
    }
  }
  return result + '"';
}

/// Answers as dots: those that are the same in a row, in the middle, none hidden by another.
void add_dots(std::string& text, std::span<const double> values, double centre) {
  std::map<double, std::size_t> total;
  for (const double value : values) ++total[value];
  for (const auto& [value, count] : total) {
    const double step =
        count > 1 ? std::min(kDotStep, kDotRow / static_cast<double>(count - 1)) : 0.0;
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
    add_dots(dots, values, centre);
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

std::string data_of(const Sheet& sheet) {
  std::string text;
  for (std::size_t panel = 0; panel < sheet.panels.size(); ++panel) {
    for (std::size_t method = 0; method < sheet.analysis.methods.size(); ++method) {
      add_method_data(text, sheet, panel, method);
    }
    add_brackets(text, sheet, panel);
  }
  return text;
}

/// A question's place under the axis: its id and its text in narrow lines.
std::vector<std::string> question_lines(const Sheet& sheet, const Question& question) {
  std::vector<std::string> lines{question.id};
  const std::size_t letters =
      std::max<std::size_t>(kLabelLetters, kLabelLetters * sheet.analysis.methods.size() / 2);
  for (std::string& line : wrapped(question.text.in(sheet.language), letters)) {
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string tics_of(const Sheet& sheet) {
  const Places places(sheet);
  std::string tics;
  for (std::size_t i = 0; i < sheet.data.questions.size(); ++i) {
    const auto lines = question_lines(sheet, sheet.data.questions[i]);
    tics += fmt::format("{}{} {:.4f}", i > 0 ? ", " : "",
                        quoted(fmt::format("{}", fmt::join(lines, "\n"))), places.group_centre(i));
  }
  return tics;
}

std::size_t tic_lines(const Sheet& sheet) {
  std::size_t most = 1;
  for (const Question& question : sheet.data.questions) {
    most = std::max(most, question_lines(sheet, question).size());
  }
  return most;
}

std::string scale_label(const Sheet& sheet) {
  const StudyData& data = sheet.data;
  const std::string low = data.plan ? data.plan->scale.low.in(sheet.language) : std::string();
  const std::string high = data.plan ? data.plan->scale.high.in(sheet.language) : std::string();
  const std::string_view answer = sheet.language == Language::japanese ? "回答" : "answer";
  if (low.empty() || high.empty()) {
    return fmt::format("{} ({:g} to {:g})", answer, data.scale_low, data.scale_high);
  }
  return fmt::format("{} ({:g} {} … {:g} {})", answer, data.scale_low, low, data.scale_high, high);
}

/// What one panel draws: boxes, their medians, the dots over them, the brackets above.
std::string plot_of(const Sheet& sheet, std::size_t panel) {
  std::string boxes;
  std::string medians;
  std::string dots;
  for (std::size_t method = 0; method < sheet.analysis.methods.size(); ++method) {
    const Look& look = look_of(method);
    boxes += fmt::format(
        "  DATA index 'boxes_{}_{}' using 1:2:3:4:5 with candlesticks {} linewidth 1 "
        "whiskerbars 0.4 notitle, \\\n",
        panel, method, look.fill);
    medians += fmt::format(
        "  DATA index 'boxes_{}_{}' using 1:6:6:6:6 with candlesticks linewidth 3.5 "
        "linecolor rgb '#000000' notitle, \\\n",
        panel, method);
    dots += fmt::format("  DATA index 'dots_{}_{}' using 1:2 with points {} notitle, \\\n", panel,
                        method, look.dots);
  }
  return "plot \\\n" + boxes + medians + dots +
         fmt::format(
             "  DATA index 'brackets_{0}_0' using 1:2 with lines linecolor rgb '#000000' "
             "notitle, \\\n"
             "  DATA index 'marks_{0}_0' using 1:2:3 with labels offset 0,0.4 notitle",
             panel);
}

/// One sample of each method's box.
std::string key_of(const Sheet& sheet) {
  std::string key;
  for (std::size_t method = 0; method < sheet.analysis.methods.size(); ++method) {
    key += fmt::format(", \\\n  keyentry with boxes {} title {}", look_of(method).fill,
                       quoted(method_label(sheet.analysis, sheet.analysis.methods[method])));
  }
  return key;
}

/// What the marks mean, in one line.
std::string footnote_of(const Sheet& sheet) {
  std::size_t fewest = sheet.data.participants.size();
  std::size_t most = 0;
  for (const Comparison& comparison : sheet.comparisons) {
    fewest = std::min(fewest, comparison.dropped.pairs);
    most = std::max(most, comparison.dropped.pairs);
  }
  const bool average = sheet.panels.front().object.empty() && sheet.data.objects.size() > 1;
  return fmt::format(
      "** p < 0.01, * p < 0.05, n.s. not significant: exact Wilcoxon signed rank{}, Holm, n = {}",
      average ? " of each person's average over the objects" : "",
      fewest == most ? fmt::format("{}", most) : fmt::format("{} to {}", fewest, most));
}

std::string panel_script(const Sheet& sheet, std::size_t panel) {
  std::string text;
  if (panel == 1) text += "unset label\nunset ylabel\nset format y ''\n";
  if (!sheet.panels[panel].title.empty()) {
    text += fmt::format("set title {} offset 0,-0.5\n", quoted(sheet.panels[panel].title));
  }
  return text + plot_of(sheet, panel) + (panel == 0 ? key_of(sheet) : "") + "\n";
}

constexpr std::string_view kTerminals = R"(do for [format in "svg pdf png"] {
if (format eq "svg") {
  set terminal svg size WIDTH,HEIGHT font "sans-serif,13" noenhanced background rgb "white"
}
if (format eq "pdf") {
  set terminal pdfcairo size WIDTH/96.0,HEIGHT/96.0 font "sans-serif,9.75" fontscale 1.0 noenhanced background rgb "white"
}
if (format eq "png") {
  set terminal pngcairo size 2.5*WIDTH,2.5*HEIGHT font "sans-serif,9.75" fontscale 2.5 linewidth 2.5 pointscale 2.5 noenhanced background rgb "white"
}
set output OUT.NAME.".".format
)";

std::string script_of(const std::string& name, const Sheet& sheet) {
  const Places places(sheet);
  const auto panels = static_cast<double>(sheet.panels.size());
  const double width = 150.0 + panels * 190.0 * (places.right() - places.left()) / 2.7;
  const double line_height = 17.0;
  const double bottom = 40.0 + line_height * static_cast<double>(tic_lines(sheet));
  const double height = 390.0 + bottom;
  std::string text = fmt::format(
      "# {0}.svg, {0}.pdf and {0}.png from {0}.dat; draw them anew with: gnuplot {0}.gp\n"
      "if (!exists(\"IN\")) IN = \"\"\n"
      "if (!exists(\"OUT\")) OUT = \"\"\n"
      "NAME = {1}\nDATA = IN.NAME.\".dat\"\nWIDTH = {2:.0f}\nHEIGHT = {3:.0f}\n",
      name, quoted(name), width, height);
  text += kTerminals;
  text += fmt::format(
      "set multiplot layout 1,{} margins screen {:.4f},{:.4f},{:.4f},{:.4f} spacing screen 0.02\n",
      sheet.panels.size(), 62.0 / width, 1.0 - 14.0 / width, bottom / height,
      1.0 - (panels > 1.0 ? 62.0 : 40.0) / height);
  text += "set border 3\nset tics nomirror out\nset boxwidth 0.84\n";
  text += "set style data points\n";
  text += "set key at screen 0.5,0.99 center top horizontal maxrows 1 samplen 1.6 width 2\n";
  text += fmt::format("set xrange [{:.4f}:{:.4f}]\nset yrange [{:g}:{:.4f}]\n", places.left(),
                      places.right(), sheet.data.scale_low - 0.35, places.top());
  text += fmt::format("set ytics {:g},1,{:g}\nset xtics ({}) scale 0\n", sheet.data.scale_low,
                      sheet.data.scale_high, tics_of(sheet));
  text += fmt::format("set ylabel {}\n", quoted(scale_label(sheet)));
  text += fmt::format("set label 1 {} at screen 0.5,{:.4f} center font \"sans-serif,8\"\n",
                      quoted(footnote_of(sheet)), 12.0 / height);
  if (sheet.data.simulated) {
    text += fmt::format(
        "set label 2 \"SIMULATED\" at screen 0.5,0.55 center rotate by 24 font "
        "\"sans-serif,{:.0f}\" "
        "textcolor rgb \"#e2e2e2\" back\n"
        "set label 3 \"SIMULATED\" at screen {:.4f},{:.4f} right font \"sans-serif,9\"\n",
        0.09 * width, 1.0 - 10.0 / width, 1.0 - 14.0 / height);
  }
  for (std::size_t panel = 0; panel < sheet.panels.size(); ++panel) {
    text += panel_script(sheet, panel);
  }
  return text + "unset multiplot\nset output\nreset\n}\n";
}

Figure figure_of(const std::string& name, const Sheet& sheet) {
  return {name, script_of(name, sheet), data_of(sheet)};
}

}  // namespace

Figure answers_figure(const StudyData& data, const Analysis& analysis, Language language) {
  return figure_of("fig3", {data, analysis, analysis.averaged, {Panel{}}, language});
}

Figure answers_by_object_figure(const StudyData& data, const Analysis& analysis,
                                Language language) {
  Sheet sheet{data, analysis, analysis.by_object, {}, language};
  for (const std::string& object : data.objects) sheet.panels.push_back({object, object});
  return figure_of("fig3_by_object", sheet);
}

std::string significance_mark(double p) {
  if (p < 0.01) return "**";
  return p < 0.05 ? "*" : "n.s.";
}

std::string method_label(const Analysis& analysis, const std::string& method) {
  if (method == analysis.methods.front()) return "without correction";
  if (analysis.methods.size() == 2) return "with correction";
  return "with correction: " + method;
}

}  // namespace nade::study
