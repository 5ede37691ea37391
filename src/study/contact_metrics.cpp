#include "nade/study/contact_metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string_view>
#include <utility>

#include "nade/eval/recording_pair.h"
#include "nade/io/object_file.h"
#include "nade/study/statistics.h"

namespace nade::study {
namespace {

constexpr std::array<std::string_view, 4> kReported{"penetration_mean_mm", "contact_ratio",
                                                    "part_gap_p95_mm", "linkage_gain"};

/// Objects are loaded once for all trials.
using Objects = std::map<std::string, LoadedObject>;

Result<LoadedObject*> object_of(const std::string& spec, Objects& objects) {
  const auto known = objects.find(spec);
  if (known != objects.end()) return &known->second;
  Result<LoadedObject> loaded = load_object(spec);
  if (!loaded) return loaded.error();
  return &objects.emplace(spec, std::move(loaded).value()).first->second;
}

/// Where the plan has the file of an object that a header names; else as the header has it.
std::string spec_of(const std::string& object, const std::optional<Plan>& plan) {
  if (!plan) return object;
  for (const StudyObject& planned : plan->objects) {
    if (object_name(planned.spec) == object_name(object)) return planned.spec;
  }
  return object;
}

Result<PairMetrics> measure(const RecordedTrial& trial, const std::optional<Plan>& plan,
                            Objects& objects) {
  Result<RecordingPair> pair =
      RecordingPair::open(trial.tracked_path, trial.tracked_path, trial.corrected_path);
  if (!pair) return pair.error();
  const auto placing = placing_from(pair->corrected_header().unknown_json, trial.corrected_path);
  if (!placing) return placing.error();
  if (!placing->has_value()) {
    return Error{ErrorCode::bad_value,
                 fmt::format("{}: expected a header that names the object, found none",
                             trial.corrected_path)};
  }
  const Result<LoadedObject*> found = object_of(spec_of((*placing)->object, plan), objects);
  if (!found) return found.error();
  LoadedObject& object = **found;
  std::optional<std::int64_t> start_ns = (*placing)->animation_start_ns;
  return pair->measure(object.placed((*placing)->placement), [&](std::int64_t time_ns) {
    if (!object.animation) return;
    if (!start_ns) start_ns = time_ns;
    object.move_to(1e-9 * static_cast<double>(time_ns - *start_ns));
  });
}

}  // namespace

ContactMetrics measure_trials(const StudyData& data, const std::function<void()>& before_trial) {
  ContactMetrics contact;
  Objects objects;
  for (const RecordedTrial& trial : data.recordings) {
    if (before_trial) before_trial();
    Result<PairMetrics> measured = measure(trial, data.plan, objects);
    if (!measured) {
      contact.warnings.push_back(measured.error().message + ", not measured");
      continue;
    }
    for (std::string& warning : measured->warnings) contact.warnings.push_back(std::move(warning));
    contact.trials.push_back({trial, measured->both});
  }
  return contact;
}

std::span<const MetricInfo> reported_metrics() {
  static const std::vector<MetricInfo> kInfos = [] {
    std::vector<MetricInfo> chosen;
    for (const MetricInfo& info : metric_table()) {
      if (std::find(kReported.begin(), kReported.end(), info.key) != kReported.end()) {
        chosen.push_back(info);
      }
    }
    return chosen;
  }();
  return kInfos;
}

std::optional<MetricSummary> summary_of(const ContactMetrics& contact, const MetricInfo& metric,
                                        const std::string& object, const std::string& method) {
  std::vector<double> values;
  for (const TrialMetrics& measured : contact.trials) {
    if (measured.trial.method != method) continue;
    if (!object.empty() && measured.trial.object != object) continue;
    const std::optional<double>& value = measured.metrics.*metric.value;
    if (value) values.push_back(*value);
  }
  if (values.empty()) return std::nullopt;
  return MetricSummary{values.size(),
                       {quantile(values, 0.25), quantile(values, 0.5), quantile(values, 0.75)}};
}

}  // namespace nade::study
