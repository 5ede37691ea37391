#include "nade/contact.h"

#include <gtest/gtest.h>

#include "support/sample_hand.h"

namespace nade {
namespace {

using test::rad;

const PlaneSurface kPlane;

/// The sample hand with its palm's skin `depth_m` below y = 0, turned about the palm's centre.
HandPose pressed_hand(double depth_m, const Quat& turn = Quat::Identity()) {
  const double skin = generic_skin_depths()[Part::palm];
  const Vec3 skin_offset = turn * Vec3(0.0, -skin, 0.0);
  return test::placed_hand(test::sample_hand(), Vec3(0.0, -depth_m, 0.0) - skin_offset, turn);
}

Contacts find(const HandPose& hand, const Object& object, const ContactOptions& options,
              ContactMemory& memory) {
  return find_contacts(hand, generic_skin_depths(), object, options, memory);
}

Contacts find_once(const HandPose& hand, const Object& object, const ContactOptions& options = {}) {
  ContactMemory memory;
  return find(hand, object, options, memory);
}

TEST(Contact, AHandAboveTouchesNothing) {
  const Contacts contacts = find_once(pressed_hand(-0.2), Object(kPlane));
  for (const auto& contact : contacts) EXPECT_FALSE(contact.has_value());
}

TEST(Contact, TheSkinIsTestedFirst) {
  const Object object(kPlane);
  EXPECT_FALSE(find_once(pressed_hand(-1e-6), object)[0].has_value());
  EXPECT_TRUE(find_once(pressed_hand(1e-6), object)[0].has_value());
  ContactOptions literal;
  literal.test_point = TestPoint::joint;
  EXPECT_FALSE(find_once(pressed_hand(0.010), object, literal)[0].has_value());
  EXPECT_TRUE(find_once(pressed_hand(0.025), object, literal)[0].has_value());
}

TEST(Contact, TheTargetIsTheSurfacePointPlusSkinDepth) {  // Eq. (1)
  const Contacts contacts = find_once(pressed_hand(0.03), Object(kPlane));
  const PartContact& palm = *contacts[0];
  EXPECT_NEAR(palm.depth_m, 0.03, 1e-12);
  EXPECT_NEAR(palm.surface_point.y(), 0.0, 1e-12);
  EXPECT_NEAR(palm.target.y(), generic_skin_depths()[Part::palm], 1e-12);
}

TEST(Contact, OnlyAHitFromInsideCounts) {
  // A hand under a table: the ray up meets the table's underside, from outside.
  struct Slab final : Surface {
    std::optional<RayHit> first_hit(const Ray& ray) const noexcept override {
      for (double height : {0.2, 0.3}) {
        const double t = (height - ray.origin.y()) / ray.direction.y();
        if (!(t > 0.0 && t < ray.max_distance)) continue;
        const Vec3 normal = height > 0.25 ? Vec3(Vec3::UnitY()) : Vec3(-Vec3::UnitY());
        return RayHit{t, ray.origin + t * ray.direction, normal, normal.dot(ray.direction) > 0.0};
      }
      return std::nullopt;
    }
    std::optional<SurfacePoint> closest_point(const Vec3& query, double,
                                              SurfaceHint&) const noexcept override {
      const bool below = query.y() < 0.25;
      SurfacePoint nearest;
      nearest.point = Vec3(query.x(), below ? 0.2 : 0.3, query.z());
      nearest.normal = below ? Vec3(-Vec3::UnitY()) : Vec3(Vec3::UnitY());
      nearest.signed_distance = (query - nearest.point).dot(nearest.normal);
      return nearest;
    }
  };
  const Slab slab;
  const HandPose hand = pressed_hand(0.0);
  EXPECT_FALSE(find_once(hand, Object(slab))[0].has_value());
  ContactOptions literal;
  literal.counted_hits = CountedHits::any;
  EXPECT_TRUE(find_once(hand, Object(slab), literal)[0].has_value());
}

TEST(Contact, TurningTheWristBelowDoesNotMoveTheHeldContact) {
  const SphereSurface sphere(0.15);
  const std::array<Object, 2> objects{Object(kPlane),
                                      Object(sphere, {{{0.0, -0.15, 0.0}, Quat::Identity()}, 1.0})};
  for (const Object& object : objects) {
    for (PalmRay palm_ray : {PalmRay::held, PalmRay::follows_hand}) {
      ContactOptions options;
      options.palm_ray = palm_ray;
      ContactMemory memory;
      const HandPose hand = pressed_hand(0.03);
      const Vec3 before = find(hand, object, options, memory)[0]->surface_point;
      const Quat turn(Eigen::AngleAxisd(rad(20.0), Vec3(1.0, 0.0, 1.0).normalized()));
      const HandPose turned = test::placed_hand(hand, hand[Joint::palm].position, turn);
      const double moved_m =
          (find(turned, object, options, memory)[0]->surface_point - before).norm();
      if (palm_ray == PalmRay::held) {
        EXPECT_LT(moved_m, 1e-9);
      } else {
        EXPECT_GT(moved_m, 0.003);
      }
    }
  }
}

TEST(Contact, TheHeldRayTurnsWithTheObjectAndEndsWithTheTouch) {
  ContactMemory memory;
  const Quat turn(Eigen::AngleAxisd(rad(30.0), Vec3::UnitZ()));
  (void)find(pressed_hand(0.03), Object(kPlane), {}, memory);
  const Contacts turned =
      find(pressed_hand(0.03), Object(kPlane, {{Vec3::Zero(), turn}, 1.0}), {}, memory);
  EXPECT_LT((turned[0]->ray_direction - turn * Vec3::UnitY()).norm(), 1e-12);
  (void)find(pressed_hand(-0.1), Object(kPlane), {}, memory);
  EXPECT_FALSE(memory.held_palm_ray.has_value());
}

TEST(Contact, APartPushedThroughAThinWallStaysOnItsSide) {
  const SphereSurface pea(0.012);
  const HandPose hand = pressed_hand(0.0);
  const Vec3 skin = hand[Joint::palm].position - Vec3(0.0, generic_skin_depths()[Part::palm], 0.0);
  for (EntrySide side : {EntrySide::remembered, EntrySide::forgotten}) {
    ContactOptions options;
    options.entry_side = side;
    ContactMemory memory;
    bool touches = false;
    // The pea rises through the palm's skin point by 60 mm: right through, and beyond.
    for (double rise_m = 0.0; rise_m < 0.060; rise_m += 0.002) {
      const Object object(pea, {{skin + Vec3(0.0, rise_m - 0.011, 0.0), Quat::Identity()}, 1.0});
      touches = find(hand, object, options, memory)[0].has_value();
    }
    EXPECT_EQ(touches, side == EntrySide::remembered);
  }
}

TEST(Contact, TheFingertipRayMayFollowTheFingertip) {
  HandAngles bent = test::relaxed_angles();
  bent[index_of(Digit::index)][0].flexion = rad(40.0);
  const HandPose hand =
      test::placed_hand(test::sample_hand(Handedness::right, bent), {0.0, -0.1, 0.0});
  ContactOptions options;
  const auto along_hand = find_once(hand, Object(kPlane), options)[index_of(Part::index)];
  options.finger_ray = FingerRay::fingertip_back;
  const auto along_tip = find_once(hand, Object(kPlane), options)[index_of(Part::index)];
  EXPECT_LT((along_hand->ray_direction - hand.back()).norm(), 1e-12);
  EXPECT_LT(along_tip->ray_direction.dot(hand.back()), std::cos(rad(40.0)));
}

TEST(Contact, TurnTowardOppositeVectorsIsHalfATurn) {
  const Quat turn = turn_toward(Vec3::UnitY(), -Vec3::UnitY(), 1.0);
  EXPECT_LT((turn * Vec3::UnitY() + Vec3::UnitY()).norm(), 1e-9);
  EXPECT_LT((turn_toward(Vec3::UnitX(), Vec3::UnitX(), 1.0) * Vec3::UnitZ() - Vec3::UnitZ()).norm(),
            1e-12);
}

TEST(Contact, TurnTowardFromNowhereIsNone) {
  EXPECT_EQ(turn_toward(Vec3::Zero(), Vec3::UnitY(), 1.0).coeffs(), Quat::Identity().coeffs());
}

}  // namespace
}  // namespace nade
