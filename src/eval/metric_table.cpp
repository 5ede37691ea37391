#include <fmt/format.h>

#include <array>

#include "nade/eval/metrics.h"

namespace nade {
namespace {

constexpr MetricTarget no_target() { return {}; }
constexpr MetricTarget at_most(double value, double share) {
  return {{std::nullopt, value}, share};
}
constexpr MetricTarget at_least(double value, double share) {
  return {{value, std::nullopt}, share};
}
constexpr MetricTarget between(double low, double high, double share) {
  return {{low, high}, share};
}
constexpr MetricTarget beside_paper(MetricTarget target) {
  target.from = TargetOrigin::paper;
  return target;
}
constexpr MetricTarget above_own(MetricTarget target, std::optional<double> Metrics::*own,
                                 double times) {
  target.from = TargetOrigin::tracked;
  target.own = own;
  target.own_times = times;
  return target;
}

/// "0 ms" and "0 degrees", as far as they are printed.
constexpr double kZeroLag_ms = 0.5;
constexpr double kZeroAngle_deg = 0.05;

constexpr std::array<MetricInfo, 32> kTable{{
    {"penetration_max_mm", "mm", &Metrics::penetration_max_mm, no_target()},
    {"penetration_p99_mm", "mm", &Metrics::penetration_p99_mm, no_target()},
    {"penetration_mean_mm", "mm", &Metrics::penetration_mean_mm, no_target()},
    {"contact_ratio", "", &Metrics::contact_ratio, at_least(0.99, 0.95)},
    {"part_gap_mean_mm", "mm", &Metrics::part_gap_mean_mm, no_target()},
    {"part_gap_p95_mm", "mm", &Metrics::part_gap_p95_mm, no_target()},
    {"linkage_gain", "", &Metrics::linkage_gain, between(0.93, 1.07, 0.85)},
    {"linkage_r", "", &Metrics::linkage_r, at_least(0.98, 0.85)},
    {"linkage_lag_ms", "ms", &Metrics::linkage_lag_ms, between(-kZeroLag_ms, kZeroLag_ms, 0.85)},
    {"amplification_p999", "", &Metrics::amplification_p999, at_most(3.0, 0.95)},
    {"amplification_max", "", &Metrics::amplification_max, at_most(6.0, 0.95)},
    {"pop_max_mm", "mm", &Metrics::pop_max_mm, at_most(2.0, 0.95)},
    {"jitter_ratio", "", &Metrics::jitter_ratio, no_target()},
    {"bend_added_median_deg", "deg", &Metrics::bend_added_median_deg, no_target()},
    {"bend_added_p95_deg", "deg", &Metrics::bend_added_p95_deg, no_target()},
    {"limit_violation_max_deg", "deg", &Metrics::limit_violation_max_deg,
     at_most(kZeroAngle_deg, 1.0)},
    {"curl_kept", "", &Metrics::curl_kept, at_least(0.5, 0.90)},
    {"print_share", "", &Metrics::print_share, beside_paper(at_least(0.0, 0.85))},
    {"hover_mm", "mm", &Metrics::hover_mm, beside_paper(at_most(0.0, 0.85))},
    {"heel_share", "", &Metrics::heel_share, no_target()},
    {"excess_max_mm", "mm", &Metrics::excess_max_mm, at_most(1.5, 0.95)},
    {"excess_mean_mm", "mm", &Metrics::excess_mean_mm, at_most(0.3, 0.95)},
    {"along_p95_mm", "mm", &Metrics::along_p95_mm, at_most(25.0, 0.85)},
    {"free_max_mm", "mm", &Metrics::free_max_mm, at_most(2.0, 0.95)},
    {"turn_median_deg", "deg", &Metrics::turn_median_deg, at_most(15.0, 0.85)},
    {"turn_p95_deg", "deg", &Metrics::turn_p95_deg, at_most(45.0, 0.85)},
    {"thumb_open_max_deg", "deg", &Metrics::thumb_open_max_deg, at_most(60.0, 0.95)},
    {"overlap_p99_mm", "mm", &Metrics::overlap_p99_mm, at_most(2.0, 0.90)},
    {"jolt_p999_mm", "mm", &Metrics::jolt_p999_mm,
     above_own(at_most(3.0, 0.90), &Metrics::own_jolt_p999_mm, 1.0)},
    {"tremble_mm", "mm", &Metrics::tremble_mm,
     above_own(at_most(0.15, 0.90), &Metrics::own_tremble_mm, 0.5)},
    {"own_jolt_p999_mm", "mm", &Metrics::own_jolt_p999_mm, no_target()},
    {"own_tremble_mm", "mm", &Metrics::own_tremble_mm, no_target()},
}};

}  // namespace

std::span<const MetricInfo> metric_table() { return kTable; }

MetricBounds bounds_in(const MetricTarget& target, const Metrics& metrics,
                       std::optional<double> paper) {
  std::optional<double> origin = 0.0;
  if (target.from == TargetOrigin::paper) origin = paper;
  if (target.from == TargetOrigin::tracked) origin = metrics.*target.own;
  if (!origin) return {};
  const double above = target.own_times * *origin;
  MetricBounds bounds = target.bounds;
  if (bounds.at_least) *bounds.at_least += above;
  if (bounds.at_most) *bounds.at_most += above;
  return bounds;
}

std::optional<bool> meets(const MetricBounds& bounds, double value) {
  if (!bounds.any()) return std::nullopt;
  return (!bounds.at_least || value >= *bounds.at_least) &&
         (!bounds.at_most || value <= *bounds.at_most);
}

std::string words_of(const MetricTarget& target) {
  const auto bound = [&](double value) -> std::string {
    switch (target.from) {
      case TargetOrigin::zero:
        break;
      case TargetOrigin::tracked:
        return fmt::format("{:g} + {}own", value,
                           target.own_times == 1.0 ? "" : fmt::format("{:g} ", target.own_times));
      case TargetOrigin::paper:
        return value == 0.0 ? "the paper's" : fmt::format("the paper's + {:g}", value);
    }
    return fmt::format("{:g}", value);
  };
  const auto& [at_least, at_most] = target.bounds;
  if (at_least && at_most) return fmt::format("{} to {}", bound(*at_least), bound(*at_most));
  if (at_least) return "at least " + bound(*at_least);
  if (at_most) return "at most " + bound(*at_most);
  return "";
}

}  // namespace nade
