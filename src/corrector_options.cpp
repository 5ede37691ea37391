#include <algorithm>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <string>

#include "nade/corrector.h"

namespace nade {
namespace {

constexpr std::array<std::string_view, 3> kMethodNames{"none", "paper", "nade"};  // as Method

constexpr double kLargestHand_m = 0.5;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLeast = std::numeric_limits<double>::min();

/// A number of the options, and what it may be.
struct OptionRange {
  const char* name;
  double value;
  double least;
  double most;
};

Error bad_option(const std::string& name, const std::string& expected) {
  return {ErrorCode::out_of_range, name + ": expected " + expected};
}

Status first_error(std::initializer_list<OptionRange> options) {
  for (const OptionRange& option : options) {
    if (option.value >= option.least && option.value <= option.most) continue;
    const std::string from = option.least == kLeast ? "above 0" : std::to_string(option.least);
    const std::string to = option.most < std::numeric_limits<double>::max()
                               ? " to " + std::to_string(option.most)
                               : std::string();
    return bad_option(option.name, from + to + ", found " + std::to_string(option.value));
  }
  return ok_status();
}

}  // namespace

std::string_view name_of(Method method) { return kMethodNames[static_cast<std::size_t>(method)]; }

std::optional<Method> method_from_name(std::string_view name) {
  const auto found = std::find(kMethodNames.begin(), kMethodNames.end(), name);
  if (found == kMethodNames.end()) return std::nullopt;
  return static_cast<Method>(found - kMethodNames.begin());
}

CorrectorOptions paper_literal() {
  CorrectorOptions options;
  options.method = Method::paper;
  options.contact.test_point = TestPoint::joint;
  options.contact.counted_hits = CountedHits::any;
  options.contact.entry_side = EntrySide::forgotten;
  options.contact.full_turn_depth_m = 0.0;
  options.release_s = 0.0;
  return options;
}

Status check_options(const SettleOptions& options) {
  return first_error({{"softness_m", options.softness_m, 0.0, kSoftest_m},
                      {"softness_depth_m", options.softness_depth_m, kLeast, kInfinity},
                      {"friction.coefficient", options.friction.coefficient, 0.0, 2.0},
                      {"friction.kinetic", options.friction.kinetic, 0.0, 1.0},
                      {"friction.longest_lag_m", options.friction.longest_lag_m, 0.0, kInfinity}});
}

Status check_options(const CorrectorOptions& options) {
  constexpr double kAny = std::numeric_limits<double>::max();
  Status status = first_error(
      {{"skin_hand_length_m", options.skin_hand_length_m, kLeast, kAny},
       {"hand_length_m", options.hand_length_m, 0.0, kLargestHand_m},
       {"release_s", options.release_s, 0.0, 1.0},
       {"contact.full_turn_depth_m", options.contact.full_turn_depth_m, 0.0, 0.2},
       {"contact.push_through_limit_m", options.contact.push_through_limit_m, 0.0, kInfinity},
       {"fingers.max_ray_turn_rad", options.fingers.max_ray_turn_rad, 0.0,
        0.5 * std::numbers::pi}});
  for (std::size_t i = 0; status.ok() && i < kPartCount; ++i) {
    status = first_error({{"skin.depth_m", options.skin.depth_m[i], -kAny, kAny}});
  }
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    const auto& flesh = options.flesh[index_of(side)];
    if (!status.ok() || !flesh) continue;
    if (flesh->side != side) return bad_option("flesh", "a hand's on its own side");
    status = first_error({{"flesh: hand_length_m", flesh->hand_length_m, kLeast, kAny}});
  }
  return status.ok() ? check_options(options.settle) : status;
}

}  // namespace nade
