#include "nade/palm.h"

#include <gtest/gtest.h>

#include "support/sample_hand.h"

namespace nade {
namespace {

using test::rad;

PartContact contact_with(const Vec3& target, const Vec3& normal, double turn) {
  PartContact contact;
  contact.target = target;
  contact.normal = normal;
  contact.turn = turn;
  return contact;
}

TEST(Palm, WithoutContactTheHandIsBitEqual) {
  const HandPose hand = test::sample_hand();
  const SeatedPalm seated = seat_palm(hand, std::nullopt);
  for (std::size_t i = 0; i < kJointCount; ++i) {
    EXPECT_EQ(seated.hand.joints[i].position, hand.joints[i].position);
    EXPECT_EQ(seated.hand.joints[i].rotation.coeffs(), hand.joints[i].rotation.coeffs());
  }
}

TEST(Palm, TheBackMeetsTheNormalAndThePalmItsTarget) {
  const HandPose hand = test::placed_hand(test::sample_hand(), {0.1, 0.0, 0.2},
                                          Quat(Eigen::AngleAxisd(rad(25.0), Vec3::UnitX())));
  const Vec3 normal = Vec3(0.2, 1.0, -0.1).normalized();
  const SeatedPalm seated = seat_palm(hand, contact_with({0.1, 0.05, 0.2}, normal, 1.0));
  EXPECT_LT((seated.hand.back() - normal).norm(), 1e-12);
  EXPECT_LT((seated.hand[Joint::palm].position - Vec3(0.1, 0.05, 0.2)).norm(), 1e-12);
}

TEST(Palm, TheTurnIsTheShortestSoThatHeadingIsThePersonsOwn) {
  const HandPose hand = test::placed_hand(test::sample_hand(), Vec3::Zero(),
                                          Quat(Eigen::AngleAxisd(rad(25.0), Vec3::UnitX())));
  const SeatedPalm seated = seat_palm(hand, contact_with(Vec3::Zero(), Vec3::UnitY(), 1.0));
  EXPECT_NEAR(Eigen::AngleAxisd(seated.correction.turn).angle(), rad(25.0), 1e-12);
  const Vec3 heading = seated.hand[Joint::palm].rotation * -Vec3::UnitZ();
  EXPECT_LT((heading + Vec3::UnitZ()).norm(), 1e-12);
}

TEST(Palm, APartialTurnGoesPartOfTheWay) {
  const HandPose hand = test::placed_hand(test::sample_hand(), Vec3::Zero(),
                                          Quat(Eigen::AngleAxisd(rad(20.0), Vec3::UnitZ())));
  const SeatedPalm seated = seat_palm(hand, contact_with(Vec3::Zero(), Vec3::UnitY(), 0.25));
  EXPECT_NEAR(std::acos(seated.hand.back().y()), rad(15.0), 1e-9);
}

TEST(Palm, TheWholeHandMovesRigidly) {
  const HandPose hand = test::sample_hand();
  const SeatedPalm seated =
      seat_palm(hand, contact_with({0.0, 0.1, 0.0}, Vec3(1.0, 1.0, 0.0).normalized(), 1.0));
  for (std::size_t i = 1; i < kJointCount; ++i) {
    const double before = (hand.joints[i].position - hand.joints[0].position).norm();
    const double after = (seated.hand.joints[i].position - seated.hand.joints[0].position).norm();
    EXPECT_NEAR(after, before, 1e-12);
  }
}

}  // namespace
}  // namespace nade
