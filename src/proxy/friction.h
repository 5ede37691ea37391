#pragma once

#include "nade/settle_options.h"
#include "state.h"

namespace nade {

// What of a stroke stays behind along the surface, by friction.

/// After a frame on the surface: `stroked` is the tracked palm's way along it.
void remember_stroke(const Vec3& stroked, const VisibleFriction& friction,
                     SurfaceTouch& touch) noexcept;

/// In the air.
void forget_stroke(SurfaceTouch& touch) noexcept;

/// Follows what friction holds back with a time constant; gives by how much the hand moves for it
/// in this frame.
[[nodiscard]] Vec3 follow_lag(double seconds, double constant_s, SurfaceTouch& touch) noexcept;

}  // namespace nade
