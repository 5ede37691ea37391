#pragma once

#include <span>
#include <vector>

#include "posed_hand.h"
#include "settle_solver.h"
#include "touch_finder.h"

namespace nade {

/// Lifts digits over what is in their way. One that a steep side of the object holds back while the
/// person's is beyond it would turn and drag the whole hand about it, or fold under the hand that
/// goes on. `rows` are of what touches; what climbs gets another, and is not drawn down.
void lift_over(const PosedHand& posed, const TouchSearch& search, std::vector<ContactRow>& rows,
               Springs& springs) noexcept;

/// How firmly a hand some of which climbs has to be held back, so that no joint is thrown; times
/// the stiffness of what holds it. 0 where none of it does.
[[nodiscard]] double firmness_of_climb(std::span<const ContactRow> rows) noexcept;

}  // namespace nade
