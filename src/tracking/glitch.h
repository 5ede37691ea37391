#pragma once

#include "proxy/state.h"

namespace nade {

// A tracker errs: for a frame or a few it has the hand, or a digit, somewhere else.

/// Whether the tracked hand jumped since the last frame: changed its velocity as no hand can. Where
/// it jumps back, soon, to about where it was, the frame there is the last. Not for a hand that was
/// not seen in the last frame.
[[nodiscard]] bool follow_jumps(const HandPose& tracked, double seconds,
                                ProxyState& state) noexcept;

}  // namespace nade
