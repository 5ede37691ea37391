#include "hand_intake.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nade::io {
namespace {

constexpr std::size_t kKeptValues = 1024;
constexpr double kShortestStep_s = 1e-3;
constexpr double kLongestStep_s = 0.2;

struct Unit {
  double size;
  std::string_view name;
};
constexpr std::array<Unit, 4> kTimes{
    {{1e-9, "nanoseconds"}, {1e-6, "microseconds"}, {1e-3, "milliseconds"}, {1.0, "seconds"}}};
constexpr std::array<Unit, 6> kLengths{{{1.0, "metres"},
                                        {1e-3, "millimetres"},
                                        {1e-2, "centimetres"},
                                        {0.0254, "inches"},
                                        {0.3048, "feet"},
                                        {1e3, "kilometres"}}};

template <std::size_t N>
std::string_view name_of_unit(const std::array<Unit, N>& units, double size) {
  for (const Unit& unit : units) {
    if (std::abs(size / unit.size - 1.0) < 1e-6) return unit.name;
  }
  return {};
}

std::string doubt_of_length(double length_m) {
  const std::optional<double> unit_m = unit_by_length(length_m);
  const std::string found = fmt::format(
      "expected 60 to 130 mm from wrist to middle knuckle, found {:.4g} m at the median", length_m);
  if (!unit_m) return found;
  return fmt::format("the positions look to be in {}, expected metres; multiply them by {} ({})",
                     name_of_unit(kLengths, *unit_m), *unit_m, found);
}

/// What to multiply each quaternion by where the joints have other axes.
std::string turn_of(const HandCheck& check) {
  const Vec3 bone = vector_of(check.bone_axis);
  const Vec3 back = vector_of(check.back_axis);
  std::string axes = fmt::format("{} points to the fingertip and {} to the back of the hand",
                                 name_of(check.bone_axis), name_of(check.back_axis));
  if (std::abs(bone.dot(back)) > 0.5) return axes;
  Eigen::Matrix3d turn;
  turn << back.cross(-bone), back, -bone;
  Quat q = Quat(turn).normalized();
  q.coeffs() += Eigen::Vector4d::Zero();  // no -0
  return fmt::format(
      "{}; multiply each quaternion from the right by {:.4g}, {:.4g}, {:.4g}, {:.4g}", axes, q.x(),
      q.y(), q.z(), q.w());
}

std::string doubt_of_turns(HandCause cause, const HandCheck& first, double bone_angle_rad) {
  if (cause == HandCause::swapped_sides && first.cause == HandCause::upside_down) {
    return fmt::format("{} (the fingers bend to the back of the hand)", name_of(cause));
  }
  std::string found =
      fmt::format("-Z of the joints is {:.0f} degrees off their bones at the median, expected 0",
                  bone_angle_rad / kDegree);
  if (cause == HandCause::other_bone_axes) found = turn_of(first);
  return fmt::format("{} ({})", name_of(cause), found);
}

}  // namespace

std::string_view name_of_length_unit(double unit_m) { return name_of_unit(kLengths, unit_m); }

void ThinnedValues::add(double value) {
  if (seen_++ % stride_ != 0) return;
  kept_.push_back(value);
  if (kept_.size() < kKeptValues) return;
  for (std::size_t i = 0; 2 * i < kept_.size(); ++i) kept_[i] = kept_[2 * i];
  kept_.resize(kept_.size() / 2);
  stride_ *= 2;
}

std::optional<double> ThinnedValues::median() const {
  if (kept_.empty()) return std::nullopt;
  std::vector<double> values = kept_;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool HandIntake::admit(HandPose& hand, const std::string& place, Warnings& warnings) {
  const HandPose read = hand;
  hand = with_unit_rotations(read);
  const std::optional<HandFault> fault = fault_of(hand);
  judge(hand);
  if (fault) {
    warnings.add(Oddity::unusable_hand, fmt::format("{}: {}: {}; the hand is left out of the frame",
                                                    place, name_of(hand.side), name_of(*fault)));
    return false;
  }
  for (std::size_t i = 0; i < kJointCount; ++i) {
    if (hand.joints[i] == read.joints[i]) continue;
    warnings.add(Oddity::rotation_not_unit,
                 fmt::format("{}: {}: joint {}: the quaternion is not of unit length; it is made "
                             "so",
                             place, name_of(hand.side), i));
  }
  return true;
}

void HandIntake::judge(const HandPose& hand) {
  const HandCheck check = check_hand(hand);
  if (check.has(HandDoubt::collapsed) || check.length_m == 0.0) return;
  Side& side = sides_[index_of(hand.side)];
  ++side.hands;
  side.length_m.add(check.length_m);
  side.bone_angle_rad.add(check.bone_angle_rad);
  if (check.has(HandDoubt::length)) ++side.odd_lengths;
  const bool turns = check.has(HandDoubt::turns) || check.has(HandDoubt::bones) ||
                     check.has(HandDoubt::back) || check.has(HandDoubt::bend);
  if (!turns) return;
  // Inferred from the wrong side, the rotations are as wrong as it.
  const bool other_side =
      rotations_ == Rotations::inferred && check.cause == HandCause::upside_down;
  const auto cause = static_cast<std::size_t>(other_side ? HandCause::swapped_sides : *check.cause);
  if (side.causes[cause]++ == 0) side.first[cause] = check;
}

void HandIntake::add_time(std::int64_t time_ns) {
  if (last_ns_) step_s_.add(1e-9 * static_cast<double>(time_ns - *last_ns_));
  last_ns_ = time_ns;
}

std::optional<std::string> HandIntake::doubt_of_time() const {
  const std::optional<double> step_s = step_s_.median();
  if (!step_s || (*step_s >= kShortestStep_s && *step_s <= kLongestStep_s)) return std::nullopt;
  const std::string found = fmt::format(
      "expected frames 1 to 200 ms apart, found {:.4g} ms at the median", 1e3 * *step_s);
  for (const Unit& unit : kTimes) {
    const double factor = unit.size / tick_s_;
    const double meant_s = factor * *step_s;
    if (!(meant_s >= kShortestStep_s && meant_s <= kLongestStep_s)) continue;
    return fmt::format("the times look to be in {}, expected {}; multiply them by {:.9g} ({})",
                       unit.name, name_of_unit(kTimes, tick_s_), factor, found);
  }
  return found;
}

std::vector<std::string> HandIntake::doubts(const std::string& name) const {
  std::vector<std::string> sentences;
  for (const Handedness hand : {Handedness::left, Handedness::right}) {
    const Side& side = sides_[index_of(hand)];
    const std::string where = fmt::format("{}: {} hand", name, name_of(hand));
    if (2 * side.odd_lengths > side.hands) {
      sentences.push_back(
          fmt::format("{}: {}", where, doubt_of_length(side.length_m.median().value_or(0.0))));
    }
    const std::size_t odd = std::accumulate(side.causes.begin(), side.causes.end(), std::size_t{0});
    if (2 * odd <= side.hands) continue;
    const auto most = static_cast<std::size_t>(
        std::max_element(side.causes.begin(), side.causes.end()) - side.causes.begin());
    sentences.push_back(fmt::format("{}: {}", where,
                                    doubt_of_turns(static_cast<HandCause>(most), *side.first[most],
                                                   side.bone_angle_rad.median().value_or(0.0))));
  }
  if (const auto time = doubt_of_time()) sentences.push_back(fmt::format("{}: {}", name, *time));
  return sentences;
}

}  // namespace nade::io
