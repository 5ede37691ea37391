#pragma once

#include "nade/settle.h"
#include "settle_frame.h"
#include "touch_finder.h"

namespace nade {

// What becomes of a drawn hand that is held up by an object which the person's has left: lifted
// over the edge that it was pressed in beside, or gone right through, or on along the table past
// what stands on it.

/// Whether the object holds up a hand that has left it.
[[nodiscard]] bool is_held_up(const SettleMemory& memory) noexcept;

/// Takes in whether the tracked hand is clear of the object, or presses elsewhere. Whether that
/// lets the drawn one go: then it is to be found anew. Not for one that is.
[[nodiscard]] bool follow_leaving(const TouchSearch& search, SettleMemory& memory) noexcept;

/// Whether a hand that was drawn so goes farther at once than it does by itself.
[[nodiscard]] bool is_thrown(const ShownBefore& before, const Correction& now) noexcept;

/// A hand that was let go is drawn on its way back from one correction to another. What is left of
/// that, `return_share` of `returning`, is counted along the object's axes.
void start_return(const Correction& from, const Correction& to, SettleMemory& memory) noexcept;

/// Takes in a frame of the way back, in which the tracked hand went so far, and may press again.
void follow_return(double motion_m, double seconds, bool pressed, SettleMemory& memory) noexcept;

}  // namespace nade
