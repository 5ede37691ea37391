#include "solver.h"

#include <cmath>
#include <span>

namespace nade {
namespace {

// Numerics.
constexpr double kWallStiffness = 1e5;
constexpr int kMostNewtonSteps = 16;
constexpr int kMostSearchSteps = 24;
constexpr double kNoStep = 1e-7;
constexpr double kFlat = 1e-9;  // slope over curvature at which a line search ends
constexpr double kLongestSearch = 2.0;

HandFreedoms beyond(const StepRange& range, const HandFreedoms& step) {
  return (step - range.high).cwiseMax(0.0) + (step - range.low).cwiseMin(0.0);
}

/// The cost's slope and curvature along a line of steps.
struct Bow {
  double slope = 0.0;
  double curvature = 0.0;
};

class Newton {
 public:
  Newton(const Springs& springs, const StepRange& range, const std::vector<ContactTerm>& terms,
         SolverRoom& room)
      : springs_(springs), range_(range), terms_(terms), room_(room), hessian_(springs.stiffness) {
    for (std::vector<double>* values : {&room_.gap_m, &room_.change_m, &room_.force}) {
      values->resize(terms_.size());
    }
    room_.stiffness.assign(terms_.size(), 0.0);
  }

  HandFreedoms run(HandFreedoms step) {
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      room_.gap_m[i] = gap_after(terms_[i].row, step);
    }
    for (int i = 0; i < kMostNewtonSteps; ++i) {
      const HandFreedoms direction = newton_direction(step);
      if (direction.cwiseAbs().maxCoeff() < kNoStep) break;
      const double length = search(step, direction);
      step += length * direction;
      for (std::size_t k = 0; k < terms_.size(); ++k) {
        room_.gap_m[k] += length * room_.change_m[k];
      }
      if (length == 1.0) break;  // no term or wall bends on the way: this is the least
    }
    return step;
  }

 private:
  HandFreedoms newton_direction(const HandFreedoms& step) {
    slope_ = springs_.stiffness.times(step) - springs_.force;
    const HandFreedoms over = beyond(range_, step);
    HandFreedoms down = -slope_ - kWallStiffness * over;
    const HandFreedoms walls = kWallStiffness * (over.array() != 0.0).cast<double>().matrix();
    hessian_.add_diagonal(walls - walls_);
    walls_ = walls;
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      const ContactTerm& term = terms_[i];
      const double force = room_.force[i] = term.force_at(room_.gap_m[i]);
      const double more = term.stiffness_at(room_.gap_m[i]) - room_.stiffness[i];
      if (more != 0.0) hessian_.add(term.row, more);
      room_.stiffness[i] += more;
      if (force == 0.0) continue;
      down.head<6>() += force * term.row.wrist;
      if (term.row.digit) {
        down.segment<4>(first_freedom(index_of(*term.row.digit))) += force * term.row.bend;
      }
    }
    return hessian_.solve(down);
  }

  /// How far along a direction the cost is least.
  double search(const HandFreedoms& step, const HandFreedoms& direction) {
    Bow even{slope_.dot(direction), direction.dot(springs_.stiffness.times(direction))};
    room_.bending.clear();
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      const double change_m = gap_after(terms_[i].row, direction) - terms_[i].row.gap_m;
      room_.change_m[i] = change_m;
      const double gap_m = room_.gap_m[i];
      if (terms_[i].bends_between(gap_m, gap_m + kLongestSearch * change_m)) {
        room_.bending.push_back(i);
        continue;
      }
      even.slope -= room_.force[i] * change_m;
      even.curvature += room_.stiffness[i] * change_m * change_m;
    }
    double low = 0.0;
    double high = kLongestSearch;
    double length = 1.0;
    for (int i = 0; i < kMostSearchSteps; ++i) {
      const Bow bow = bow_at(even, step, direction, length);
      if (std::abs(bow.slope) <= kFlat * bow.curvature) break;
      (bow.slope < 0.0 ? low : high) = length;
      const double next = length - bow.slope / bow.curvature;
      length = next > low && next < high ? next : 0.5 * (low + high);
    }
    return length;
  }

  Bow bow_at(const Bow& even, const HandFreedoms& step, const HandFreedoms& direction,
             double length) const {
    Bow bow{even.slope + length * even.curvature, even.curvature};
    const HandFreedoms over = beyond(range_, step + length * direction);
    for (Eigen::Index i = 0; i < kHandFreedoms; ++i) {
      if (over[i] == 0.0) continue;
      bow.slope += kWallStiffness * over[i] * direction[i];
      bow.curvature += kWallStiffness * direction[i] * direction[i];
    }
    for (const std::size_t i : room_.bending) {
      const double change_m = room_.change_m[i];
      const double gap_m = room_.gap_m[i] + length * change_m;
      bow.slope -= terms_[i].force_at(gap_m) * change_m;
      bow.curvature += terms_[i].stiffness_at(gap_m) * change_m * change_m;
    }
    return bow;
  }

  const Springs& springs_;
  const StepRange& range_;
  std::span<const ContactTerm> terms_;
  SolverRoom& room_;
  HandFreedoms slope_ = HandFreedoms::Zero();  ///< of the springs
  ArrowMatrix hessian_;                        ///< with the terms and walls that acted last
  HandFreedoms walls_ = HandFreedoms::Zero();
};

}  // namespace

void SolverRoom::reserve(std::size_t terms) {
  for (std::vector<double>* values : {&gap_m, &change_m, &force, &stiffness}) {
    values->reserve(terms);
  }
  bending.reserve(terms);
}

HandFreedoms least_cost_step(const Springs& springs, const StepRange& range,
                             const std::vector<ContactTerm>& terms, const HandFreedoms& from,
                             SolverRoom& room) noexcept {
  return Newton(springs, range, terms, room).run(from);
}

}  // namespace nade
