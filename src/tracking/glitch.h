#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "hand/freedoms.h"

namespace nade {

// A tracker errs: for a frame or a few it has the hand, or a digit, somewhere else.

/// Where the tracked hand was before a jump.
struct BeforeJump {
  HandPose tracked;
  double ago_s = std::numeric_limits<double>::infinity();
};

/// How the tracked hand moves.
struct TrackedMotion {
  JointVectors velocity{};               ///< m/s
  std::array<BeforeJump, 3> jumps_from;  ///< a tracker may err anew before it is back
};

/// Whether the tracked hand jumped since the last frame: changed its velocity as no hand can.
enum class Jump : std::uint8_t {
  none,
  away,  ///< what is known of the last frame is to be kept, under `slot`
  back,  ///< soon, to about where it was: what was kept under `slot` is the last frame
};
struct SeenJump {
  Jump jump = Jump::none;
  std::size_t slot = 0;  ///< in `jumps_from`
};

/// Not for a hand that was not seen in the last frame, in which it was at `last`.
[[nodiscard]] SeenJump follow_jumps(const HandPose& last, const HandPose& tracked, double seconds,
                                    TrackedMotion& motion) noexcept;

/// Takes in the velocity of a frame. A jump says little of it.
void follow_velocity(const HandPose& last, const HandPose& tracked, double seconds, bool jumped,
                     TrackedMotion& motion) noexcept;

}  // namespace nade
