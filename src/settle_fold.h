#pragma once

#include "posed_hand.h"
#include "settle_solver.h"
#include "touch_finder.h"

namespace nade {

/// Fingers that stand on the surface, pressed in along their length, could give way to either side.
/// A torque at their knuckles has them fold to the one that the pressed fingers together lean to.
void fold_alike(const PosedHand& posed, const PatchTouches& patches, Springs& springs) noexcept;

}  // namespace nade
