#include "bench_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "nade/io/csv.h"

namespace nade::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string shown(double value) { return fmt::format("{:.2f}", value); }

std::string shown(const MetricTarget& target) {
  if (target.at_least && target.at_most) {
    return fmt::format("{:g} to {:g}", *target.at_least, *target.at_most);
  }
  if (target.at_least) return fmt::format("at least {:g}", *target.at_least);
  if (target.at_most) return fmt::format("at most {:g}", *target.at_most);
  return "";
}

bool has_target(const MetricTarget& target) { return target.at_least || target.at_most; }

/// How far a value is from meeting a target.
double shortfall_of(const MetricTarget& target, double value) {
  return std::max(
      {0.0, target.at_least.value_or(value) - value, value - target.at_most.value_or(value)});
}

bool is_in(CaseSet set, bool held_out) {
  return set == CaseSet::all || held_out == (set == CaseSet::held_out);
}

std::string met_of(const BenchFigure& figure, const BenchSummary& summary) {
  if (!has_target(figure.target)) return "";
  return fmt::format("{}/{}", summary.met, summary.measured);
}

std::string title_of(const BenchFigure& figure) {
  std::string title = figure.key;
  if (has_target(figure.target)) title += fmt::format(" ({})", shown(figure.target));
  return title;
}

/// The cases in which a method misses a figure's target, the worst first, as "value case; ...".
std::string missed_in(const BenchReport& report, std::size_t method, const BenchFigure& figure) {
  std::vector<std::pair<double, std::size_t>> missed;
  for (std::size_t i = 0; i < report.cases.size(); ++i) {
    const std::optional<double> value = figure.of(report.at(i, method));
    if (value && !meets(figure.target, *value).value_or(true)) missed.emplace_back(*value, i);
  }
  std::stable_sort(missed.begin(), missed.end(), [&](const auto& a, const auto& b) {
    return badness(figure.target, a.first) > badness(figure.target, b.first);
  });
  std::string text;
  for (const auto& [value, i] : missed) {
    fmt::format_to(std::back_inserter(text), "{}{} {}", text.empty() ? "" : "; ", shown(value),
                   report.cases[i]);
  }
  return text;
}

Json held_out_json(const BenchFigure& figure, const BenchSummary& summary) {
  Json json{{"median", summary.median}, {"worst", summary.worst}, {"measured", summary.measured}};
  if (has_target(figure.target)) {
    json["met"] = summary.met;
    json["shortfall_mean"] = summary.shortfall;
  }
  return json;
}

}  // namespace

std::vector<BenchFigure> bench_figures() {
  std::vector<BenchFigure> figures;
  for (const MetricInfo& info : metric_table()) {
    figures.push_back({info.key, info.unit, info.target, nullptr, info.value});
  }
  const auto add_time = [&](const char* key, double at_most,
                            std::optional<double> (*time)(const CaseScore&)) {
    figures.push_back({key, "us", {std::nullopt, at_most}, time, nullptr});
  };
  add_time("solve_us_median", 100.0, [](const CaseScore& score) { return score.solve_us_median; });
  add_time("solve_us_p99", 300.0, [](const CaseScore& score) { return score.solve_us_p99; });
  return figures;
}

std::optional<BenchSummary> summary_of(const BenchReport& report, std::size_t method,
                                       const BenchFigure& figure, CaseSet set) {
  BenchSummary summary;
  std::vector<double> values;
  for (std::size_t i = 0; i < report.cases.size(); ++i) {
    if (!is_in(set, report.held_out[i])) continue;
    const std::optional<double> value = figure.of(report.at(i, method));
    if (!value) continue;
    if (meets(figure.target, *value).value_or(false)) ++summary.met;
    summary.shortfall += shortfall_of(figure.target, *value);
    const bool worse = badness(figure.target, *value) > badness(figure.target, summary.worst);
    if (values.empty() || worse) {
      summary.worst = *value;
      summary.worst_case = i;
    }
    values.push_back(*value);
  }
  if (values.empty()) return std::nullopt;
  summary.measured = values.size();
  if (summary.measured > summary.met) {
    summary.shortfall /= static_cast<double>(summary.measured - summary.met);
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  summary.median = *middle;
  return summary;
}

std::string as_text(const BenchReport& report) {
  std::string text;
  auto out = std::back_inserter(text);
  const auto held_out = std::count(report.held_out.begin(), report.held_out.end(), true);
  fmt::format_to(
      out, "{} cases, {} of them held out\n\n{:<30}{:<14}{:>10}{:>12}{:>10}{:>10}{:>10}  {}\n",
      report.cases.size(), held_out, "metric", "method", "median", "worst", "met", "held out",
      "short by", "worst case");
  for (const BenchFigure& figure : bench_figures()) {
    // The target stands under the name.
    std::vector<std::string> titles{
        figure.key, has_target(figure.target) ? "  " + shown(figure.target) : std::string()};
    titles.resize(std::max(titles.size(), report.methods.size()));
    for (std::size_t m = 0; m < report.methods.size(); ++m) {
      const auto summary = summary_of(report, m, figure);
      fmt::format_to(out, "{:<30}{:<14}", titles[m], report.methods[m]);
      if (summary) {
        const auto apart = summary_of(report, m, figure, CaseSet::held_out);
        const bool misses = has_target(figure.target) && summary->met < summary->measured;
        fmt::format_to(out, "{:>10}{:>12}{:>10}{:>10}{:>10}  {}", shown(summary->median),
                       shown(summary->worst), met_of(figure, *summary),
                       apart ? met_of(figure, *apart) : "", misses ? shown(summary->shortfall) : "",
                       report.cases[summary->worst_case]);
      } else {
        fmt::format_to(out, "{:>10}", "-");
      }
      text += '\n';
    }
  }
  return text;
}

std::string as_markdown(const BenchReport& report) {
  const std::vector<BenchFigure> figures = bench_figures();
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "| {} cases: median, worst (target met in; held out) |", report.cases.size());
  for (const std::string& method : report.methods) fmt::format_to(out, " {} |", method);
  text += "\n|---|";
  for (std::size_t m = 0; m < report.methods.size(); ++m) text += "--:|";
  text += '\n';
  for (const BenchFigure& figure : figures) {
    fmt::format_to(out, "| {} |", title_of(figure));
    for (std::size_t m = 0; m < report.methods.size(); ++m) {
      const auto summary = summary_of(report, m, figure);
      if (!summary) {
        text += " - |";
        continue;
      }
      const std::string met = met_of(figure, *summary);
      const auto apart = summary_of(report, m, figure, CaseSet::held_out);
      const std::string apart_met = apart ? met_of(figure, *apart) : "";
      fmt::format_to(out, " {}, {}{} |", shown(summary->median), shown(summary->worst),
                     met.empty()
                         ? ""
                         : fmt::format(" ({}{})", met, apart_met.empty() ? "" : "; " + apart_met));
    }
    text += '\n';
  }
  text += "\n| worst case of |";
  for (const std::string& method : report.methods) fmt::format_to(out, " {} |", method);
  text += "\n|---|";
  for (std::size_t m = 0; m < report.methods.size(); ++m) text += "---|";
  text += '\n';
  for (const BenchFigure& figure : figures) {
    fmt::format_to(out, "| {} |", figure.key);
    for (std::size_t m = 0; m < report.methods.size(); ++m) {
      const auto summary = summary_of(report, m, figure);
      fmt::format_to(out, " {} |", summary ? report.cases[summary->worst_case] : "-");
    }
    text += '\n';
  }
  for (std::size_t m = 0; m < report.methods.size(); ++m) {
    fmt::format_to(out, "\n| {} misses the target of | in |\n|---|---|\n", report.methods[m]);
    for (const BenchFigure& figure : figures) {
      const std::string missed = missed_in(report, m, figure);
      if (!missed.empty()) fmt::format_to(out, "| {} | {} |\n", title_of(figure), missed);
    }
  }
  return text;
}

std::string as_csv(const BenchReport& report) {
  const std::vector<BenchFigure> figures = bench_figures();
  std::string text = "case,method,frames,pressing_frames";
  auto out = std::back_inserter(text);
  for (const BenchFigure& figure : figures) fmt::format_to(out, ",{}", figure.key);
  text += '\n';
  for (std::size_t i = 0; i < report.cases.size(); ++i) {
    for (std::size_t m = 0; m < report.methods.size(); ++m) {
      const CaseScore& score = report.at(i, m);
      fmt::format_to(out, "{},{},{},{}", csv_field(report.cases[i]), report.methods[m],
                     score.metrics.frames, score.metrics.pressing_frames);
      for (const BenchFigure& figure : figures) {
        const std::optional<double> value = figure.of(score);
        text += value ? fmt::format(",{:.6g}", *value) : ",";
      }
      text += '\n';
    }
  }
  return text;
}

std::string as_json(const BenchReport& report) {
  Json json{{"cases", report.cases}, {"held_out", report.held_out}};
  const std::vector<BenchFigure> figures = bench_figures();
  for (std::size_t m = 0; m < report.methods.size(); ++m) {
    Json& method = json["methods"][report.methods[m]];
    for (const BenchFigure& figure : figures) {
      const auto summary = summary_of(report, m, figure);
      Json& entry = method[figure.key];
      if (!summary) continue;
      entry = {{"median", summary->median},
               {"worst", summary->worst},
               {"worst_case", report.cases[summary->worst_case]},
               {"measured", summary->measured}};
      if (has_target(figure.target)) {
        entry["met"] = summary->met;
        entry["shortfall_mean"] = summary->shortfall;
      }
      if (const auto apart = summary_of(report, m, figure, CaseSet::held_out)) {
        entry["held_out"] = held_out_json(figure, *apart);
      }
      Json& values = entry["values"] = Json::array();
      for (std::size_t i = 0; i < report.cases.size(); ++i) {
        const std::optional<double> value = figure.of(report.at(i, m));
        values.push_back(value ? Json(*value) : Json(nullptr));
      }
    }
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace nade::cli
