#include "bench_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "nade/io/csv.h"

namespace nade::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string shown(double value) { return fmt::format("{:.2f}", value); }

/// A set that is reported apart.
struct ApartSet {
  CaseSet set;
  std::string_view name;
  const char* key;  ///< in JSON
};
constexpr std::array<ApartSet, 2> kApart{
    {{CaseSet::held_out, "held out", "held_out"}, {CaseSet::scenes, "scenes", "scenes"}}};

std::string percent(double share) { return fmt::format("{:.0f} %", 100.0 * share); }

/// How far a value is from its bounds.
double shortfall_of(const BenchValue& at) {
  return std::max({0.0, at.bounds.at_least.value_or(at.value) - at.value,
                   at.value - at.bounds.at_most.value_or(at.value)});
}

std::string met_of(const std::optional<BenchSummary>& summary) {
  return summary && summary->judged > 0 ? fmt::format("{}/{}", summary->met, summary->judged) : "";
}

bool is_enough(const BenchSummary& summary, double share) {
  // A share in decimals is not exact.
  return static_cast<double>(summary.met) + 1e-9 >= share * static_cast<double>(summary.judged);
}

/// Whether the target is met in as many cases as asked, of each set by itself: "yes", "no", "not
/// held out"; empty where nothing is asked.
std::string reached_of(const BenchReport& report, std::size_t method, const BenchFigure& figure) {
  if (!figure.target.share) return "";
  const auto reaches = [&](CaseSet set) -> std::optional<bool> {
    const auto summary = summary_of(report, method, figure, set);
    if (!summary || summary->judged == 0) return std::nullopt;
    return is_enough(*summary, *figure.target.share);
  };
  const std::optional<bool> strokes = reaches(CaseSet::strokes);
  if (!strokes.value_or(true)) return "no";
  bool is_judged = strokes.has_value();
  for (const ApartSet& of : kApart) {
    const std::optional<bool> apart = reaches(of.set);
    if (!apart.value_or(true)) return fmt::format("not {}", of.name);
    is_judged |= apart.has_value();
  }
  return is_judged ? "yes" : "";
}

std::string title_of(const BenchFigure& figure) {
  const std::string words = words_of(figure.target);
  if (words.empty()) return figure.key;
  const std::string in = figure.target.share ? " in " + percent(*figure.target.share) : "";
  return fmt::format("{} ({}{})", figure.key, words, in);
}

/// The cases in which a method misses a figure's target, the worst first, as "value case; ...".
std::string missed_in(const BenchReport& report, std::size_t method, const BenchFigure& figure) {
  std::vector<std::pair<BenchValue, std::size_t>> missed;
  for (std::size_t i = 0; i < report.cases.size(); ++i) {
    const std::optional<BenchValue> at = value_of(report, figure, i, method);
    if (at && !meets(at->bounds, at->value).value_or(true)) missed.emplace_back(*at, i);
  }
  std::stable_sort(missed.begin(), missed.end(), [](const auto& a, const auto& b) {
    return badness(a.first.bounds, a.first.value) > badness(b.first.bounds, b.first.value);
  });
  std::string text;
  for (const auto& [at, i] : missed) {
    fmt::format_to(std::back_inserter(text), "{}{} {}", text.empty() ? "" : "; ", shown(at.value),
                   report.cases[i].name);
  }
  return text;
}

Json summary_json(const BenchReport& report, const BenchFigure& figure,
                  const BenchSummary& summary) {
  Json json{{"median", summary.median},
            {"worst", summary.worst},
            {"worst_case", report.cases[summary.worst_case].name},
            {"measured", summary.measured}};
  if (summary.judged > 0) {
    json["judged"] = summary.judged;
    json["met"] = summary.met;
    json["shortfall_mean"] = summary.shortfall;
    if (figure.target.share) json["reached"] = is_enough(summary, *figure.target.share);
  }
  return json;
}

}  // namespace

std::vector<BenchFigure> bench_figures() {
  std::vector<BenchFigure> figures;
  for (const MetricInfo& info : metric_table()) {
    figures.push_back({info.key, info.unit, info.target, nullptr, info.value});
  }
  const auto add_flat = [&](const char* key, double at_least,
                            std::optional<double> Metrics::*metric) {
    figures.push_back(
        {key, "", {{at_least, std::nullopt}, 0.9}, nullptr, metric, FigureScope::flat});
  };
  add_flat("print_share_flat", 0.4, &Metrics::print_share);
  add_flat("heel_share_flat", 0.25, &Metrics::heel_share);
  const auto add_time = [&](const char* key, double at_most,
                            std::optional<double> (*time)(const CaseScore&)) {
    figures.push_back({key, "us", {{std::nullopt, at_most}, std::nullopt}, time, nullptr});
  };
  add_time("solve_us_median", 100.0, [](const CaseScore& score) { return score.solve_us_median; });
  add_time("solve_us_p99", 300.0, [](const CaseScore& score) { return score.solve_us_p99; });
  return figures;
}

std::optional<BenchValue> value_of(const BenchReport& report, const BenchFigure& figure,
                                   std::size_t case_index, std::size_t method) {
  if (figure.scope == FigureScope::flat && !report.cases[case_index].is_flat) return std::nullopt;
  const CaseScore& score = report.at(case_index, method);
  const bool is_time = figure.metric == nullptr;
  const auto value = is_time ? figure.time(score) : score.metrics.*figure.metric;
  if (!value) return std::nullopt;
  const auto paper = is_time ? std::nullopt : report.paper[case_index].*figure.metric;
  return BenchValue{*value, bounds_in(figure.target, score.metrics, paper)};
}

std::optional<BenchSummary> summary_of(const BenchReport& report, std::size_t method,
                                       const BenchFigure& figure, std::optional<CaseSet> set) {
  BenchSummary summary;
  std::vector<double> values;
  double worst = 0.0;
  for (std::size_t i = 0; i < report.cases.size(); ++i) {
    if (set && report.cases[i].set != *set) continue;
    const std::optional<BenchValue> at = value_of(report, figure, i, method);
    if (!at) continue;
    const std::optional<bool> met = meets(at->bounds, at->value);
    if (met) ++summary.judged;
    if (met.value_or(false)) ++summary.met;
    summary.shortfall += shortfall_of(*at);
    const double bad = badness(at->bounds, at->value);
    if (values.empty() || bad > worst) {
      worst = bad;
      summary.worst = at->value;
      summary.worst_case = i;
    }
    values.push_back(at->value);
  }
  if (values.empty()) return std::nullopt;
  summary.measured = values.size();
  if (summary.judged > summary.met) {
    summary.shortfall /= static_cast<double>(summary.judged - summary.met);
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  summary.median = *middle;
  return summary;
}

std::string as_text(const BenchReport& report) {
  std::string text = fmt::format("{} cases", report.cases.size());
  auto out = std::back_inserter(text);
  for (const ApartSet& of : kApart) {
    const auto count = std::ranges::count(report.cases, of.set, &BenchCase::set);
    fmt::format_to(out, ", {} of them {}", count, of.name);
  }
  fmt::format_to(out, "\n\n{:<30}{:<14}{:>10}{:>12}{:>10}", "metric", "method", "median", "worst",
                 "met");
  for (const ApartSet& of : kApart) fmt::format_to(out, "{:>10}", of.name);
  fmt::format_to(out, "{:>8}  {:<13}{:>8}  {}\n", "in", "reached", "short by", "worst case");
  for (const BenchFigure& figure : bench_figures()) {
    // The target stands under the name.
    std::vector<std::string> titles{figure.key, "  " + words_of(figure.target)};
    titles.resize(std::max(titles.size(), report.methods.size()));
    for (std::size_t m = 0; m < report.methods.size(); ++m) {
      const auto summary = summary_of(report, m, figure);
      fmt::format_to(out, "{:<30}{:<14}", titles[m], report.methods[m]);
      if (summary) {
        fmt::format_to(out, "{:>10}{:>12}{:>10}", shown(summary->median), shown(summary->worst),
                       met_of(summary));
        for (const ApartSet& of : kApart) {
          fmt::format_to(out, "{:>10}", met_of(summary_of(report, m, figure, of.set)));
        }
        fmt::format_to(out, "{:>8}  {:<13}{:>8}  {}",
                       figure.target.share ? percent(*figure.target.share) : "",
                       reached_of(report, m, figure),
                       summary->met < summary->judged ? shown(summary->shortfall) : "",
                       report.cases[summary->worst_case].name);
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
  fmt::format_to(out, "| {} cases: median, worst (target met in", report.cases.size());
  for (const ApartSet& of : kApart) fmt::format_to(out, "; {}", of.name);
  text += ") in enough |";
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
      fmt::format_to(out, " {}, {}", shown(summary->median), shown(summary->worst));
      if (summary->judged > 0) {
        fmt::format_to(out, " ({}", met_of(summary));
        for (const ApartSet& of : kApart) {
          const std::string met = met_of(summary_of(report, m, figure, of.set));
          if (!met.empty()) fmt::format_to(out, "; {}", met);
        }
        fmt::format_to(out, ") {}", reached_of(report, m, figure));
      }
      text += " |";
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
      fmt::format_to(out, " {} |", summary ? report.cases[summary->worst_case].name : "-");
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
      fmt::format_to(out, "{},{},{},{}", csv_field(report.cases[i].name), report.methods[m],
                     score.metrics.frames, score.metrics.pressing_frames);
      for (const BenchFigure& figure : figures) {
        const std::optional<BenchValue> at = value_of(report, figure, i, m);
        text += at ? fmt::format(",{:.6g}", at->value) : ",";
      }
      text += '\n';
    }
  }
  return text;
}

std::string as_json(const BenchReport& report) {
  Json json{{"cases", Json::array()}};
  for (const BenchCase& one : report.cases) {
    json["cases"].push_back(one.name);
    for (const ApartSet& of : kApart) json[of.key].push_back(one.set == of.set);
  }
  for (std::size_t m = 0; m < report.methods.size(); ++m) {
    Json& method = json["methods"][report.methods[m]];
    for (const BenchFigure& figure : bench_figures()) {
      const auto summary = summary_of(report, m, figure);
      Json& entry = method[figure.key];
      if (!summary) continue;
      entry = summary_json(report, figure, *summary);
      if (const std::string words = words_of(figure.target); !words.empty()) {
        entry["target"] = words;
        if (figure.target.share) entry["in"] = *figure.target.share;
      }
      for (const ApartSet& of : kApart) {
        const auto apart = summary_of(report, m, figure, of.set);
        if (apart) entry[of.key] = summary_json(report, figure, *apart);
      }
      Json& values = entry["values"] = Json::array();
      for (std::size_t i = 0; i < report.cases.size(); ++i) {
        const std::optional<BenchValue> at = value_of(report, figure, i, m);
        values.push_back(at ? Json(at->value) : Json(nullptr));
      }
    }
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace nade::cli
