#include "bvh_hand.h"

#include <fmt/format.h>

#include <algorithm>

#include "bvh_names.h"
#include "nade/flesh.h"

namespace nade::io {
namespace {

constexpr std::size_t kPointsOfBvhDigit = 4;
/// From the wrist to a finger's first joint over that joint's bone: half where it is the base of
/// the metacarpal, two where it is the knuckle.
constexpr double kKnuckleRatio = 1.1;
/// A bone is some tenth of a hand's length.
constexpr double kShortestBvhBone = 1e-3;

/// What is known of a joint by its name and those above it.
struct KnownJoint {
  BvhName name;
  std::vector<std::size_t> children;
};

std::vector<KnownJoint> known_joints(const BvhSkeleton& skeleton, std::optional<Handedness> only) {
  std::vector<KnownJoint> known(skeleton.joints.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    BvhName& name = known[i].name;
    name = bvh_name_from(skeleton.joints[i].name);
    const std::optional<std::size_t> parent = skeleton.joints[i].parent;
    if (!parent) {
      if (!name.side) name.side = only;
      continue;
    }
    known[*parent].children.push_back(i);
    const BvhName& above = known[*parent].name;
    if (!name.side) name.side = above.side;
    if (name.digit || name.digit_number) continue;
    name.digit = above.digit;
    name.digit_number = above.digit_number;
  }
  return known;
}

/// Names the digits that are only counted, from the thumb on.
void name_counted_digits(std::vector<KnownJoint>& known) {
  const bool from_zero = std::any_of(known.begin(), known.end(), [](const KnownJoint& joint) {
    return joint.name.digit_number == std::size_t{0};
  });
  for (KnownJoint& joint : known) {
    if (joint.name.digit || !joint.name.digit_number) continue;
    const std::size_t index = *joint.name.digit_number - (from_zero ? 0 : 1);
    if (index < kDigitCount) joint.name.digit = digit_at(index);
  }
}

class HandFinder {
 public:
  HandFinder(const BvhSkeleton& skeleton, const std::vector<KnownJoint>& known, Handedness side)
      : skeleton_(skeleton), known_(known), side_(side), rest_(rest_positions(skeleton)) {}

  /// None where there is nothing of a hand, or where `lacking` says of what.
  std::optional<BvhHand> find(std::string& lacking) {
    BvhHand hand;
    std::array<std::optional<std::size_t>, kDigitCount> first{};
    for (std::size_t d = 0; d < kDigitCount; ++d) {
      first[d] = first_joint_of(digit_at(d));
      if (first[d]) hand.digits[d].joints = chain_from(*first[d]);
    }
    std::string missing;
    for (std::size_t d = 0; d < kDigitCount; ++d) {
      if (hand.digits[d].joints.size() >= 2) continue;
      missing += fmt::format("{}{}", missing.empty() ? "" : ", ", name_of(part_of(digit_at(d))));
    }
    if (!missing.empty()) {
      const bool some =
          std::any_of(first.begin(), first.end(), [](const auto& joint) { return joint; });
      if (some) lacking = "no joints of " + missing;
      return std::nullopt;
    }
    const std::optional<std::size_t> wrist = wrist_above(first);
    if (!wrist) {
      lacking = "no joint above all its digits";
      return std::nullopt;
    }
    hand.wrist = *wrist;
    for (std::size_t d = 0; d < kDigitCount; ++d) sort_digit(digit_at(d), hand);
    const std::vector<std::size_t>& middle = hand.digits[index_of(Digit::middle)].joints;
    if (middle.empty() || !(distance(hand.wrist, middle[0]) > 0.0)) {
      lacking = "wrist and middle knuckle lie in one point";
      return std::nullopt;
    }
    hand.length = distance(hand.wrist, middle[0]);
    drop_short_bones(hand, lacking);
    if (!lacking.empty()) return std::nullopt;
    return hand;
  }

 private:
  [[nodiscard]] double distance(std::size_t a, std::size_t b) const {
    return (rest_[a] - rest_[b]).norm();
  }
  [[nodiscard]] bool is_of(std::size_t joint, Digit digit) const {
    return known_[joint].name.side == side_ && known_[joint].name.digit == digit;
  }
  [[nodiscard]] std::optional<std::size_t> first_joint_of(Digit digit) const {
    for (std::size_t i = 0; i < known_.size(); ++i) {
      if (is_of(i, digit)) return i;
    }
    return std::nullopt;
  }
  /// A digit's joints from its first one on.
  [[nodiscard]] std::vector<std::size_t> chain_from(std::size_t first) const {
    std::vector<std::size_t> chain{first};
    const Digit digit = *known_[first].name.digit;
    while (true) {
      const std::vector<std::size_t>& children = known_[chain.back()].children;
      const auto next = std::find_if(children.begin(), children.end(),
                                     [&](std::size_t child) { return is_of(child, digit); });
      if (next == children.end()) return chain;
      chain.push_back(*next);
    }
  }
  [[nodiscard]] std::vector<std::size_t> path_to(std::size_t joint) const {
    std::vector<std::size_t> path;
    for (std::optional<std::size_t> at = skeleton_.joints[joint].parent; at;
         at = skeleton_.joints[*at].parent) {
      path.push_back(*at);
    }
    std::reverse(path.begin(), path.end());
    return path;
  }
  /// The lowest joint above all digits; the one above it where that is a palm on a wrist.
  std::optional<std::size_t> wrist_above(
      const std::array<std::optional<std::size_t>, kDigitCount>& first) {
    std::vector<std::size_t> shared = path_to(*first[0]);
    for (std::size_t d = 0; d < kDigitCount; ++d) {
      paths_[d] = path_to(*first[d]);
      const auto end =
          std::mismatch(shared.begin(), shared.end(), paths_[d].begin(), paths_[d].end());
      shared.erase(end.first, shared.end());
    }
    if (shared.empty()) return std::nullopt;
    shared_ = shared.size();
    const BvhName& name = known_[shared.back()].name;
    if (name.is_palm && shared.size() > 1) {
      const BvhName& above = known_[shared[shared.size() - 2]].name;
      if (above.is_wrist && above.side == side_) return shared[shared.size() - 2];
    }
    return shared.back();
  }
  /// Takes the metacarpal off a digit's joints, and what is more than four.
  void sort_digit(Digit digit, BvhHand& hand) const {
    BvhDigit& sorted = hand.digits[index_of(digit)];
    std::vector<std::size_t>& joints = sorted.joints;
    if (digit == Digit::thumb) {
      // Counted from 0 the first one is a bone of the carpus.
      const bool has_carpal = joints.size() > kPointsOfBvhDigit &&
                              known_[joints[0]].name.number == std::size_t{0} &&
                              known_[joints[0]].name.digit_number == std::nullopt;
      if (has_carpal) joints.erase(joints.begin());
    } else if (starts_at_metacarpal(joints, hand.wrist)) {
      sorted.metacarpal = joints[0];
      joints.erase(joints.begin());
    } else if (is_above_one_finger(digit)) {
      sorted.metacarpal = paths_[index_of(digit)].back();
    }
  }
  /// Whether the joint that a finger hangs on is above no other finger. The thumb may hang on it.
  [[nodiscard]] bool is_above_one_finger(Digit finger) const {
    const std::vector<std::size_t>& path = paths_[index_of(finger)];
    if (path.size() <= shared_) return false;
    for (std::size_t d = index_of(Digit::index); d < kDigitCount; ++d) {
      const bool other = d != index_of(finger);
      if (other && std::find(paths_[d].begin(), paths_[d].end(), path.back()) != paths_[d].end()) {
        return false;
      }
    }
    return true;
  }
  [[nodiscard]] bool starts_at_metacarpal(const std::vector<std::size_t>& joints,
                                          std::size_t wrist) const {
    if (joints.size() < 3) return false;
    if (known_[joints[0]].name.is_metacarpal) return true;
    return joints.size() >= kPointsOfBvhDigit &&
           distance(wrist, joints[0]) < kKnuckleRatio * distance(joints[0], joints[1]);
  }
  void drop_short_bones(BvhHand& hand, std::string& lacking) const {
    for (std::size_t d = 0; d < kDigitCount; ++d) {
      std::vector<std::size_t>& joints = hand.digits[d].joints;
      for (std::size_t i = 1; i < joints.size();) {
        const bool is_short =
            !(distance(joints[i - 1], joints[i]) > kShortestBvhBone * hand.length);
        if (is_short) {
          joints.erase(joints.begin() + static_cast<std::ptrdiff_t>(i));
        } else {
          ++i;
        }
      }
      if (joints.size() > kPointsOfBvhDigit) joints.resize(kPointsOfBvhDigit);
      hand.digits[d].has_tip =
          joints.size() == kPointsOfBvhDigit || skeleton_.joints[joints.back()].is_end;
      const std::size_t least = hand.digits[d].has_tip ? 2 : 3;
      if (joints.size() < least) {
        lacking = fmt::format("no joints of {}", name_of(part_of(digit_at(d))));
      }
    }
  }

  const BvhSkeleton& skeleton_;
  const std::vector<KnownJoint>& known_;
  Handedness side_;
  std::vector<Vec3> rest_;
  std::array<std::vector<std::size_t>, kDigitCount> paths_{};
  std::size_t shared_ = 0;  ///< how many joints are above all digits
};

/// The lengths of a digit's last three bones in the generic hand.
std::array<double, 3> generic_bones(Digit digit) {
  static const HandPose kRest = generic_rest_pose(Handedness::right);
  const std::size_t tip = index_of(joints_of(digit).tip);
  std::array<double, 3> bones{};
  for (std::size_t i = 0; i < bones.size(); ++i) {
    bones[i] = (kRest.joints[tip - 2 + i].position - kRest.joints[tip - 3 + i].position).norm();
  }
  return bones;
}

/// The four points of a digit, in the file's unit.
std::array<Vec3, kPointsOfBvhDigit> digit_points(const BvhDigit& digit, Digit which,
                                                 const BvhSkeleton& skeleton,
                                                 const std::vector<Pose>& poses) {
  std::array<Vec3, kPointsOfBvhDigit> points{};
  const std::size_t count = digit.joints.size();
  for (std::size_t i = 0; i < count; ++i) points[i] = poses[digit.joints[i]].position;
  if (digit.is_whole()) return points;
  const std::array<double, 3> bones = generic_bones(which);
  if (!digit.has_tip) {
    // The last bone goes on from the one before it, turned as its joint is.
    const BvhJoint& last = skeleton.joints[digit.joints.back()];
    const double length = (points[2] - points[1]).norm() * bones[2] / bones[1];
    points[3] = points[2] + poses[digit.joints.back()].rotation * last.offset.normalized() * length;
    return points;
  }
  // The last bone that the file has is several of ours in a line.
  const std::size_t before = count - 2;
  const Vec3 from = points[before];
  const Vec3 last = points[count - 1] - from;
  double whole = 0.0;
  for (std::size_t i = before; i < bones.size(); ++i) whole += bones[i];
  double passed = 0.0;
  for (std::size_t i = before; i < bones.size(); ++i) {
    passed += bones[i];
    points[i + 1] = from + passed / whole * last;
  }
  return points;
}

}  // namespace

BvhHands find_bvh_hands(const BvhSkeleton& skeleton, std::optional<Handedness> only) {
  std::vector<KnownJoint> known = known_joints(skeleton, only);
  name_counted_digits(known);
  BvhHands found;
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    found.hands[index_of(side)] =
        HandFinder(skeleton, known, side).find(found.lacking[index_of(side)]);
  }
  return found;
}

LeapHand points_of(const BvhHand& hand, Handedness side, const BvhSkeleton& skeleton,
                   const std::vector<Pose>& poses, double unit_m) {
  LeapHand points;
  points.side = side;
  points.wrist = unit_m * poses[hand.wrist].position;
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const BvhDigit& digit = hand.digits[d];
    const auto four = digit_points(digit, digit_at(d), skeleton, poses);
    LeapFinger& finger = points.fingers[d];
    finger = {unit_m * four[0], unit_m * four[1], unit_m * four[2], unit_m * four[3], {}};
    if (digit.metacarpal) finger.metacarpal = unit_m * poses[*digit.metacarpal].position;
  }
  return points;
}

}  // namespace nade::io
