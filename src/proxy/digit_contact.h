#pragma once

#include <vector>

#include "contact_term.h"
#include "hand/posed_hand.h"

namespace nade {

/// Adds terms that keep the phalanges of different digits out of each other, but for what the
/// tracked ones overlap. Each digit of a pair is to go half the way, as if the other went the rest.
/// None for phalanges farther apart than twice `reach_m`. `firmness`: 0 to 1, all of it.
void keep_digits_apart(const HandModel& model, const HandFlesh& flesh, const PosedHand& posed,
                       double reach_m, double firmness, std::vector<ContactTerm>& terms) noexcept;

}  // namespace nade
