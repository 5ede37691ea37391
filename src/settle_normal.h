#pragma once

#include "nade/settle.h"
#include "settle_frame.h"

namespace nade {

// Which way is out of the object.

/// A unit direction that has turned this share of the way to another.
[[nodiscard]] inline Vec3 mixed(const Vec3& from, const Vec3& to, double share) noexcept {
  return (from + share * (to - from)).normalized();
}

/// The surface's normal at its point nearest to `from`, unit: its own where that runs smoothly,
/// the direction to `from` at an edge or a tip, where its own turns in a moment.
[[nodiscard]] Vec3 outward_normal(const SurfacePoint& nearest, const Vec3& from) noexcept;

/// Of the surface under the tracked palm; as seen from above the hand where that sees an edge,
/// which is round from there, or another side. `push` is the way that the object pushes; where that
/// is zero, in the air, so is the normal. It turns no faster than on a small ball, over which the
/// hand went `motion_m` in `seconds`.
[[nodiscard]] Vec3 normal_under_palm(const ScaledSurface& object, const Pose& palm,
                                     const Vec3& push, double motion_m, double seconds,
                                     SettleMemory& memory) noexcept;

}  // namespace nade
