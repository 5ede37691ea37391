#pragma once

#include "nade/settle.h"

namespace nade {

/// What it costs to differ from the tracked hand: the stiffness of a spring on each freedom, which
/// costs half of itself for a radian or a metre. `away` is how far the hand is. The farther a shift
/// or a turn goes, the softer its spring, so that a deep press neither bores into the object nor
/// keeps the hand from lying flat on it.
[[nodiscard]] HandFreedoms stiffness_of_pose(const HandFreedoms& away) noexcept;
/// Of a hand that has left the object: it comes back sooner.
[[nodiscard]] HandFreedoms stiffness_in_air(const HandFreedoms& away) noexcept;

/// What it costs to change the correction: the stiffness of those springs, times the seconds in
/// which each freedom follows them. `height_m` is how far the palm is held above the tracked one.
[[nodiscard]] HandFreedoms damping(const HandFreedoms& away, double height_m) noexcept;
[[nodiscard]] HandFreedoms damping_in_air() noexcept;

}  // namespace nade
