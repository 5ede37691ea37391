#pragma once

#include "nade/eval/compare.h"

namespace nade::cli {

/// A physics hand, to be compared with: a palm and 15 phalanges as rigid bodies that chase the
/// tracked hand, the palm by its velocity, the joints by motors within their range of motion;
/// contacts with the object stop them. Named "physics". A hand that is found inside the object
/// starts outside it; one whose palm is left behind by more than 0.1 m is drawn as tracked until it
/// is clear of the object. Not for objects that move.
// Based on: Catto. Modeling and Solving Constraints. 2009. In the manner of the rigid-body hands
// of game engines: one body a bone, drives, contacts.
[[nodiscard]] ComparedMethod physics_method();

}  // namespace nade::cli
