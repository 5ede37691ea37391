#pragma once

#include "contact_finder.h"
#include "nade/geometry.h"

namespace nade {

/// Where a hand found anew begins to settle.
struct OutsideStart {
  Vec3 shift = Vec3::Zero();
  Vec3 push = Vec3::Zero();  ///< unit, where the palm is in the object; zero elsewhere
};

/// On the side of the object that its palm is nearest to, with what of it is deep in the object
/// and nearer to another.
[[nodiscard]] OutsideStart start_outside(const ContactSearch& search, const Vec3& palm) noexcept;

}  // namespace nade
