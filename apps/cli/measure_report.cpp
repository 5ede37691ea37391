#include "measure_report.h"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "nade/io/csv.h"

namespace nade::cli {
namespace {

/// Keeps the order in which the metrics are reported.
using Json = nlohmann::ordered_json;

/// One column of the table.
struct Column {
  std::string_view title;
  const Metrics* metrics;
};

std::vector<Column> columns_of(const MeasureReport& report) {
  std::vector<Column> columns;
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    const auto& hand = report.hands[index_of(side)];
    if (hand) columns.push_back({name_of(side), &*hand});
  }
  // Of one hand alone, "both" would only say it twice.
  if (columns.size() != 1) columns.push_back({"both", &report.both});
  return columns;
}

std::string shown(const std::optional<double>& value) {
  return value ? fmt::format("{:.3f}", *value) : "-";
}

std::string_view verdict(const MetricInfo& info, const Metrics& metrics) {
  const std::optional<double>& value = metrics.*info.value;
  const auto met = value ? meets(bounds_in(info.target, metrics), *value) : std::nullopt;
  if (!met) return "";
  return *met ? "met" : "not met";
}

void add_count(std::string& text, std::string_view name, const std::vector<Column>& columns,
               std::size_t Metrics::*count) {
  auto out = std::back_inserter(text);
  fmt::format_to(out, "{:<24}", name);
  for (const Column& column : columns) fmt::format_to(out, "{:>12}", column.metrics->*count);
  text += '\n';
}

Json metrics_json(const Metrics& metrics) {
  Json json{{"frames", metrics.frames},
            {"pressing_frames", metrics.pressing_frames},
            {"part_samples", metrics.part_samples},
            {"curling_frames", metrics.curling_frames}};
  for (const MetricInfo& info : metric_table()) {
    const std::optional<double>& value = metrics.*info.value;
    json[info.key] = value ? Json(*value) : Json(nullptr);
  }
  return json;
}

}  // namespace

std::string as_text(const MeasureReport& report) {
  const std::vector<Column> columns = columns_of(report);
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "{} against {}, object {}{}\n\n", report.corrected, report.tracked,
                 report.object, report.method.empty() ? "" : ", method " + report.method);
  fmt::format_to(out, "{:<24}", "metric");
  for (const Column& column : columns) fmt::format_to(out, "{:>12}", column.title);
  text += "  unit  target\n";
  for (const MetricInfo& info : metric_table()) {
    fmt::format_to(out, "{:<24}", info.key);
    for (const Column& column : columns) {
      fmt::format_to(out, "{:>12}", shown(column.metrics->*info.value));
    }
    const std::string line = fmt::format("  {:<4}  {:<22}  {}", info.unit, words_of(info.target),
                                         verdict(info, report.both));
    text += line.substr(0, line.find_last_not_of(' ') + 1);
    text += '\n';
  }
  text += '\n';
  add_count(text, "frames", columns, &Metrics::frames);
  add_count(text, "pressing frames", columns, &Metrics::pressing_frames);
  add_count(text, "parts pressed", columns, &Metrics::part_samples);
  add_count(text, "curling frames", columns, &Metrics::curling_frames);
  return text;
}

std::string as_json(const MeasureReport& report) {
  Json json{{"tracked", report.tracked}, {"corrected", report.corrected}};
  json["method"] = report.method.empty() ? Json(nullptr) : Json(report.method);
  json["object"] = report.object;
  json["hand_scale"] = report.hand_scale;
  json.update(metrics_json(report.both));
  json["hands"] = Json::object();
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    const auto& hand = report.hands[index_of(side)];
    if (hand) json["hands"][std::string(name_of(side))] = metrics_json(*hand);
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string csv_names() {
  std::string names = "tracked,corrected,method,object,hand_scale,frames,pressing_frames";
  for (const MetricInfo& info : metric_table()) names += std::string(",") + info.key;
  return names;
}

std::string csv_values(const MeasureReport& report) {
  std::string values =
      fmt::format("{},{},{},{},{:.6g},{},{}", csv_field(report.tracked),
                  csv_field(report.corrected), csv_field(report.method), csv_field(report.object),
                  report.hand_scale, report.both.frames, report.both.pressing_frames);
  for (const MetricInfo& info : metric_table()) {
    const std::optional<double>& value = report.both.*info.value;
    values += value ? fmt::format(",{:.9g}", *value) : ",";
  }
  return values;
}

}  // namespace nade::cli
