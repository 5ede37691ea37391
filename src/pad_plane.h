#pragma once

#include <optional>

#include "nade/settle.h"
#include "settle_frame.h"

namespace nade {

// What stands in for the surface near a pad of skin.

/// How much of a pad's clearance is left, at least, that has its middle there now; metres.
[[nodiscard]] double left_of(const Vec3& middle, double travel_m, PadMemory& known) noexcept;

/// Whether a pad is within `reach_m`; its plane then is found anew, or as it was. `palm` is that of
/// a hand found anew: where a thin wall is between it and the pad, the palm's side of it counts.
[[nodiscard]] bool find_plane(const ScaledSurface& object, const std::optional<Vec3>& palm,
                              const Vec3& middle, double reach_m, double travel_m,
                              PadMemory& known) noexcept;

/// The plane for a pad that has gone on since its own was found, over a surface that goes on to
/// bend as it did on the way there.
[[nodiscard]] PadPlane bent_plane(const PadMemory& known, const Vec3& middle) noexcept;

/// How far a pad may go on with its plane whose skin is so far from the surface; metres.
[[nodiscard]] double plane_serves(const PadMemory& known, double gap_m) noexcept;

}  // namespace nade
