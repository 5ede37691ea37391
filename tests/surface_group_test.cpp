#include "nade/surface_group.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "nade/corrector.h"
#include "nade/mesh.h"
#include "support/allocation_counter.h"
#include "support/hand_checks.h"
#include "support/meshes.h"
#include "support/pressed_hand.h"
#include "support/random.h"
#include "support/surface_battery.h"

namespace nade {
namespace {

using test::kFrame_ns;

Placement at(const Vec3& position, double scale = 1.0) {
  return {{position, Quat(Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, 3.0).normalized()))}, scale};
}

TEST(SurfaceGroup, Battery) {
  const SphereSurface ball(0.05);
  const auto box = MeshSurface::build(test::box_mesh({0.04F, 0.03F, 0.05F}), "box").value();
  const SurfaceGroup group({Object(ball, at({-0.1, 0.0, 0.0})), Object(*box, at({0.0, 0.1, 0.0})),
                            Object(*box, at({0.12, 0.0, 0.02}, 1.3))});
  test::run_surface_battery(group, {Vec3::Constant(-0.25), Vec3::Constant(0.25), 1e-6});
  test::expect_no_answer_to_nonsense(group);
}

TEST(SurfaceGroup, AnswersAsTheMemberThatIsNearest) {
  const SphereSurface ball(0.05);
  const auto box = MeshSurface::build(test::box_mesh({0.04F, 0.03F, 0.05F}), "box").value();
  const std::vector<Object> members{Object(ball, at({-0.02, 0.0, 0.0})),
                                    Object(*box, at({0.0, 0.0, 0.0}))};
  const SurfaceGroup group(members);
  test::Random random;
  SurfaceHint hint{0x01234567};  // any is right
  for (int i = 0; i < 1000; ++i) {
    const Vec3 query = random.point(Vec3::Constant(-0.1), Vec3::Constant(0.1));
    double deepest = test::kAnywhere;
    for (const Object& member : members) {
      SurfaceHint none;
      const auto found = member.closest_point(query, test::kAnywhere, none);
      deepest = std::min(deepest, found->signed_distance);
    }
    EXPECT_NEAR(group.closest_point(query, test::kAnywhere, hint)->signed_distance, deepest, 1e-12);
  }
}

TEST(SurfaceGroup, OfNoneIsNothing) {
  const SurfaceGroup group({});
  SurfaceHint hint;
  EXPECT_FALSE(group.closest_point(Vec3::Zero(), test::kAnywhere, hint));
  EXPECT_FALSE(group.first_hit({}));
}

TEST(SurfaceGroup, HasAnotherShapeWhenAMemberMovesOrDeforms) {
  const auto top = test::table();
  const SphereSurface ball(0.05);
  SurfaceGroup group({Object(*top), Object(ball)});
  const auto before = group.shape();
  EXPECT_EQ(group.shape(), before);
  group.place(1, test::upright({0.0, 0.05, 0.0}));
  const auto moved = group.shape();
  EXPECT_NE(moved, before);
  group.place(1, test::upright({0.0, 0.05, 0.0}));
  EXPECT_EQ(group.shape(), moved);
  top->refit(test::box_mesh({0.2F, 0.02F, 0.15F}).vertices);
  EXPECT_NE(group.shape(), moved);
}

/// As a program that gathers what is near builds it in each frame.
TEST(SurfaceGroup, HasAnotherShapeThanTheOneThatWasInItsPlace) {
  const auto top = test::table();
  SurfaceGroup group({Object(*top)});
  const auto before = group.shape();
  group = SurfaceGroup({Object(*top, test::upright({0.0, 0.02, 0.0}))});
  EXPECT_NE(group.shape(), before);
}

/// Two tables that meet under the hand are one.
TEST(SurfaceGroup, AHandSlidesFromOneObjectToTheNext) {
  const auto half = test::table();
  const auto whole = test::block({0.4F, 0.02F, 0.15F});
  const SurfaceGroup halves({Object(*half, test::upright({-0.2, 0.0, 0.0})),
                             Object(*half, test::upright({0.2, 0.0, 0.0}))});
  HandCorrector on_two(test::settling());
  HandCorrector on_one(test::settling());
  for (int i = 0; i < 270; ++i) {
    const double down = std::min(1.0, i / 60.0);
    const double along = std::clamp((i - 90) / 90.0, 0.0, 1.0);
    const HandPose tracked =
        test::pressed_hand(-0.08 + 0.095 * down, 0.0, {-0.15 + 0.3 * along, 0.0, 0.0});
    const HandPose one = on_one.update(tracked, Object(*whole), i * kFrame_ns).pose;
    const HandPose two = on_two.update(tracked, Object(halves), i * kFrame_ns).pose;
    ASSERT_LT(largest_motion(one, two), 5e-4) << "frame " << i;
  }
}

/// While another moved, far off, it was taken for one that sank: the hand fell by 12 mm.
TEST(SurfaceGroup, AHandDoesNotFallWithAMemberThatIsTakenAway) {
  const auto base = test::table();
  const SphereSurface ball(0.06);
  const SphereSurface fan(0.05);
  SurfaceGroup group({Object(*base, test::upright({0.0, -0.03, 0.0})),
                      Object(ball, test::upright({0.0, -0.06, -0.02})),
                      Object(fan, test::upright({1.5, 0.0, 0.0}))});
  HandCorrector corrector(test::settling());
  HandPose drawn;
  for (int i = 0; i < 200; ++i) {
    group.place(2, test::upright({1.5, 0.1 * std::sin(i * test::kFrame_s), 0.0}));
    if (i == 150) group.place(1, test::upright({0.0, -5.0, 0.0}));
    const HandPose tracked = test::on_the_way_down(i, 90, 0.03);
    const HandPose now = corrector.update(tracked, Object(group), i * kFrame_ns).pose;
    if (i > 140) {
      EXPECT_LT(largest_motion(drawn, now), 0.003) << "frame " << i;
    }
    drawn = now;
  }
}

TEST(SurfaceGroup, AHandAtRestRidesOnAMemberThatRisesAndSinks) {
  const auto top = test::table();
  const PlaneSurface floor;
  SurfaceGroup group({Object(floor, test::upright({0.0, -0.5, 0.0})), Object(*top)});
  HandCorrector corrector(test::settling());
  const HandPose tracked = test::pressed_hand(0.015);
  HandPose drawn;
  for (int i = 0; i < 270; ++i) {
    const double swing =
        i < 90 ? 0.0 : std::sin(2.0 * std::numbers::pi * test::kFrame_s * (i - 90));
    const auto allocations = test::allocations_of([&] {
      group.place(1, test::upright({0.0, 0.02 * swing, 0.0}));
      drawn = corrector
                  .update(i < 60 ? test::on_the_way_down(i, 60, 0.015) : tracked, Object(group),
                          i * kFrame_ns)
                  .pose;
    });
    EXPECT_EQ(allocations, 0U);
    if (i < 60) continue;
    const double lowest_m = test::lowest_skin(drawn, Object(group), 0.05);
    EXPECT_GT(test::least_room(drawn, Object(group), 0.05), -0.001) << "frame " << i;
    EXPECT_LT(lowest_m, 0.001) << "frame " << i;
  }
}

}  // namespace
}  // namespace nade
