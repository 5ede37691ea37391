#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bvh_skeleton.h"
#include "leap_hand.h"
#include "nade/hand.h"

namespace nade::io {

/// Which joints of a file are a digit's.
struct BvhDigit {
  std::optional<std::size_t> metacarpal;  ///< not of the thumb
  /// From the knuckle to the tip, of the thumb from the base of its metacarpal: four, or as many as
  /// the file has.
  std::vector<std::size_t> joints;
  bool has_tip = true;  ///< whether the last one is the end of the last bone

  /// Whether there is a joint for each of ours.
  [[nodiscard]] bool is_whole() const { return has_tip && joints.size() == 4; }
};

/// Which joints of a file are a hand's.
struct BvhHand {
  std::size_t wrist = 0;
  std::array<BvhDigit, kDigitCount> digits{};
  double length = 0.0;  ///< wrist to middle knuckle at rest, in the file's unit
};

/// The hands of a file, by its joints' names.
struct BvhHands {
  std::array<std::optional<BvhHand>, 2> hands{};  ///< by index_of(Handedness)
  /// Of a hand that has not all it needs: "no joints of ring and little"; empty otherwise.
  std::array<std::string, 2> lacking{};
};

/// `only`: the side of joints whose names say none.
[[nodiscard]] BvhHands find_bvh_hands(const BvhSkeleton& skeleton, std::optional<Handedness> only);

/// The points of a hand in a frame, times `unit_m`; what the file lacks in the generic hand's
/// proportions.
[[nodiscard]] LeapHand points_of(const BvhHand& hand, Handedness side, const BvhSkeleton& skeleton,
                                 const std::vector<Pose>& poses, double unit_m);

}  // namespace nade::io
