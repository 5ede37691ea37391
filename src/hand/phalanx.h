#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "nade/hand.h"

namespace nade {

/// The phalanges, digit by digit: the thumb's two, the fingers' three. Each goes by the joint where
/// it ends.
inline constexpr auto kPhalanges = [] {
  std::array<std::size_t, 14> all{};
  std::size_t count = 0;
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const DigitJoints joints = joints_of(digit_at(d));
    for (std::size_t end = index_of(joints.metacarpal) + 2; end <= index_of(joints.tip); ++end) {
      all[count++] = end;
    }
  }
  return all;
}();

/// Every two phalanges of different digits.
inline constexpr auto kPhalanxPairs = [] {
  const auto is_of = [](std::size_t phalanx, std::size_t digit) {
    const DigitJoints joints = joints_of(digit_at(digit));
    return phalanx > index_of(joints.metacarpal) && phalanx <= index_of(joints.tip);
  };
  std::array<std::array<std::size_t, 2>, 78> all{};
  std::size_t count = 0;
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    for (std::size_t e = d + 1; e < kDigitCount; ++e) {
      for (const std::size_t one : kPhalanges) {
        for (const std::size_t other : kPhalanges) {
          if (is_of(one, d) && is_of(other, e)) all[count++] = {one, other};
        }
      }
    }
  }
  return all;
}();

/// Where the middle lines of two phalanges are nearest to each other.
struct NearestPoints {
  Vec3 way = Vec3::Zero();  ///< from the other to the one
  double one_share = 0.0;   ///< how far along the one that is, 0 to 1
  double other_share = 0.0;
};
[[nodiscard]] NearestPoints nearest_of(const HandPose& hand, std::size_t one,
                                       std::size_t other) noexcept;

/// By phalanx: from its middle to the nearest of the skin's points; 0 for other joints, and where
/// there is no skin.
[[nodiscard]] std::array<double, kJointCount> phalanx_radii(const HandPose& hand,
                                                            std::span<const Vec3> skin);

}  // namespace nade
