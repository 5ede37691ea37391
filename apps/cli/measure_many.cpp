#include "measure_many.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "batch.h"
#include "bench_report.h"
#include "console.h"
#include "nade/io/output_file.h"

namespace nade::cli {
namespace {

namespace fs = std::filesystem;
using OrderedJson = nlohmann::ordered_json;

constexpr std::string_view kCorrectedEnding = "-corrected";

/// A corrected recording of a data set, and the tracked one; empty where that is not there.
struct RecordingsOfOneTake {
  std::string name;
  std::string tracked;
  std::string corrected;
};

Result<std::vector<RecordingsOfOneTake>> takes_of(const MeasureMany& set) {
  const Result<std::vector<std::string>> tracked = recordings_in(set.tracked);
  if (!tracked) return tracked.error();
  const std::string& folder = set.corrected.empty() ? set.tracked : set.corrected;
  const Result<std::vector<std::string>> corrected = recordings_in(folder);
  if (!corrected) return corrected.error();
  std::map<std::string, std::string> by_stem;
  for (const std::string& name : *tracked) by_stem.emplace(stem_of(name), name);
  std::vector<RecordingsOfOneTake> takes;
  for (const std::string& name : *corrected) {
    std::string stem = stem_of(name);
    if (set.corrected.empty()) {
      if (!stem.ends_with(kCorrectedEnding)) continue;
      stem.resize(stem.size() - kCorrectedEnding.size());
    }
    RecordingsOfOneTake take{stem, {}, (fs::path(folder) / name).string()};
    if (const auto found = by_stem.find(stem); found != by_stem.end()) {
      take.tracked = (fs::path(set.tracked) / found->second).string();
    }
    takes.push_back(std::move(take));
  }
  if (!takes.empty()) return takes;
  return Error{ErrorCode::not_found,
               set.corrected.empty()
                   ? fmt::format("{}: expected recordings NAME and NAME-corrected, found none; a "
                                 "second folder says where the corrected ones are",
                                 set.tracked)
                   : fmt::format("{}: expected corrected recordings, found none", set.corrected)};
}

/// All of it as one method's cases, each a take.
BenchReport as_cases(const std::vector<MeasureReport>& reports) {
  BenchReport cases;
  cases.methods = {"corrected"};
  for (const MeasureReport& report : reports) {
    cases.cases.push_back({report.corrected});
    cases.scores.push_back({report.both, std::nullopt, std::nullopt});
    cases.paper.emplace_back();
  }
  return cases;
}

/// Calls `tell` with each metric that was measured.
template <class Tell>
void for_each_metric(const BenchReport& cases, Tell&& tell) {
  for (const MetricInfo& info : metric_table()) {
    const BenchFigure figure{info.key, info.unit, info.target, nullptr, info.value};
    if (const auto summary = summary_of(cases, 0, figure)) tell(figure, *summary);
  }
}

std::string table_of(const BenchReport& cases) {
  std::string text =
      fmt::format("{} recordings\n\n{:<26}{:>12}{:>12}{:>11}  {}\n", cases.cases.size(), "metric",
                  "median", "worst", "met", "worst in");
  for_each_metric(cases, [&](const BenchFigure& figure, const BenchSummary& summary) {
    const std::string met =
        summary.judged > 0 ? fmt::format("{} of {}", summary.met, summary.judged) : "";
    fmt::format_to(std::back_inserter(text), "{:<26}{:>12.3f}{:>12.3f}{:>11}  {}\n", figure.key,
                   summary.median, summary.worst, met, cases.cases[summary.worst_case].name);
  });
  return text;
}

std::string json_of(const std::vector<MeasureReport>& reports, const BenchReport& cases,
                    const std::vector<Error>& failures) {
  OrderedJson json{{"recordings", reports.size()}};
  json["failed"] = OrderedJson::array();
  for (const Error& failure : failures) json["failed"].push_back(failure.message);
  json["summary"] = OrderedJson::object();
  for_each_metric(cases, [&](const BenchFigure& figure, const BenchSummary& summary) {
    OrderedJson& entry = json["summary"][figure.key];
    entry = {{"median", summary.median},
             {"worst", summary.worst},
             {"worst_recording", cases.cases[summary.worst_case].name},
             {"measured", summary.measured}};
    if (summary.judged == 0) return;
    entry["judged"] = summary.judged;
    entry["met"] = summary.met;
  });
  json["rows"] = OrderedJson::array();
  for (const MeasureReport& report : reports) {
    json["rows"].push_back(OrderedJson::parse(as_json(report)));
  }
  return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

std::string csv_of(const std::vector<MeasureReport>& reports) {
  std::string text = csv_names() + "\n";
  for (const MeasureReport& report : reports) text += csv_values(report) + "\n";
  return text;
}

}  // namespace

Status measure_many(const MeasureMany& set,
                    const std::function<Result<MeasureReport>(
                        const std::string& tracked, const std::string& corrected)>& measure) {
  const Result<std::vector<RecordingsOfOneTake>> takes = takes_of(set);
  if (!takes) return takes.error();
  std::vector<Result<MeasureReport>> measured(takes->size(), MeasureReport{});
  on_threads(set.jobs > 0 ? set.jobs : cores(), takes->size(), "measured",
             [&](std::size_t index, std::size_t) {
               const RecordingsOfOneTake& take = (*takes)[index];
               measured[index] = take.tracked.empty()
                                     ? Error{ErrorCode::not_found,
                                             fmt::format("{}: expected its tracked recording in "
                                                         "{}, found none",
                                                         take.corrected, set.tracked)}
                                     : measure(take.tracked, take.corrected);
             });
  std::vector<MeasureReport> reports;
  std::vector<Error> failures;
  for (Result<MeasureReport>& report : measured) {
    if (report) {
      reports.push_back(std::move(report).value());
    } else {
      warn(report.error().message);
      failures.push_back(report.error());
    }
  }
  const BenchReport cases = as_cases(reports);
  if (set.json) {
    const Status written = write_whole(*set.json, json_of(reports, cases, failures));
    if (!written) return written;
  }
  if (set.csv) {
    const Status written = write_whole(*set.csv, csv_of(reports));
    if (!written) return written;
  }
  if (!set.json && set.csv != "-" && !reports.empty()) {
    const Status written = write_whole("-", table_of(cases));
    if (!written) return written;
  }
  if (failures.empty()) return ok_status();
  return Error{ErrorCode::bad_value, fmt::format("{} of {} recordings could not be measured",
                                                 failures.size(), takes->size())};
}

}  // namespace nade::cli
