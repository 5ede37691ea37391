#pragma once

#include <vector>

#include "arrow_matrix.h"
#include "contact_term.h"

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

/// Bounds of every freedom's step. low <= high.
struct StepRange {
  HandFreedoms low = HandFreedoms::Constant(-1.0);
  HandFreedoms high = HandFreedoms::Constant(1.0);
};

/// Room for `least_cost_step` to work in: as much as there are terms.
struct SolverRoom {
  std::vector<double> gap_m, change_m, force, stiffness;
  std::vector<std::size_t> bending;

  void reserve(std::size_t terms);
};

/// The step of least cost for springs, a range whose walls are stiff, and contact terms: a convex
/// problem, so there is one. Newton's method on a piecewise quadratic with an exact line search, a
/// fixed number of steps at the most; the nearer `from` is, the fewer.
[[nodiscard]] HandFreedoms least_cost_step(const Springs& springs, const StepRange& range,
                                           const std::vector<ContactTerm>& terms,
                                           const HandFreedoms& from, SolverRoom& room) noexcept;

}  // namespace nade
