#include "proxy/digit_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hand/phalanx.h"
#include "hand/step.h"
#include "support/sample_hand.h"

// Fingers keep out of each other.

namespace nade {
namespace {

constexpr double kStep = 1e-6;

/// A hand whose drawn index and middle finger are bent aside, into each other.
struct Crossed {
  explicit Crossed(Handedness side)
      : flesh(generic_flesh(side)), model(measure_model(test::sample_hand(side), 1.0)) {
    HandFreedoms aside = HandFreedoms::Zero();
    aside[first_freedom(index_of(Digit::index))] = 0.01;
    aside[first_freedom(index_of(Digit::middle))] = -0.01;
    for (const double turn : {1.0, -1.0}) {  // one of both brings them together
      for (double far = 1.0; far < 30.0; far += 1.0) {
        correction = after_step({}, far * turn * aside, model.ranges);
        posed = pose_hand(model, correction);
        if (gap_m(posed) < -0.002) return;
      }
    }
  }

  static constexpr std::size_t kIndex = index_of(Joint::index_distal);
  static constexpr std::size_t kMiddle = index_of(Joint::middle_distal);

  [[nodiscard]] double gap_m(const PosedHand& hand) const {
    return nearest_of(hand.hand, kIndex, kMiddle).way.norm() - flesh.phalanx_radius_m[kIndex] -
           flesh.phalanx_radius_m[kMiddle];
  }

  [[nodiscard]] std::vector<ContactTerm> terms(const PosedHand& hand) const {
    std::vector<ContactTerm> all;
    all.reserve(200);
    keep_digits_apart(model, flesh, hand, 0.0, 1.0, all);
    return all;
  }

  const HandFlesh& flesh;
  HandModel model;
  Correction correction;
  PosedHand posed;
};

class DigitContactOf : public testing::TestWithParam<Handedness> {};
INSTANTIATE_TEST_SUITE_P(Sides, DigitContactOf,
                         testing::Values(Handedness::left, Handedness::right),
                         [](const auto& each) {
                           return each.param == Handedness::left ? "left" : "right";
                         });

TEST(Phalanges, AreNearestWhereNoOtherPointsAreNearer) {
  HandPose hand = test::sample_hand(Handedness::right);
  for (const auto& [one, other] : {std::pair{Joint::thumb_tip, Joint::index_tip},
                                   std::pair{Joint::thumb_distal, Joint::little_distal},
                                   std::pair{Joint::index_distal, Joint::middle_intermediate}}) {
    const std::size_t i = index_of(one);
    const std::size_t k = index_of(other);
    const auto along = [&](std::size_t end, double share) -> Vec3 {
      const Vec3& start = hand.joints[end - 1].position;
      return start + share * (hand.joints[end].position - start);
    };
    double nearest_m = std::numeric_limits<double>::infinity();
    for (int s = 0; s <= 200; ++s) {
      for (int t = 0; t <= 200; ++t) {
        nearest_m = std::min(nearest_m, (along(i, s / 200.0) - along(k, t / 200.0)).norm());
      }
    }
    const NearestPoints pair = nearest_of(hand, i, k);
    EXPECT_NEAR(pair.way.norm(), nearest_m, 1e-5);
    EXPECT_LE(pair.way.norm(), nearest_m + 1e-12);
    EXPECT_LT((along(i, pair.one_share) - along(k, pair.other_share) - pair.way).norm(), 1e-12);
  }
}

TEST(Phalanges, AreAsThickAsFingersAre) {
  for (const std::size_t i : kPhalanges) {
    EXPECT_GT(generic_flesh(Handedness::right).phalanx_radius_m[i], 0.005) << i;
    EXPECT_LT(generic_flesh(Handedness::right).phalanx_radius_m[i], 0.012) << i;
  }
}

TEST_P(DigitContactOf, EachOfTwoThatOverlapGoesHalfTheWay) {
  const Crossed crossed(GetParam());
  ASSERT_LT(crossed.gap_m(crossed.posed), -0.001);
  double apart_m = 0.0;
  const std::vector<ContactTerm> terms = crossed.terms(crossed.posed);
  ASSERT_FALSE(terms.empty());
  for (const ContactTerm& term : terms) {
    EXPECT_EQ(term.kind, ContactKind::digits);
    EXPECT_TRUE(term.row.wrist.isZero(0.0));
    EXPECT_GT(term.force_at(term.row.gap_m), 0.0);
    apart_m = std::min(apart_m, 2.0 * term.row.gap_m);
  }
  EXPECT_LE(apart_m, crossed.gap_m(crossed.posed) + 1e-9);
}

TEST_P(DigitContactOf, TermsSayHowTheGapChangesWithEachBend) {
  const Crossed crossed(GetParam());
  for (const Digit digit : {Digit::index, Digit::middle}) {
    const auto first = first_freedom(index_of(digit));
    for (Eigen::Index f = 0; f < 3; ++f) {
      HandFreedoms step = HandFreedoms::Zero();
      step[first + f] = kStep;
      const auto at = [&](double sign) {
        return crossed.gap_m(pose_hand(
            crossed.model, after_step(crossed.correction, sign * step, crossed.model.ranges)));
      };
      const double change = (at(1.0) - at(-1.0)) / (2.0 * kStep);
      bool found = false;
      for (const ContactTerm& term : crossed.terms(crossed.posed)) {
        if (term.row.digit != digit) continue;
        if (std::abs(2.0 * term.row.gap_m - crossed.gap_m(crossed.posed)) > 1e-9) continue;
        EXPECT_NEAR(term.row.bend[f], change, 1e-6);
        found = true;
      }
      EXPECT_TRUE(found);
    }
  }
}

TEST_P(DigitContactOf, NothingPushesWhatThePersonOverlaps) {
  const Crossed crossed(GetParam());
  const HandModel same = measure_model(crossed.posed.hand, 1.0);
  std::vector<ContactTerm> terms;
  terms.reserve(200);
  keep_digits_apart(same, crossed.flesh, pose_hand(same, {}), 0.0, 1.0, terms);
  for (const ContactTerm& term : terms) EXPECT_EQ(term.force_at(term.row.gap_m), 0.0);
}

}  // namespace
}  // namespace nade
