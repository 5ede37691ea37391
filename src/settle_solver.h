#pragma once

#include <span>

#include "arrow_matrix.h"
#include "nade/settle.h"

namespace nade {

/// Springs on the freedoms: they cost half of step * stiffness * step, less force * step.
struct Springs {
  ArrowMatrix stiffness;
  HandFreedoms force = HandFreedoms::Zero();  ///< at no step

  /// One more on every freedom, at rest after the step `rest`.
  void add(const HandFreedoms& more, const HandFreedoms& rest) {
    stiffness.add_diagonal(more);
    force += more.cwiseProduct(rest);
  }
};

/// A wall on both sides of every freedom's step, as stiff as said. low <= high.
struct Walls {
  HandFreedoms low = HandFreedoms::Zero();
  HandFreedoms high = HandFreedoms::Zero();
  HandFreedoms stiffness = HandFreedoms::Zero();
};

/// Springs against walls, and rows that push where their gap is below 0 or pull where it is above.
struct SettleProblem {
  Springs springs;
  Walls range;  ///< of motion
  Walls rate;   ///< of change
  std::span<const ContactRow> rows;
};

/// The stiffness of a surface, as the rows see it: 1/m^2 for a cost of 1 a radian squared.
inline constexpr double kSurfaceStiffness = 1.2e7;

/// The step of least cost: a convex problem, so there is one. Newton's method on a piecewise
/// quadratic, a fixed number of steps at the most; the nearer `from` is, the fewer.
[[nodiscard]] HandFreedoms least_cost_step(const SettleProblem& problem,
                                           const HandFreedoms& from) noexcept;

/// The gap of a row after a step.
[[nodiscard]] double gap_after(const ContactRow& row, const HandFreedoms& step) noexcept;

/// How hard a row pushes at a gap, below 0 where it pulls.
[[nodiscard]] double force_at(const ContactRow& row, double gap_m) noexcept;

}  // namespace nade
