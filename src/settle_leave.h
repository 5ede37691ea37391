#pragma once

#include "nade/settle.h"
#include "touch_finder.h"

namespace nade {

// What becomes of a drawn hand that is held up by an object which the person's has left: lifted
// over the edge that it was pressed in beside, or gone right through.

/// Takes in whether the tracked hand is clear of the object: `clear_s` and `let_go`, which stand
/// for what the drawn hand does about it. Not for a hand found anew.
void follow_leaving(const TouchSearch& search, SettleMemory& memory) noexcept;

}  // namespace nade
