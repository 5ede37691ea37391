#pragma once

#include "nade/hand.h"

namespace nade {

/// What was corrected from `tracked` to `drawn`, on `newer`: the wrist's shift and turn in the
/// world, every other joint's against the one before it.
[[nodiscard]] HandPose carried_over(const HandPose& tracked, const HandPose& drawn,
                                    const HandPose& newer) noexcept;

}  // namespace nade
