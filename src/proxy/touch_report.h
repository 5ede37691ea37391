#pragma once

#include "contact_finder.h"
#include "proxy_hand.h"

namespace nade {

// What is told of a settled hand's contacts.

/// Whether the person has pressed a part in where the drawn one is not far off.
[[nodiscard]] bool is_pressed(const PartTouch& part, const ProxyTuning& tuning) noexcept;

/// Adds the contacts of the parts that are pressed; the hand of `result` is the one that is drawn.
void report_parts(const ContactSearch& search, const PosedHand& settled, const FoundContacts& found,
                  ProxyResult& result) noexcept;

/// Adds those of the bones whose skin touches.
void report_bones(const PosedHand& settled, const FoundContacts& found,
                  ProxyResult& result) noexcept;

/// What became of a tracked hand at such an object, in the world; the tracked one itself where
/// nothing did.
[[nodiscard]] ProxyResult in_world(const Pose& object, const HandPose& tracked,
                                   ProxyResult result) noexcept;

}  // namespace nade
