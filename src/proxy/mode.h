#pragma once

#include "contact_finder.h"
#include "state.h"

namespace nade {

// What becomes of a drawn hand that the object holds up and the person has left: lifted over the
// edge that it was pressed in beside, or gone right through, or on along the table past what stands
// on it. It is let go, found anew where the person is, and fades there.

/// Takes in whether the tracked hand is clear of the object, or presses elsewhere, while the drawn
/// one is held far from it: then its mode is `blocked`. Whether it is let go now.
[[nodiscard]] bool follow_blocking(const ContactSearch& search, ProxyState& state) noexcept;

/// Whether a hand that was drawn so goes farther at once than it does by itself.
[[nodiscard]] bool is_thrown(const ShownBefore& before, const Correction& now) noexcept;

/// Times tuning's `return_s`, a hand that was let go is back; one that an object threw takes
/// longer, because the person sees no reason for it.
inline constexpr double kLetGoLonger = 1.5;
inline constexpr double kThrownLonger = 2.0;

/// Such a hand is drawn on its way from one correction to another.
void start_return(const Correction& from, const Correction& to, double lasts_s,
                  ProxyState& state) noexcept;

/// Takes in a frame of the way back; gives how much of `returning.from` is left, 1 to 0.
[[nodiscard]] double follow_return(double seconds, ProxyState& state) noexcept;

/// The mode that a frame ends in.
[[nodiscard]] ProxyMode mode_after(bool touches, bool pushed, const ProxyState& state) noexcept;

}  // namespace nade
