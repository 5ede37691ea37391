#pragma once

#include "state.h"
#include "surface/scaled_surface.h"

namespace nade {

// An object that deforms takes a hand along as one that moves does: what counts is how the hand
// goes against the surface under it.

/// Takes the last frame's hands along with the surface under the drawn one, as a piece: with as
/// much of its motion as was watched.
void ride_along(const ScaledSurface& object, double seconds, ProxyState& state) noexcept;

/// Whether what an object beside the carrier did may be seen under the last frame's drawn hand.
[[nodiscard]] bool is_under_hand(const NearChange& change, const ProxyState& state) noexcept;

/// Whether an object that deformed has the last frame's drawn hand deep inside by that.
[[nodiscard]] bool is_swallowed(const ScaledSurface& object, const ProxyState& state) noexcept;

/// Watches the surface under the last frame's drawn hand while the object deforms: whether it did
/// since the frame before, `seconds` ago.
void watch_surface(const ScaledSurface& object, bool deformed, double seconds,
                   ProxyState& state) noexcept;

}  // namespace nade
