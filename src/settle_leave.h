#pragma once

#include "nade/settle.h"
#include "touch_finder.h"

namespace nade {

// What becomes of a drawn hand that is held up by an object which the person's has left: lifted
// over the edge that it was pressed in beside, or gone right through.

/// Takes in whether the tracked hand is clear of the object, with a joint of the drawn one `away_m`
/// from it. Whether the object lets it go: then it is to be found anew. Not for one that is.
[[nodiscard]] bool follow_leaving(const TouchSearch& search, double away_m,
                                  SettleMemory& memory) noexcept;

}  // namespace nade
