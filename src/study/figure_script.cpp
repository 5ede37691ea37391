#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "answer_sheet.h"
#include "nade/study/figure.h"
#include "nade/study/line_break.h"

namespace nade::study {
namespace {

/// How a method looks, told apart without colour.
struct Look {
  std::string_view box;
  std::string_view dots;
};
constexpr std::array<Look, 4> kLooks{{
    {"fillstyle solid 1.0 border rgb '#000000' fillcolor rgb '#ffffff'",
     "pointtype 6 pointsize 0.48 linewidth 1 linecolor rgb '#202020'"},
    {"fillstyle solid 1.0 border rgb '#000000' fillcolor rgb '#bdbdbd'",
     "pointtype 7 pointsize 0.48 linecolor rgb '#202020'"},
    {"fillstyle pattern 4 border rgb '#000000' fillcolor rgb '#707070'",
     "pointtype 9 pointsize 0.55 linecolor rgb '#000000'"},
    {"fillstyle pattern 2 border rgb '#000000' fillcolor rgb '#707070'",
     "pointtype 5 pointsize 0.45 linecolor rgb '#000000'"},
}};
const Look& look_of(std::size_t method) { return kLooks[method % kLooks.size()]; }

/// Sizes in pixels of the SVG, 96 to the inch.
constexpr double kLeft = 62.0;
constexpr double kRight = 14.0;
constexpr double kPanelGap = 18.0;
constexpr double kPlotHeight = 350.0;
constexpr double kKeyHeight = 40.0;
constexpr double kTitleHeight = 24.0;
constexpr double kFootHeight = 36.0;
constexpr double kLineHeight = 19.5;
constexpr double kLetterWidth = 7.4;

/// How large everything is.
struct Layout {
  double panel_width = 0.0;
  double width = 0.0;
  double height = 0.0;
  double bottom = 0.0;  ///< under the axis
  double top = 0.0;     ///< above the plot
};

/// Pixels for one method.
double place_width(const Sheet& sheet) { return sheet.panels.size() > 1 ? 50.0 : 82.0; }

/// About how wide a text will be, pixels: kana and ideographs, three bytes each, are as wide as two
/// letters.
double text_width(std::string_view text) {
  double letters = 0.0;
  for (const char character : text) {
    const auto byte = static_cast<unsigned char>(character);
    if ((byte & 0xC0U) != 0x80U) letters += byte >= 0xE3 ? 2.0 : 1.0;
  }
  return kLetterWidth * letters;
}

/// A question's place under the axis: its name, and its text in narrow lines.
std::vector<std::string> question_lines(const Sheet& sheet, const Question& question) {
  std::vector<std::string> lines{question.id};
  if (sheet.texts == QuestionTexts::names_only) return lines;
  const double room = 0.95 * Places(sheet).group_width() * place_width(sheet);
  for (std::string& line : broken_lines(question.text.in(sheet.language), room, text_width)) {
    lines.push_back(std::move(line));
  }
  return lines;
}

Layout layout_of(const Sheet& sheet) {
  const Places places(sheet);
  const auto panels = static_cast<double>(sheet.panels.size());
  std::size_t lines = 1;
  for (const Question& question : sheet.data.questions) {
    lines = std::max(lines, question_lines(sheet, question).size());
  }
  Layout layout;
  layout.panel_width = std::max(240.0, place_width(sheet) * (places.right() - places.left()));
  layout.width = kLeft + panels * layout.panel_width + (panels - 1.0) * kPanelGap + kRight;
  layout.bottom = kFootHeight + kLineHeight * static_cast<double>(lines);
  layout.top = kKeyHeight + (panels > 1.0 ? kTitleHeight : 0.0);
  layout.height = layout.bottom + kPlotHeight + layout.top;
  return layout;
}

/// The label of a place on an axis, where gnuplot takes % for a number's format.
std::string tic_label(const std::vector<std::string>& lines) {
  std::string label;
  for (const std::string& line : lines) {
    std::string quoted = gnuplot_string(line);
    for (std::size_t at = 0; (at = quoted.find('%', at)) != std::string::npos; at += 2) {
      quoted.insert(at, 1, '%');
    }
    label += (label.empty() ? "" : ".\"\\n\".") + quoted;
  }
  return label;
}

std::string tics_of(const Sheet& sheet) {
  const Places places(sheet);
  std::string tics;
  for (std::size_t i = 0; i < sheet.data.questions.size(); ++i) {
    tics += fmt::format("{}{} {:.4f}", i > 0 ? ", " : "",
                        tic_label(question_lines(sheet, sheet.data.questions[i])),
                        places.group_centre(i));
  }
  return tics;
}

std::string scale_label(const Sheet& sheet) {
  const StudyData& data = sheet.data;
  const std::string low = data.plan ? data.plan->scale.low.in(sheet.language) : std::string();
  const std::string high = data.plan ? data.plan->scale.high.in(sheet.language) : std::string();
  const std::string_view answer = sheet.language == Language::japanese ? "回答" : "answer";
  if (low.empty() || high.empty()) {
    return fmt::format("{} ({:g} to {:g})", answer, data.scale_low, data.scale_high);
  }
  return fmt::format("{} ({:g}: {}, {:g}: {})", answer, data.scale_low, low, data.scale_high, high);
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
  const std::string pairs =
      fewest == most ? fmt::format("{}", most) : fmt::format("{}-{}", fewest, most);
  if (sheet.language == Language::japanese) {
    return fmt::format(
        "** p < 0.01, * p < 0.05, n.s. 有意差なし: ウィルコクソンの符号順位検定{}, 正確確率, Holm, "
        "n = {}",
        average ? " (各人の物体間平均)" : "", pairs);
  }
  return fmt::format(
      "** p < 0.01, * p < 0.05, n.s. not significant: Wilcoxon signed rank{}, exact, Holm, n = {}",
      average ? " of each person's average over the objects" : "", pairs);
}

/// The terminals take sizes of letters differently: pixels, points, and points of 96 to the inch.
constexpr std::string_view kTerminals = R"(do for [format in "svg pdf png"] {
if (format eq "svg") {
  set terminal svg size WIDTH,HEIGHT font "sans-serif,13" noenhanced background rgb "white"
  LETTERS = 13/9.75
}
if (format eq "pdf") {
  set terminal pdfcairo size WIDTH/96.0,HEIGHT/96.0 font "sans-serif,9.75" fontscale 0.75 \
    linewidth 1.4 noenhanced background rgb "white"
  LETTERS = 1
}
if (format eq "png") {
  set terminal pngcairo size 2.5*WIDTH,2.5*HEIGHT font "sans-serif,9.75" fontscale 2.5 \
    linewidth 2.5 pointscale 2.5 noenhanced background rgb "white"
  LETTERS = 1
}
set output OUT.NAME.".".format
set border 3
set tics nomirror out
BOX = 0.84
set boxwidth BOX
set key at screen 0.5,0.99 center top horizontal maxrows 1 reverse Left samplen 1.8 width 1
)";

std::string head_of(const std::string& name, const Layout& layout) {
  return fmt::format(
             "# {0}.svg, {0}.pdf and {0}.png from {0}.dat; to draw them anew: gnuplot {0}.gp\n"
             "if (!exists(\"OUT\")) OUT = \"\"\n"
             "NAME = {1}\nDATA = NAME.\".dat\"\nWIDTH = {2:.0f}\nHEIGHT = {3:.0f}\n",
             name, gnuplot_string(name), layout.width, layout.height) +
         std::string(kTerminals);
}

std::string axes_of(const Sheet& sheet, const Layout& layout) {
  const Places places(sheet);
  std::string text = fmt::format(
      "set multiplot layout 1,{} margins screen {:.4f},{:.4f},{:.4f},{:.4f} spacing screen "
      "{:.4f}\n",
      sheet.panels.size(), kLeft / layout.width, 1.0 - kRight / layout.width,
      layout.bottom / layout.height, 1.0 - layout.top / layout.height, kPanelGap / layout.width);
  text += fmt::format("set xrange [{:.4f}:{:.4f}]\nset yrange [{:g}:{:.4f}]\n", places.left(),
                      places.right(), sheet.data.scale_low - 0.35, places.top());
  text += fmt::format("set ytics {:g},1,{:g}\nset xtics ({}) scale 0\n", sheet.data.scale_low,
                      sheet.data.scale_high, tics_of(sheet));
  return text + fmt::format("set ylabel {}\n", gnuplot_string(scale_label(sheet)));
}

std::string labels_of(const Sheet& sheet, const Layout& layout) {
  std::string text = fmt::format(
      "set label 1 {} at screen 0.5,{:.4f} center font sprintf(\"sans-serif,%g\", 8*LETTERS)\n",
      gnuplot_string(footnote_of(sheet)), 13.0 / layout.height);
  if (!sheet.data.simulated) return text;
  return text + fmt::format(
                    "set label 2 \"SIMULATED\" at graph 0.5,0.45 center rotate by 24 font "
                    "sprintf(\"sans-serif,%g\", {:.0f}*LETTERS) textcolor rgb \"#e2e2e2\" back\n"
                    "set label 3 \"SIMULATED data\" at screen {:.4f},{:.4f} right font "
                    "sprintf(\"sans-serif,%g\", 9*LETTERS)\n",
                    0.095 * layout.panel_width, 1.0 - 12.0 / layout.width,
                    1.0 - 16.0 / layout.height);
}

/// What one panel draws: boxes, their medians, the dots over them, the brackets above.
std::string plot_of(const Sheet& sheet, std::size_t panel) {
  std::string boxes;
  std::string medians;
  std::string dots;
  for (std::size_t method = 0; method < sheet.analysis.methods.size(); ++method) {
    const Look& look = look_of(method);
    boxes += fmt::format(
        "  DATA index 'boxes_{}_{}' using 1:2:3:4:5 with candlesticks whiskerbars 0.4 {} "
        "linewidth 1 notitle, \\\n",
        panel, method, look.box);
    medians += fmt::format(
        "  DATA index 'boxes_{}_{}' using ($1-0.56*BOX):6:(1.12*BOX):(0) with vectors nohead "
        "linewidth 3.5 linecolor rgb '#000000' notitle, \\\n",
        panel, method);
    // Each dot on a white one, so that it is seen on the lines too.
    dots += fmt::format(
        "  DATA index 'dots_{0}_{1}' using 1:2 with points pointtype 7 pointsize 0.68 "
        "linecolor rgb '#ffffff' notitle, \\\n"
        "  DATA index 'dots_{0}_{1}' using 1:2 with points {2} notitle, \\\n",
        panel, method, look.dots);
  }
  return "plot \\\n" + boxes + medians + dots +
         fmt::format(
             "  DATA index 'brackets_{0}_0' using 1:2 with lines linecolor rgb '#000000' "
             "notitle, \\\n"
             "  DATA index 'marks_{0}_0' using 1:2:3 with labels offset 0,0.65 notitle",
             panel);
}

/// One sample of each method's box.
std::string key_of(const Sheet& sheet) {
  std::string key;
  for (std::size_t method = 0; method < sheet.analysis.methods.size(); ++method) {
    key += fmt::format(", \\\n  keyentry with boxes {} title {}", look_of(method).box,
                       gnuplot_string(method_label(sheet.analysis, sheet.analysis.methods[method],
                                                   sheet.language)));
  }
  return key;
}

std::string panel_script(const Sheet& sheet, std::size_t panel) {
  std::string text;
  if (panel == 1) text += "unset label 1\nunset label 3\nunset ylabel\nset format y ''\n";
  if (!sheet.panels[panel].title.empty()) {
    text += fmt::format("set title {} offset 0,-0.5\n", gnuplot_string(sheet.panels[panel].title));
  }
  return text + plot_of(sheet, panel) + (panel == 0 ? key_of(sheet) : "") + "\n";
}

}  // namespace

std::string figure_script(const std::string& name, const Sheet& sheet) {
  const Layout layout = layout_of(sheet);
  std::string text = head_of(name, layout) + axes_of(sheet, layout) + labels_of(sheet, layout);
  for (std::size_t panel = 0; panel < sheet.panels.size(); ++panel) {
    text += panel_script(sheet, panel);
  }
  return text + "unset multiplot\nset output\nreset\n}\n";
}

}  // namespace nade::study
