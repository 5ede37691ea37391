#include "bend_meter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace nade {
namespace {

constexpr double kCurling_rad = 15.0 * kDegree;

/// The joint that a hinge's joint hangs on: of the thumb's first, the wrist.
Joint parent_of(Digit digit, std::size_t hinge) {
  if (digit == Digit::thumb && hinge == 0) return Joint::wrist;
  return joint_at(index_of(hinge_joint(digit, hinge)) - 1);
}

Quat relative_rotation(const HandPose& hand, Digit digit, std::size_t hinge) {
  return hand[parent_of(digit, hinge)].rotation.conjugate() *
         hand[hinge_joint(digit, hinge)].rotation;
}

double excess(double value, double low, double high) {
  return std::max({0.0, value - high, low - value});
}

}  // namespace

BendMeter::FrameResult BendMeter::add(const HandPose& tracked, const HandPose& corrected,
                                      Pressing pressing) {
  const HandAngles tracked_angles = measure_angles(tracked);
  const HandAngles corrected_angles = measure_angles(corrected);
  take_limits(tracked_angles, corrected_angles);
  if (pressing == Pressing::no) {
    first_touch_.reset();
    return {};
  }
  const double added_median_deg = take_bend_added(tracked, corrected);
  return {take_curl({curl_of(tracked_angles), curl_of(corrected_angles)}), added_median_deg};
}

double BendMeter::take_bend_added(const HandPose& tracked, const HandPose& corrected) {
  std::array<double, kDigitCount * kHingeCount> added_deg{};
  for (std::size_t digit = 0; digit < kDigitCount; ++digit) {
    for (std::size_t hinge = 0; hinge < kHingeCount; ++hinge) {
      const Quat before = relative_rotation(tracked, digit_at(digit), hinge);
      const Quat after = relative_rotation(corrected, digit_at(digit), hinge);
      double& added = added_deg[digit * kHingeCount + hinge];
      added = before.angularDistance(after) / kDegree;
      added_deg_.add(added);
    }
  }
  const auto middle = added_deg.begin() + added_deg.size() / 2;
  std::nth_element(added_deg.begin(), middle, added_deg.end());
  return *middle;
}

void BendMeter::take_limits(const HandAngles& tracked, const HandAngles& corrected) {
  double worst = violation_max_.value_or(0.0);
  for (std::size_t digit = 0; digit < kDigitCount; ++digit) {
    for (std::size_t hinge = 0; hinge < kHingeCount; ++hinge) {
      const HingeRange range = range_of_motion(digit_at(digit), hinge);
      const auto flexion_excess = [&](const HandAngles& angles) {
        return excess(angles[digit][hinge].flexion, range.flexion_min, range.flexion_max);
      };
      worst = std::max(worst, flexion_excess(corrected) - flexion_excess(tracked));
      if (hinge != 0) continue;
      const auto abduction_excess = [&](const HandAngles& angles) {
        return excess(angles[digit][hinge].abduction, range.abduction_min, range.abduction_max);
      };
      worst = std::max(worst, abduction_excess(corrected) - abduction_excess(tracked));
    }
  }
  violation_max_ = worst;
}

bool BendMeter::take_curl(const Curls& now) {
  if (!first_touch_) first_touch_ = now;
  const double tracked = now.tracked - first_touch_->tracked;
  if (!(tracked > kCurling_rad)) return false;
  curl_sum_.tracked += tracked;
  curl_sum_.corrected += now.corrected - first_touch_->corrected;
  ++curling_frames_;
  return true;
}

void BendMeter::break_off() { first_touch_.reset(); }

void BendMeter::merge(const BendMeter& other) {
  added_deg_.merge(other.added_deg_);
  if (other.violation_max_) {
    violation_max_ = std::max(violation_max_.value_or(0.0), *other.violation_max_);
  }
  curl_sum_.tracked += other.curl_sum_.tracked;
  curl_sum_.corrected += other.curl_sum_.corrected;
  curling_frames_ += other.curling_frames_;
  break_off();
}

Bend BendMeter::finish() const {
  Bend bend;
  bend.added_median_deg = added_deg_.quantile(0.5);
  bend.added_p95_deg = added_deg_.quantile(0.95);
  if (violation_max_) bend.limit_violation_max_deg = *violation_max_ / kDegree;
  if (curling_frames_ > 0) bend.curl_kept = curl_sum_.corrected / curl_sum_.tracked;
  bend.curling_frames = curling_frames_;
  return bend;
}

}  // namespace nade
