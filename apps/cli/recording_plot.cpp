#include "recording_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

#include "nade/io/output_file.h"
#include "nade/io/passing_folder.h"
#include "nade/study/figure.h"

namespace nade::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostSpans = 2048;
constexpr double kMillimetres = 1e3;
constexpr std::size_t kSpeed = 3;
constexpr std::size_t kBend = 4;
constexpr std::size_t kLength = kBend + kDigitCount;
constexpr std::size_t kTremble = kLength + 1;

/// Degrees between the bones of a digit, summed up from its first one.
double bend_deg(const HandPose& hand, Digit digit) {
  const DigitJoints joints = joints_of(digit);
  const auto bone = [&](std::size_t k) {
    const std::size_t i = index_of(joints.metacarpal) + k;
    return Vec3(hand.joints[i + 1].position - hand.joints[i].position);
  };
  double sum = 0.0;
  for (std::size_t k = 0; k + 2 < joints.count(); ++k) {
    const Vec3 a = bone(k);
    const Vec3 b = bone(k + 1);
    sum += std::atan2(a.cross(b).norm(), a.dot(b)) / kDegree;
  }
  return sum;
}

/// A line of a panel.
struct Curve {
  std::size_t value;
  std::string_view colour;
  std::string_view name;
};
constexpr std::array<Curve, 3> kPlaces{{{0, "#b08a2e", "x, to the right"},
                                        {2, "#7a7a7a", "z, to the viewer"},
                                        {1, "#0b5cad", "y, height"}}};
constexpr std::array<Curve, 1> kSpeeds{{{kSpeed, "#0b5cad", ""}}};
// Okabe and Ito's colours, which are told apart without red and green.
constexpr std::array<Curve, kDigitCount> kBends{{{kBend, "#e69f00", "thumb"},
                                                 {kBend + 1, "#0072b2", "index"},
                                                 {kBend + 2, "#009e73", "middle"},
                                                 {kBend + 3, "#d55e00", "ring"},
                                                 {kBend + 4, "#cc79a7", "little"}}};
constexpr std::array<Curve, 1> kLengths{{{kLength, "#0b5cad", ""}}};
constexpr std::array<Curve, 1> kTrembles{{{kTremble, "#0b5cad", ""}}};

/// Means, over the range that was passed through where many frames make one point.
template <std::size_t N>
std::string panel(std::size_t side, std::string_view label, const std::array<Curve, N>& curves) {
  std::string text = fmt::format("set label 10 {} at graph 0, graph 1.1 left\nplot \\\n",
                                 study::gnuplot_string(label));
  std::string_view separator;
  for (const Curve& curve : curves) {
    const std::size_t mean = 2 + 3 * curve.value;
    text += fmt::format(
        "{0}  DATA index 'hand_{1}' using 1:{2}:{3} with filledcurves fillcolor rgb '{4}' "
        "fillstyle transparent solid 0.25 noborder notitle, \\\n"
        "  DATA index 'hand_{1}' using 1:{5} with lines linewidth 1.3 linecolor rgb '{4}' "
        "title {6}",
        separator, side, mean + 1, mean + 2, curve.colour, mean, study::gnuplot_string(curve.name));
    separator = ", \\\n";
  }
  return text + "\n";
}

/// The terminals take sizes of letters differently.
constexpr std::string_view kBegin = R"(if (!exists("OUT")) OUT = ""
DATA = NAME.".dat"
do for [format in "svg pdf png"] {
if (format eq "svg") {
  set terminal svg size WIDTH,HEIGHT font "sans-serif,13" noenhanced background rgb "white"
}
if (format eq "pdf") {
  set terminal pdfcairo size WIDTH/96.0,HEIGHT/96.0 font "sans-serif,9.75" fontscale 0.75 \
    noenhanced background rgb "white"
}
if (format eq "png") {
  set terminal pngcairo size 2*WIDTH,2*HEIGHT font "sans-serif,9.75" fontscale 2 linewidth 2 \
    noenhanced background rgb "white"
}
set output OUT.NAME.".".format
set border 3 linecolor rgb "#606060"
set tics nomirror out textcolor rgb "#303030"
set grid ytics linetype 1 linewidth 0.5 linecolor rgb "#e4e4e4"
set xrange [0:LAST]
)";

}  // namespace

void RecordingPlot::Spread::add(double value) {
  sum += value;
  least = std::min(least, value);
  greatest = std::max(greatest, value);
  ++count;
}

void RecordingPlot::Spread::add(const Spread& other) {
  sum += other.sum;
  least = std::min(least, other.least);
  greatest = std::max(greatest, other.greatest);
  count += other.count;
}

void RecordingPlot::add(const RecordedFrame& frame) {
  const double step_s = 1e-9 * static_cast<double>(frame.time_ns - last_ns_);
  if (!first_ns_) first_ns_ = frame.time_ns;
  last_ns_ = frame.time_ns;
  const double time_s = 1e-9 * static_cast<double>(frame.time_ns - *first_ns_);
  ++frames_;
  if (spans_.empty() || frames_in_last_ == frames_a_span_) {
    if (spans_.size() == kMostSpans) thin_out();
    spans_.emplace_back().begin_s = time_s;
    frames_in_last_ = 0;
  }
  ++frames_in_last_;
  Span& span = spans_.back();
  span.end_s = time_s;
  for (std::size_t side = 0; side < 2; ++side) {
    if (frame.hands[side]) {
      add_hand(*frame.hands[side], step_s, span);
    } else {
      past_[side] = {};
    }
  }
}

void RecordingPlot::add_hand(const RecordedHand& hand, double step_s, Span& span) {
  const std::size_t side = index_of(hand.pose.side);
  std::array<Spread, kValues>& values = span.hands[side];
  Past& past = past_[side];
  const Vec3 palm = kMillimetres * hand.pose[Joint::palm].position;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    values[axis].add(palm[static_cast<Eigen::Index>(axis)]);
  }
  for (std::size_t digit = 0; digit < kDigitCount; ++digit) {
    values[kBend + digit].add(bend_deg(hand.pose, digit_at(digit)));
  }
  values[kLength].add(kMillimetres * hand_length(hand.pose));
  if (past.last) values[kSpeed].add((palm - *past.last).norm() / step_s);
  if (past.last_but_one) {
    values[kTremble].add((*past.last - (palm + *past.last_but_one) / 2.0).norm());
  }
  past = {palm, past.last};
}

void RecordingPlot::thin_out() {
  for (std::size_t i = 0; 2 * i + 1 < spans_.size(); ++i) {
    Span merged = spans_[2 * i];
    const Span& next = spans_[2 * i + 1];
    merged.end_s = next.end_s;
    for (std::size_t side = 0; side < 2; ++side) {
      for (std::size_t k = 0; k < kValues; ++k) merged.hands[side][k].add(next.hands[side][k]);
    }
    spans_[i] = merged;
  }
  spans_.resize(spans_.size() / 2);
  frames_a_span_ *= 2;
}

bool RecordingPlot::has_hand(std::size_t side) const {
  return std::any_of(spans_.begin(), spans_.end(),
                     [&](const Span& span) { return span.hands[side][0].count > 0; });
}

std::string RecordingPlot::row_of(const Span& span, std::size_t side) {
  std::string row = fmt::format("{:.6g}", 0.5 * (span.begin_s + span.end_s));
  for (const Spread& value : span.hands[side]) {
    row += value.count == 0
               ? " NaN NaN NaN"
               : fmt::format(" {:.6g} {:.6g} {:.6g}", value.sum / static_cast<double>(value.count),
                             value.least, value.greatest);
  }
  return row + "\n";
}

std::string RecordingPlot::data() const {
  std::string text;
  for (std::size_t side = 0; side < 2; ++side) {
    text += fmt::format("{}# hand_{}\n", side == 0 ? "" : "\n\n", side);
    bool missing = true;
    for (const Span& span : spans_) {
      const bool there = span.hands[side][0].count > 0;
      // One empty line ends a curve, two the hand.
      if (!there && !missing) text += '\n';
      missing = !there;
      if (there) text += row_of(span, side);
    }
  }
  return text;
}

std::string RecordingPlot::gaps(std::size_t side) const {
  std::string text;
  std::size_t count = 0;
  for (std::size_t i = 0; i < spans_.size(); ++i) {
    if (spans_[i].hands[side][0].count > 0) continue;
    const double from = i == 0 ? 0.0 : spans_[i - 1].end_s;
    while (i < spans_.size() && spans_[i].hands[side][0].count == 0) ++i;
    const double to = i < spans_.size() ? spans_[i].begin_s : spans_.back().end_s;
    text += fmt::format(
        "set object {} rectangle from {:.6g}, graph 0 to {:.6g}, graph 1 behind fillcolor rgb "
        "'#f6dede' fillstyle solid noborder\n",
        ++count, from, to);
  }
  return text;
}

std::string RecordingPlot::column(std::size_t side) const {
  // A change that is smaller than this is none.
  constexpr double kLengthRoom_mm = 2.0;
  Spread length;
  for (const Span& span : spans_) length.add(span.hands[side][kLength]);
  std::string text = fmt::format("unset object\n{}set format x ''\nunset xlabel\n", gaps(side));
  text += fmt::format("set title '{} hand' font ',15' offset 0,0.7\n",
                      name_of(side == 0 ? Handedness::left : Handedness::right));
  text += "set key at graph 1, graph 1.02 right bottom horizontal maxrows 1 samplen 1.5 width -1\n";
  text += "set offsets 0, 0, graph 0.08, graph 0.08\nset yrange [*:*]\n";
  text += panel(side, "palm, mm", kPlaces);
  text += "unset title\n";
  text += "set offsets 0, 0, graph 0.08, 0\nset yrange [0:*]\n";
  text += panel(side, "bend of the fingers, degrees", kBends);
  text += "unset key\n";
  text += panel(side, "speed of the palm, mm/s", kSpeeds);
  text += panel(side, "tremble of the palm: from midway between the frames around, mm", kTrembles);
  text += fmt::format("unset offsets\nset yrange [{:.6g}:{:.6g}]\n", length.least - kLengthRoom_mm,
                      length.greatest + kLengthRoom_mm);
  text += "set format x '%g'\nset xlabel 'time, s'\n";
  return text + panel(side, "length of the hand, wrist to middle knuckle, mm", kLengths);
}

std::string RecordingPlot::script(const std::string& title) const {
  constexpr double kColumn = 660.0;
  constexpr double kHeight = 1100.0;
  constexpr double kLeft = 70.0;
  constexpr double kRight = 20.0;
  constexpr double kTop = 146.0;
  constexpr double kBottom = 54.0;
  std::vector<std::size_t> sides;
  for (std::size_t side = 0; side < 2; ++side) {
    if (has_hand(side)) sides.push_back(side);
  }
  const auto columns = static_cast<double>(sides.size());
  const double width = kLeft + columns * kColumn + (columns - 1.0) * kLeft + kRight;
  const double seconds = 1e-9 * static_cast<double>(last_ns_ - *first_ns_);
  std::string text = fmt::format("NAME = 'page'\nWIDTH = {:.0f}\nHEIGHT = {:.0f}\nLAST = {:.6g}\n",
                                 width, kHeight, std::max(seconds, 1e-3));
  text += kBegin;
  std::string about = fmt::format("{} frames in {:.1f} s", frames_, seconds);
  if (frames_ > 1 && seconds > 0.0) {
    about += fmt::format(", {:.1f} a second", static_cast<double>(frames_ - 1) / seconds);
  }
  std::vector<std::string> remarks{std::move(about)};
  if (!gaps(sides.front()).empty() || !gaps(sides.back()).empty()) {
    remarks.front() += "; red where there is no hand";
  }
  if (frames_a_span_ > 1) {
    remarks.push_back(
        fmt::format("each point is the mean of {} frames, pale from the least to the greatest",
                    frames_a_span_));
  }
  text += fmt::format("set label 1 {} at screen {:.4f},{:.4f} left font ',17'\n",
                      study::gnuplot_string(title), kLeft / width, 1.0 - 24.0 / kHeight);
  for (std::size_t i = 0; i < remarks.size(); ++i) {
    text += fmt::format("set label {} {} at screen {:.4f},{:.4f} left textcolor rgb '#505050'\n",
                        2 + i, study::gnuplot_string(remarks[i]), kLeft / width,
                        1.0 - (50.0 + 20.0 * static_cast<double>(i)) / kHeight);
  }
  text += fmt::format(
      "set multiplot layout 5,{} columnsfirst margins screen {:.4f},{:.4f},{:.4f},{:.4f} spacing "
      "screen {:.4f},{:.4f}\n",
      sides.size(), kLeft / width, 1.0 - kRight / width, kBottom / kHeight, 1.0 - kTop / kHeight,
      kLeft / width, 48.0 / kHeight);
  for (const std::size_t side : sides) text += column(side);
  return text + "unset multiplot\nset output\nreset\n}\n";
}

Status RecordingPlot::draw(const std::string& title, const std::string& path) const {
  if (!has_hand(0) && !has_hand(1)) {
    return Error{ErrorCode::bad_value,
                 fmt::format("{}: expected a hand to plot, found none", title)};
  }
  std::error_code ignored;
  const PassingFolder folder((fs::temp_directory_path(ignored) / "nade-plot-XXXXXX").string());
  if (!folder.there()) {
    return Error{ErrorCode::unwritable,
                 fmt::format("{}: expected to make a folder there", folder.path())};
  }
  const Result<study::DrawnFigure> drawn =
      study::draw_figure({"page", script(title), data()}, folder.path());
  if (!drawn) return drawn.error();
  if (!drawn->problem.empty()) {
    // What follows tells of files that are gone.
    return Error{ErrorCode::unreadable,
                 fmt::format("{}: {}", path, drawn->problem.substr(0, drawn->problem.find(';')))};
  }
  std::ifstream file(folder.path("page" + fs::path(path).extension().string()), std::ios::binary);
  return write_whole(path, std::string(std::istreambuf_iterator<char>(file), {}));
}

}  // namespace nade::cli
