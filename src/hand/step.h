#pragma once

#include <array>

#include "freedoms.h"
#include "nade/correction.h"

namespace nade {

// A correction's changes as steps of the hand's freedoms, along and about the object's axes.

/// The step that leads from one correction to another.
[[nodiscard]] HandFreedoms step_between(const Correction& from, const Correction& to) noexcept;

/// And the correction that a step leads to, with every bend inside its range.
[[nodiscard]] Correction after_step(const Correction& from, const HandFreedoms& step,
                                    const std::array<BendRange, kDigitCount>& ranges) noexcept;

/// Whether a correction leaves the hand as it is tracked, bit for bit.
[[nodiscard]] bool is_none(const Correction& correction) noexcept;

/// The farthest that any skin goes in a step, about; metres.
[[nodiscard]] double reach_of(const HandFreedoms& step) noexcept;

}  // namespace nade
