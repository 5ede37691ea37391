#pragma once

#include "nade/settle.h"

namespace nade {

// A tracker errs: for a frame or a few it has the hand, or a digit, somewhere else.

/// Whether the tracked hand jumped since the last frame: changed its velocity as no hand can, or
/// was not seen for so long that it may have. A jump says nothing of the hand's unrest. Where it
/// jumps back, soon, to about where it was, the frame there is the last.
[[nodiscard]] bool follow_jumps(const HandPose& tracked, double seconds,
                                SettleMemory& memory) noexcept;

/// A joint's velocity after a jump, m/s: the last frame's, changed toward the tracked one's by as
/// much as a hand can.
[[nodiscard]] Vec3 velocity_after_jump(const HandPose& tracked, std::size_t joint, double seconds,
                                       const SettleMemory& memory) noexcept;

}  // namespace nade
