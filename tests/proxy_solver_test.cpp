#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

#include "proxy/solver.h"

// The solver against a dense one, and each term of the energy: its sign, and that its force has no
// jump.

namespace nade {
namespace {

using Dense = Eigen::Matrix<double, kHandFreedoms, kHandFreedoms>;

class Any {
 public:
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  HandFreedoms freedoms() {
    HandFreedoms all;
    for (double& value : all) value = (*this)(-1.0, 1.0);
    return all;
  }
  ContactTerm term(ContactKind kind) {
    ContactTerm term;
    term.kind = kind;
    for (double& value : term.row.wrist) value = (*this)(-1.0, 1.0);
    for (double& value : term.row.bend) value = (*this)(-1.0, 1.0);
    const auto digit = static_cast<std::size_t>((*this)(0.0, 6.0));
    if (digit < kDigitCount) term.row.digit = digit_at(digit);
    term.row.gap_m = (*this)(-0.3, 0.3);
    term.stiffness = (*this)(1.0, 100.0);
    term.edge_m = kind == ContactKind::adhesion ? (*this)(0.05, 0.2) : (*this)(-0.2, 0.2);
    return term;
  }

 private:
  std::mt19937 random_{7};
};

constexpr std::array kKinds{ContactKind::flesh, ContactKind::adhesion, ContactKind::landing,
                            ContactKind::speed, ContactKind::digits};

/// Half of step * stiffness * step less force * step, the terms, and what is beyond the range.
HandFreedoms slope_of(const Springs& springs, const StepRange& range,
                      const std::vector<ContactTerm>& terms, const HandFreedoms& step) {
  HandFreedoms slope = springs.stiffness.times(step) - springs.force;
  for (const ContactTerm& term : terms) {
    const double force = term.force_at(gap_after(term.row, step));
    slope.head<6>() -= force * term.row.wrist;
    if (!term.row.digit) continue;
    slope.segment<4>(first_freedom(index_of(*term.row.digit))) -= force * term.row.bend;
  }
  const HandFreedoms over = (step - range.high).cwiseMax(0.0) + (step - range.low).cwiseMin(0.0);
  return slope + 1e5 * over;
}

TEST(ProxySolver, NothingPushesAtTheStepOfLeastCost) {
  Any any;
  SolverRoom room;
  for (int trial = 0; trial < 200; ++trial) {
    Springs springs;
    springs.add(HandFreedoms::Constant(any(0.5, 5.0)), any.freedoms());
    StepRange range;
    range.low.setConstant(-10.0);
    range.high.setConstant(10.0);
    std::vector<ContactTerm> terms;
    for (std::size_t i = 0; i < 12; ++i) terms.push_back(any.term(kKinds[i % kKinds.size()]));
    const HandFreedoms step = least_cost_step(springs, range, terms, HandFreedoms::Zero(), room);
    const double scale = slope_of(springs, range, terms, HandFreedoms::Zero()).norm();
    EXPECT_LT(slope_of(springs, range, terms, step).norm(), 1e-3 * scale) << trial;
  }
}

TEST(ProxySolver, FindsWhatADenseSolverFinds) {
  Any any;
  SolverRoom room;
  Springs springs;
  springs.add(HandFreedoms::Constant(1e5), 0.01 * any.freedoms());
  std::vector<ContactTerm> terms;
  Dense stiffness = 1e5 * Dense::Identity();
  HandFreedoms force = springs.force;
  for (int i = 0; i < 30; ++i) {  // all push, before the step and after
    ContactTerm term = any.term(ContactKind::flesh);
    term.row.gap_m = 0.0;
    term.edge_m = 10.0;
    HandFreedoms row = HandFreedoms::Zero();
    row.head<6>() = term.row.wrist;
    if (term.row.digit) row.segment<4>(first_freedom(index_of(*term.row.digit))) = term.row.bend;
    stiffness += term.stiffness * row * row.transpose();
    force += term.stiffness * term.edge_m * row;
    terms.push_back(term);
  }
  StepRange wide;
  wide.low.setConstant(-1e6);
  wide.high.setConstant(1e6);
  const HandFreedoms step = least_cost_step(springs, wide, terms, HandFreedoms::Zero(), room);
  const HandFreedoms dense = stiffness.ldlt().solve(force);
  EXPECT_LT((step - dense).norm(), 1e-6 * dense.norm());
}

TEST(ProxySolver, AStepStaysInItsRange) {
  Any any;
  SolverRoom room;
  Springs springs;
  springs.add(HandFreedoms::Constant(3.0), HandFreedoms::Constant(5.0));
  StepRange range;
  range.low.setConstant(-0.2);
  range.high.setConstant(0.3);
  const HandFreedoms step = least_cost_step(springs, range, {}, HandFreedoms::Zero(), room);
  EXPECT_LT((step - HandFreedoms::Constant(0.3)).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(ContactTerm, PushesBelowItsEdgeAndAdhesionPullsAboveTheSurface) {
  Any any;
  for (const ContactKind kind : kKinds) {
    for (int trial = 0; trial < 50; ++trial) {
      const ContactTerm term = any.term(kind);
      const double gap_m = any(-0.5, 0.5);
      const double force = term.force_at(gap_m);
      if (kind == ContactKind::adhesion) {
        EXPECT_EQ(force<0.0, gap_m> 0.0);
        EXPECT_GE(force, -term.stiffness * term.edge_m);
      } else {
        EXPECT_EQ(force > 0.0, gap_m < term.edge_m);
      }
    }
  }
}

TEST(ContactTerm, ForcesHaveNoJumpAndFallAsTheirStiffnessSays) {
  Any any;
  constexpr double kStep = 1e-6;
  for (const ContactKind kind : kKinds) {
    for (int trial = 0; trial < 200; ++trial) {
      const ContactTerm term = any.term(kind);
      const double gap_m = any(-0.5, 0.5);
      const double fall =
          (term.force_at(gap_m - kStep) - term.force_at(gap_m + kStep)) / (2.0 * kStep);
      EXPECT_LE(fall, term.stiffness * 1.000001);
      EXPECT_GE(fall, -1e-6);
      if (term.bends_between(gap_m - kStep, gap_m + kStep)) continue;
      EXPECT_NEAR(fall, term.stiffness_at(gap_m), 1e-4 * term.stiffness);
    }
  }
}

}  // namespace
}  // namespace nade
