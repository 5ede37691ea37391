#include <array>

#include "nade/eval/metrics.h"

namespace nade {
namespace {

constexpr MetricTarget no_target() { return {}; }
constexpr MetricTarget at_most(double value) { return {std::nullopt, value}; }
constexpr MetricTarget at_least(double value) { return {value, std::nullopt}; }
constexpr MetricTarget between(double low, double high) { return {low, high}; }

/// "0 ms" and "0 degrees", as far as they are printed.
constexpr double kZeroLag_ms = 0.5;
constexpr double kZeroAngle_deg = 0.05;

constexpr std::array<MetricInfo, 32> kTable{{
    {"penetration_max_mm", "mm", &Metrics::penetration_max_mm, at_most(2.0)},
    {"penetration_p99_mm", "mm", &Metrics::penetration_p99_mm, no_target()},
    {"penetration_mean_mm", "mm", &Metrics::penetration_mean_mm, at_most(0.3)},
    {"contact_ratio", "", &Metrics::contact_ratio, at_least(0.99)},
    {"part_gap_mean_mm", "mm", &Metrics::part_gap_mean_mm, no_target()},
    {"part_gap_p95_mm", "mm", &Metrics::part_gap_p95_mm, at_most(3.0)},
    {"linkage_gain", "", &Metrics::linkage_gain, between(0.93, 1.07)},
    {"linkage_r", "", &Metrics::linkage_r, at_least(0.98)},
    {"linkage_lag_ms", "ms", &Metrics::linkage_lag_ms, between(-kZeroLag_ms, kZeroLag_ms)},
    {"amplification_p999", "", &Metrics::amplification_p999, at_most(3.0)},
    {"amplification_max", "", &Metrics::amplification_max, at_most(6.0)},
    {"pop_max_mm", "mm", &Metrics::pop_max_mm, at_most(2.0)},
    {"jitter_ratio", "", &Metrics::jitter_ratio, at_most(1.2)},
    {"bend_added_median_deg", "deg", &Metrics::bend_added_median_deg, at_most(15.0)},
    {"bend_added_p95_deg", "deg", &Metrics::bend_added_p95_deg, no_target()},
    {"limit_violation_max_deg", "deg", &Metrics::limit_violation_max_deg, at_most(kZeroAngle_deg)},
    {"curl_kept", "", &Metrics::curl_kept, at_least(0.5)},
    {"print_share", "", &Metrics::print_share, no_target()},
    {"hover_mm", "mm", &Metrics::hover_mm, no_target()},
    {"heel_share", "", &Metrics::heel_share, no_target()},
    {"excess_max_mm", "mm", &Metrics::excess_max_mm, at_most(1.5)},
    {"excess_mean_mm", "mm", &Metrics::excess_mean_mm, at_most(0.3)},
    {"along_p95_mm", "mm", &Metrics::along_p95_mm, at_most(25.0)},
    {"free_max_mm", "mm", &Metrics::free_max_mm, at_most(2.0)},
    {"turn_median_deg", "deg", &Metrics::turn_median_deg, at_most(15.0)},
    {"turn_p95_deg", "deg", &Metrics::turn_p95_deg, at_most(45.0)},
    {"thumb_open_max_deg", "deg", &Metrics::thumb_open_max_deg, at_most(60.0)},
    {"overlap_p99_mm", "mm", &Metrics::overlap_p99_mm, at_most(2.0)},
    {"jolt_p999_mm", "mm", &Metrics::jolt_p999_mm, no_target()},
    {"tremble_mm", "mm", &Metrics::tremble_mm, no_target()},
    {"own_jolt_p999_mm", "mm", &Metrics::own_jolt_p999_mm, no_target()},
    {"own_tremble_mm", "mm", &Metrics::own_tremble_mm, no_target()},
}};

}  // namespace

std::span<const MetricInfo> metric_table() { return kTable; }

std::optional<bool> meets(const MetricTarget& target, double value) {
  if (!target.at_least && !target.at_most) return std::nullopt;
  return (!target.at_least || value >= *target.at_least) &&
         (!target.at_most || value <= *target.at_most);
}

}  // namespace nade
