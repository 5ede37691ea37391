#pragma once

#include "nade/settle.h"
#include "posed_hand.h"
#include "touch_finder.h"

namespace nade {

// How much stronger than a calm hand a restless one may be drawn to the surface.

/// Of a hand that was not seen before.
[[nodiscard]] Unrest no_unrest() noexcept;

/// Takes in how the tracked hand went on from the last frame.
void follow_unrest(const HandPose& last, const HandPose& now, double seconds,
                   Unrest& unrest) noexcept;

/// Middle and last flexion of the tracked fingers, their mean, radians.
[[nodiscard]] double curl_of(const HandModel& model) noexcept;

/// How the person curls the fingers. Drawn to the surface strongly, they would be opened.
struct Curl {
  double now_rad = 0.0;
  double at_touch_rad = 0.0;  ///< when the hand touched
};

/// `edge` is `SettleMemory::edge`.
[[nodiscard]] PullStrength pull_strength(const Unrest& unrest, const Curl& curl,
                                         double edge) noexcept;

}  // namespace nade
