#pragma once

#include <vector>

#include "nade/settle.h"
#include "posed_hand.h"

namespace nade {

/// What the object does to the hand after a step.
struct ContactForces {
  Vec3 push = Vec3::Zero();  ///< of all skin that it keeps out; world frame
  /// What the contacts add to each freedom's stiffness where the levers that they act on change
  /// (Tournier, Nesme, Gilles, Faure. Stable constrained dynamics. 2015). Without it planes send
  /// some bends from side to side, round after round.
  HandFreedoms geometric = HandFreedoms::Zero();
  bool touches = false;  ///< any skin, if only its cushion
};

/// Of rows that were made for `posed`, in the step's `frame`.
[[nodiscard]] ContactForces contact_forces(const PosedHand& posed,
                                           const std::vector<ContactRow>& rows,
                                           const HandFreedoms& step,
                                           const Eigen::Matrix3d& frame) noexcept;

}  // namespace nade
