#pragma once

#include <vector>

#include "posed_hand.h"
#include "settle_solver.h"
#include "touch_finder.h"

namespace nade {

/// Lifts digits over what is in their way. One that a steep side of the object holds back while the
/// person's is beyond it would turn and drag the whole hand about it. `rows` are of what touches.
void lift_over(const PosedHand& posed, const TouchSearch& search,
               const std::vector<ContactRow>& rows, Springs& springs) noexcept;

}  // namespace nade
