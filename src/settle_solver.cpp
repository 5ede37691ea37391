#include "settle_solver.h"

// Based on: Hintermüller, Ito, Kunisch. The primal-dual active set strategy as a semismooth Newton
// method. 2002.

#include <algorithm>
#include <array>
#include <cmath>

#include "touch_finder.h"

namespace nade {
namespace {

constexpr int kMostSteps = 16;
constexpr int kMostSearches = 24;
/// Along a Newton direction, as shares of it.
constexpr double kFarthest = 2.0;
constexpr double kNoSlope = 1e-9;
/// A change of every freedom by less than this, in metres or radians, is none.
constexpr double kSmallestChange = 1e-8;
constexpr double kCushionStiffness = 24143.0;
/// A pull grows with the gap as far as this, and is the same from there on.
constexpr double kPullGrowth_m = 0.0016114;

double along(const ContactRow& row, const HandFreedoms& change) {
  double sum = row.wrist.dot(change.head<6>());
  if (row.digit) {
    sum += row.bend.dot(change.segment<4>(first_freedom(index_of(*row.digit))));
  }
  return sum;
}

/// How a row's force falls with its gap, per metre.
double stiffness_at(const ContactRow& row, double gap_m) {
  switch (row.kind) {
    case RowKind::draw_near:
      return gap_m > 0.0 && gap_m < kPullGrowth_m ? row.stiffness : 0.0;
    case RowKind::climb:
    case RowKind::hold_back:
      return gap_m < 0.0 ? row.stiffness : 0.0;
    case RowKind::keep_out:
      break;
  }
  double stiffness = gap_m < 0.0 ? kSurfaceStiffness : 0.0;
  if (gap_m < row.cushion_m) stiffness += kCushionStiffness;
  if (gap_m < row.brake_m) stiffness += row.stiffness;
  return stiffness;
}

/// How far beyond a wall, signed.
HandFreedoms beyond(const Walls& walls, const HandFreedoms& step) {
  return (step - walls.high).cwiseMax(0.0) + (step - walls.low).cwiseMin(0.0);
}

/// The problem at a step, and its rows' gaps there and along a direction.
class Descent {
 public:
  Descent(const SettleProblem& problem, const HandFreedoms& from)
      : problem_(problem), count_(std::min(problem.rows.size(), gaps_.size())), step_(from) {
    for (std::size_t i = 0; i < count_; ++i) gaps_[i] = gap_after(problem.rows[i], from);
  }

  /// Toward the least cost of the quadratic that holds here.
  [[nodiscard]] HandFreedoms newton_direction() {
    HandFreedoms diagonal = HandFreedoms::Zero();
    spring_slope_ = problem_.springs.stiffness.times(step_) - problem_.springs.force;
    HandFreedoms force = -spring_slope_;
    for (const Walls* walls : {&problem_.range, &problem_.rate}) {
      const HandFreedoms over = beyond(*walls, step_);
      for (Eigen::Index i = 0; i < kHandFreedoms; ++i) {
        if (over[i] != 0.0) diagonal[i] += walls->stiffness[i];
      }
      force -= walls->stiffness.cwiseProduct(over);
    }
    ArrowMatrix hessian = problem_.springs.stiffness;
    hessian.add_diagonal(diagonal);
    for (std::size_t i = 0; i < count_; ++i) {
      const ContactRow& row = problem_.rows[i];
      const double push = forces_[i] = force_at(row, gaps_[i]);
      const double stiffness = stiffnesses_[i] = stiffness_at(row, gaps_[i]);
      if (push == 0.0) continue;
      if (stiffness != 0.0) hessian.add(row, stiffness);
      force.head<6>() += push * row.wrist;
      if (row.digit) force.segment<4>(first_freedom(index_of(*row.digit))) += push * row.bend;
    }
    return hessian.solve(force);
  }

  /// Goes to the least cost along the Newton direction; gives how far along that is.
  double advance(const HandFreedoms& direction) {
    for (std::size_t i = 0; i < count_; ++i) changes_[i] = along(problem_.rows[i], direction);
    const double length = best_length(direction);
    step_ += length * direction;
    for (std::size_t i = 0; i < count_; ++i) gaps_[i] += length * changes_[i];
    return length;
  }

  [[nodiscard]] const HandFreedoms& step() const { return step_; }

 private:
  /// First and second derivative of the cost along the direction.
  struct LineSlope {
    double slope;
    double bend;
  };
  /// That of the springs, and of the rows that push alike all the way; the others are `bent_`.
  [[nodiscard]] LineSlope even_slope(const HandFreedoms& direction) {
    LineSlope even{spring_slope_.dot(direction),
                   direction.dot(problem_.springs.stiffness.times(direction))};
    bent_count_ = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const ContactRow& row = problem_.rows[i];
      const double last_m = gaps_[i] + kFarthest * changes_[i];
      // A pull has the same stiffness, none, on both sides of where it grows.
      if (row.kind == RowKind::draw_near || stiffness_at(row, last_m) != stiffnesses_[i]) {
        bent_[bent_count_++] = static_cast<std::uint16_t>(i);
        continue;
      }
      even.slope -= forces_[i] * changes_[i];
      even.bend += stiffnesses_[i] * changes_[i] * changes_[i];
    }
    return even;
  }

  [[nodiscard]] LineSlope slope_at(double length, const HandFreedoms& direction,
                                   const LineSlope& even) const {
    const HandFreedoms step = step_ + length * direction;
    LineSlope result{even.slope + length * even.bend, even.bend};
    for (const Walls* walls : {&problem_.range, &problem_.rate}) {
      const HandFreedoms over = beyond(*walls, step);
      for (Eigen::Index i = 0; i < kHandFreedoms; ++i) {
        if (over[i] == 0.0) continue;
        result.slope += walls->stiffness[i] * over[i] * direction[i];
        result.bend += walls->stiffness[i] * direction[i] * direction[i];
      }
    }
    for (std::size_t k = 0; k < bent_count_; ++k) {
      const std::size_t i = bent_[k];
      const double gap_m = gaps_[i] + length * changes_[i];
      const ContactRow& row = problem_.rows[i];
      result.slope -= force_at(row, gap_m) * changes_[i];
      result.bend += stiffness_at(row, gap_m) * changes_[i] * changes_[i];
    }
    return result;
  }

  /// Where the slope along the direction is zero: it grows, piecewise linearly.
  [[nodiscard]] double best_length(const HandFreedoms& direction) {
    const LineSlope even = even_slope(direction);
    double low = 0.0;
    double high = kFarthest;
    double length = 1.0;
    for (int i = 0; i < kMostSearches; ++i) {
      const LineSlope at = slope_at(length, direction, even);
      if (std::abs(at.slope) <= kNoSlope * at.bend) break;
      (at.slope < 0.0 ? low : high) = length;
      const double next = length - at.slope / at.bend;
      length = next > low && next < high ? next : 0.5 * (low + high);
    }
    return length;
  }

  const SettleProblem& problem_;
  std::array<double, kMostContactRows> gaps_;
  std::array<double, kMostContactRows> changes_;
  std::array<double, kMostContactRows> forces_;
  std::array<double, kMostContactRows> stiffnesses_;
  std::array<std::uint16_t, kMostContactRows> bent_;
  std::size_t bent_count_ = 0;
  std::size_t count_;
  HandFreedoms step_;
  HandFreedoms spring_slope_;  ///< at the step
};

}  // namespace

double gap_after(const ContactRow& row, const HandFreedoms& step) noexcept {
  return row.gap_m + along(row, step);
}

double force_at(const ContactRow& row, double gap_m) noexcept {
  switch (row.kind) {
    case RowKind::draw_near:
      return -row.stiffness * std::clamp(gap_m, 0.0, kPullGrowth_m);
    case RowKind::climb:
    case RowKind::hold_back:
      return -row.stiffness * std::min(gap_m, 0.0);
    case RowKind::keep_out:
      break;
  }
  return -kSurfaceStiffness * std::min(gap_m, 0.0) -
         kCushionStiffness * std::min(gap_m - row.cushion_m, 0.0) -
         row.stiffness * std::min(gap_m - row.brake_m, 0.0);
}

HandFreedoms least_cost_step(const SettleProblem& problem, const HandFreedoms& from) noexcept {
  Descent descent(problem, from);
  for (int i = 0; i < kMostSteps; ++i) {
    const HandFreedoms direction = descent.newton_direction();
    if (direction.cwiseAbs().maxCoeff() < kSmallestChange) break;
    if (descent.advance(direction) == 1.0) break;  // the quadratic holds all the way: that is it
  }
  return descent.step();
}

}  // namespace nade
