#pragma once

#include <array>
#include <cstddef>

#include "nade/flesh.h"

namespace nade {

/// The joint where a digit's first phalanx ends; the last ends in the tip. A phalanx goes by the
/// joint where it ends.
[[nodiscard]] constexpr std::size_t first_phalanx(Digit digit) noexcept {
  return index_of(joints_of(digit).metacarpal) + 2;
}
[[nodiscard]] constexpr std::size_t last_phalanx(Digit digit) noexcept {
  return index_of(joints_of(digit).tip);
}

/// Where the middle lines of two phalanges are nearest to each other.
struct PhalanxPair {
  Vec3 way = Vec3::Zero();  ///< from the other to the one
  double one_share = 0.0;   ///< how far along the one that is, 0 to 1
  double other_share = 0.0;
};
[[nodiscard]] PhalanxPair nearest_of(const HandPose& hand, std::size_t one,
                                     std::size_t other) noexcept;

/// `HandFlesh::phalanx_radius_m` of a hand whose skin points are known.
[[nodiscard]] std::array<double, kJointCount> measure_phalanges(const HandFlesh& flesh,
                                                                const HandPose& bind);

}  // namespace nade
