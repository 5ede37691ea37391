#pragma once

#include "nade/settle.h"

namespace nade {

// What lies between drawn and tracked hand along the surface.

/// After a frame on the surface: on a curved one the drawn hand goes on as far as the tracked one
/// went, not as far as the nearest point would, and strays by no more than the depth. `shift` is
/// the drawn palm's, `stroked` the tracked one's way along the surface, `normal` the surface's.
void remember_slide(const Vec3& shift, const Vec3& stroked, const Vec3& normal,
                    const VisibleFriction& friction, ContactState& contact) noexcept;

/// In the air.
void forget_slide(ContactState& contact) noexcept;

/// Follows what friction holds back; gives by how much the hand moves for it in this frame.
[[nodiscard]] Vec3 follow_lag(double seconds, ContactState& contact) noexcept;

}  // namespace nade
