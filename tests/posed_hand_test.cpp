#include "hand/posed_hand.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <random>

#include "hand/step.h"
#include "nade/flesh.h"
#include "proxy/arrow_matrix.h"
#include "proxy/coupling.h"
#include "support/sample_hand.h"

// The derivatives that the solver is built on, against central differences, and its matrix against
// a dense one.

namespace nade {
namespace {

constexpr double kStep = 1e-5;
using Dense = Eigen::Matrix<double, kHandFreedoms, kHandFreedoms>;

/// A corrected hand in the middle of its range, and what steps from it give.
struct Fixture {
  explicit Fixture(Handedness side)
      : model(measure_model(test::placed_hand(test::sample_hand(side), Vec3(0.1, 0.2, -0.3),
                                              Quat(0.8, 0.3, -0.4, 0.3).normalized()),
                            1.05)) {
    HandFreedoms away = HandFreedoms::Constant(0.15);
    away.head<3>() = Vec3(0.01, -0.02, 0.015);
    correction = after_step({}, away, model.ranges);
  }

  [[nodiscard]] PosedHand at(const HandFreedoms& step) const {
    return pose_hand(model, after_step(correction, step, model.ranges));
  }

  HandModel model;
  Correction correction;
};

HandFreedoms one(Eigen::Index freedom, double value) {
  HandFreedoms step = HandFreedoms::Zero();
  step[freedom] = value;
  return step;
}

/// A point on the palmar side of each bone, carried by it alone.
std::array<FleshPoint, kJointCount> points_on_bones() {
  std::array<FleshPoint, kJointCount> points;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    points[i].attach(0, i, 1.0, Vec3(0.004, -0.01, -0.012));
  }
  return points;
}

HandFreedoms dense_row(const ContactRow& row) {
  HandFreedoms all = HandFreedoms::Zero();
  all.head<6>() = row.wrist;
  if (row.digit) all.segment<4>(first_freedom(index_of(*row.digit))) = row.bend;
  return all;
}

Dense dense(const ArrowMatrix& arrow) {
  Dense all = Dense::Zero();
  all.topLeftCorner<6, 6>() = arrow.wrist;
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const Eigen::Index first = first_freedom(d);
    all.block<6, 4>(0, first) = arrow.coupling[d];
    all.block<4, 6>(first, 0) = arrow.coupling[d].transpose();
    all.block<4, 4>(first, first) = arrow.digit[d];
  }
  return all;
}

class PosedHandOf : public testing::TestWithParam<Handedness> {};
INSTANTIATE_TEST_SUITE_P(Sides, PosedHandOf, testing::Values(Handedness::left, Handedness::right),
                         [](const auto& each) {
                           return each.param == Handedness::left ? "left" : "right";
                         });

TEST_P(PosedHandOf, RowsAreTheDerivativesOfPositions) {
  const Fixture hand(GetParam());
  const PosedHand posed = hand.at(HandFreedoms::Zero());
  const Vec3 direction = Vec3(-0.4, 0.7, 0.5).normalized();
  for (const FleshPoint& point : points_on_bones()) {
    const HandFreedoms row = dense_row(motion_along(posed, point, direction));
    for (Eigen::Index f = 0; f < kHandFreedoms; ++f) {
      const Vec3 ahead = position_of(point, hand.at(one(f, kStep)).hand, hand.model.scale);
      const Vec3 behind = position_of(point, hand.at(one(f, -kStep)).hand, hand.model.scale);
      EXPECT_NEAR(row[f], direction.dot(ahead - behind) / (2.0 * kStep), 1e-7)
          << "joint " << int(point.joints[0]) << ", freedom " << f;
    }
  }
}

TEST_P(PosedHandOf, JointMotionsAreTheDerivativesOfJoints) {
  const Fixture hand(GetParam());
  const PosedHand posed = hand.at(HandFreedoms::Zero());
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const JointMotion motion = motion_of(posed, i);
    for (std::size_t b = 0; b < motion.bends; ++b) {
      const Eigen::Index f = first_freedom(motion.digit) + static_cast<Eigen::Index>(b);
      const Vec3 way = hand.at(one(f, kStep)).hand.joints[i].position -
                       hand.at(one(f, -kStep)).hand.joints[i].position;
      EXPECT_LT((way / (2.0 * kStep) - motion.with_bend[b]).norm(), 1e-8)
          << "joint " << i << ", bend " << b;
    }
  }
}

/// Half of stiffness times the squares of the joints' ways to their places.
TEST_P(PosedHandOf, JointSpringsAreTheJointsSquares) {
  const Fixture hand(GetParam());
  const PosedHand posed = hand.at(HandFreedoms::Zero());
  JointVectors places;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    places[i] = posed.hand.joints[i].position + 0.001 * Vec3(1.0, double(i % 3) - 1.0, -0.5);
  }
  Springs springs;
  add_joint_springs(places, 300.0, posed, springs);

  Dense stiffness = Dense::Zero();
  HandFreedoms force = HandFreedoms::Zero();
  for (std::size_t i = 0; i < kJointCount; ++i) {
    for (const Vec3& axis : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ())}) {
      const HandFreedoms row = dense_row(motion_along(posed, joint_point(i), axis));
      stiffness += 300.0 * row * row.transpose();
      force += 300.0 * axis.dot(places[i] - posed.hand.joints[i].position) * row;
    }
  }
  EXPECT_LT((dense(springs.stiffness) - stiffness).norm(), 1e-6 * stiffness.norm());
  EXPECT_LT((springs.force - force).norm(), 1e-6 * force.norm());
}

TEST(ArrowMatrix, SolvesAsADenseMatrixDoes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  ArrowMatrix arrow;
  arrow.add_diagonal(HandFreedoms::Constant(0.5));
  Dense reference = 0.5 * Dense::Identity();
  for (std::size_t i = 0; i < 60; ++i) {
    ContactRow row;
    for (double& value : row.wrist) value = any(random);
    for (double& value : row.bend) value = any(random);
    if (i % 6 < kDigitCount) row.digit = digit_at(i % 6);
    const double stiffness = 1.0 + any(random);
    arrow.add(row, stiffness);
    const HandFreedoms all = dense_row(row);
    reference += stiffness * all * all.transpose();
  }
  HandFreedoms right;
  for (double& value : right) value = any(random);
  EXPECT_LT((dense(arrow) - reference).norm(), 1e-9 * reference.norm());
  EXPECT_LT((arrow.times(right) - reference * right).norm(), 1e-9 * reference.norm());
  EXPECT_LT((arrow.solve(right) - reference.ldlt().solve(right)).norm(), 1e-9);
}

}  // namespace
}  // namespace nade
