#pragma once

#include "contact_finder.h"
#include "nade/geometry.h"

namespace nade {

/// The shift with which a hand found anew begins to settle: to the side of the object that its palm
/// is nearest to, with what of it is deep in the object and nearer to another.
[[nodiscard]] Vec3 shift_outside(const ContactSearch& search, const Vec3& palm) noexcept;

}  // namespace nade
