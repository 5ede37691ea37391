#pragma once

#include "nade/settle.h"

namespace nade {

// A tracker errs: for a frame or a few it has the hand, or a digit, somewhere else.

/// A tracked joint's velocity in the last frame, m/s, as far as that was believed.
[[nodiscard]] Vec3 velocity_before(const SettleMemory& memory, std::size_t joint) noexcept;

/// By how much a hand may change its velocity in a frame of so many seconds, m/s.
[[nodiscard]] double most_change(double seconds) noexcept;

/// Whether the tracked hand jumped since the last frame: changed its velocity as no hand can, or
/// was not seen for so long that it may have. Where it jumps back, soon, to about where it was, the
/// correction is again as it was there.
[[nodiscard]] bool follow_jumps(const HandPose& tracked, double seconds,
                                SettleMemory& memory) noexcept;

}  // namespace nade
