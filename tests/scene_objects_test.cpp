#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "nade/corrector.h"
#include "nade/mesh.h"
#include "nade/scene.h"
#include "nade/solids.h"
#include "support/allocation_counter.h"
#include "support/hand_checks.h"
#include "support/meshes.h"
#include "support/pressed_hand.h"
#include "support/random.h"

namespace nade {
namespace {

using test::kFrame_ns;

constexpr std::array kMethods{Method::paper, Method::nade};

CorrectorOptions by(Method method) {
  CorrectorOptions options;
  options.method = method;
  return options;
}

Placement turned(const Vec3& position, double turn_rad) {
  return {{position, Quat(Eigen::AngleAxisd(turn_rad, Vec3::UnitY()))}, 1.0};
}

/// Comes down to `depth_m` in a second, then goes to and fro by 5 cm.
HandPose stroking(int frame, double depth_m, const Vec3& at = Vec3::Zero()) {
  const double time_s = frame * test::kFrame_s;
  const double down = std::min(1.0, time_s);
  const double along_m = 0.05 * std::sin(3.0 * std::max(0.0, time_s - 1.0));
  return test::pressed_hand(-0.08 + down * (0.08 + depth_m), 0.0, at + Vec3(0.0, 0.0, along_m));
}

/// The largest step of a drawn joint beyond three times the tracked hand's.
class PopMeter {
 public:
  void add(const HandPose& tracked, const HandPose& drawn) {
    if (frames_++ > 0) {
      const double allowed_m = 3.0 * largest_motion(tracked_, tracked);
      largest_m_ = std::max(largest_m_, largest_motion(drawn_, drawn) - allowed_m);
    }
    tracked_ = tracked;
    drawn_ = drawn;
  }
  [[nodiscard]] double largest_m() const { return largest_m_; }

 private:
  int frames_ = 0;
  double largest_m_ = 0.0;
  HandPose tracked_;
  HandPose drawn_;
};

TEST(SceneObjects, AreKnownByTheirIds) {
  const SphereSurface ball(0.05);
  Scene scene;
  EXPECT_TRUE(scene.add(7, ball));
  EXPECT_TRUE(scene.add(8, ball, test::upright({0.0, 1.0, 0.0})));
  EXPECT_FALSE(scene.add(7, ball, test::upright({0.0, 2.0, 0.0})));
  EXPECT_TRUE(scene.add(9, ball, test::upright({0.0, 3.0, 0.0})));
  EXPECT_EQ(scene.size(), 3U);
  EXPECT_EQ(scene.find(7)->placement(), Placement{});
  EXPECT_TRUE(scene.remove(7));
  EXPECT_FALSE(scene.remove(7));
  EXPECT_FALSE(scene.place(7, {}));
  EXPECT_FALSE(scene.set_feel(7, {}));
  EXPECT_FALSE(scene.deformed(7));
  EXPECT_EQ(scene.find(7), nullptr);
  EXPECT_EQ(scene.find(9)->placement(), test::upright({0.0, 3.0, 0.0}));
  EXPECT_TRUE(scene.place(9, test::upright({0.0, 4.0, 0.0})));
  EXPECT_EQ(scene.find(9)->placement(), test::upright({0.0, 4.0, 0.0}));
  EXPECT_EQ(scene.find(8)->placement(), test::upright({0.0, 1.0, 0.0}));
  EXPECT_EQ(scene.size(), 2U);
}

/// Also far off, and where it moves, grows and turns.
TEST(SceneObjects, OneAloneIsAsByItself) {
  const SphereSurface ball(0.15);
  const PlaneSurface plane;
  const auto top = test::table();
  const std::array<const Surface*, 3> surfaces{&ball, &plane, top.get()};
  for (const Method method : kMethods) {
    for (std::size_t which = 0; which < surfaces.size(); ++which) {
      SCOPED_TRACE(std::string(name_of(method)) + " " + std::to_string(which));
      Scene scene;
      scene.add(5, *surfaces[which], test::upright({0.0, -2.0, 0.0}));
      HandCorrector in_scene(by(method));
      HandCorrector alone(by(method));
      int corrected = 0;
      for (int i = 0; i < 270; ++i) {
        const double swing = std::sin(i * test::kFrame_s);
        Placement placement = turned({0.02 * swing, which == 0 ? -0.15 : 0.0, 0.0}, 0.3 * swing);
        placement.scale = 1.0 + 0.02 * swing;
        if (i < 30) placement.pose.position.y() -= 2.0;
        scene.place(5, placement);
        const HandPose tracked = stroking(i, 0.02);
        const CorrectedHand& one = in_scene.update(tracked, scene, i * kFrame_ns);
        const CorrectedHand& other =
            alone.update(tracked, Object(*surfaces[which], placement, 5), i * kFrame_ns);
        ASSERT_TRUE(test::same_bits(one.pose, other.pose)) << "frame " << i;
        ASSERT_EQ(one.status, other.status);
        ASSERT_EQ(one.skin_contact_count, other.skin_contact_count);
        for (std::size_t k = 0; k < one.skin_contact_count; ++k) {
          EXPECT_EQ(one.skin_contacts[k].object, 5U);
          EXPECT_EQ(one.skin_contacts[k].point, other.skin_contacts[k].point);
          EXPECT_LT(
              (one.skin_contacts[k].velocity_mps - other.skin_contacts[k].velocity_mps).norm(),
              1e-9);
        }
        if (one.status == HandStatus::corrected) ++corrected;
      }
      EXPECT_GT(corrected, 150);
    }
  }
}

/// Of 1,000, half of which move.
TEST(SceneObjects, ThoseOutOfReachChangeNothing) {
  const auto top = test::table();
  const SphereSurface ball(0.1);
  const BoxSurface box({0.3, 0.1, 0.2});
  for (const Method method : kMethods) {
    SCOPED_TRACE(name_of(method));
    test::Random random;
    Scene few;
    Scene many;
    few.add(1, *top);
    many.add(1, *top);
    std::vector<Placement> placements;
    for (ObjectId id = 2; id < 1002; ++id) {
      const Vec3 away = (1.0 + random.uniform(0.0, 9.0)) * random.direction();
      placements.push_back({{away, random.rotation()}, 1.0});
      const Surface& surface = id % 2 == 0 ? static_cast<const Surface&>(ball) : box;
      many.add(id, surface, placements.back());
    }
    HandCorrector one(by(method));
    HandCorrector other(by(method));
    for (int i = 0; i < 200; ++i) {
      for (ObjectId id = 2; id < 502; ++id) {
        Placement& placement = placements[id - 2];
        placement.pose.position += 1e-3 * placement.pose.position.normalized();
        many.place(id, placement);
      }
      const HandPose tracked = stroking(i, 0.02);
      ASSERT_TRUE(test::same_bits(one.update(tracked, few, i * kFrame_ns).pose,
                                  other.update(tracked, many, i * kFrame_ns).pose))
          << "frame " << i;
    }
  }
}

/// What is known of the table stays: it is the same hand, bit for bit. Below, the table is known
/// anew in each frame.
TEST(SceneObjects, OneThatRollsBesideTheHandDisturbsNothing) {
  const auto top = test::table();
  const SphereSurface ball(0.04);
  const BoxSurface door({0.4, 1.0, 0.02});
  for (const bool is_door : {false, true}) {
    SCOPED_TRACE(is_door ? "door" : "ball");
    const Surface& beside = is_door ? static_cast<const Surface&>(door) : ball;
    Scene still;
    Scene rolling;
    for (Scene* const scene : {&still, &rolling}) {
      scene->add(1, *top);
      scene->add(2, beside, test::upright({0.0, 0.04, 0.35}));
    }
    HandCorrector one(test::settling());
    HandCorrector other(test::settling());
    for (int i = 0; i < 270; ++i) {
      const double swing = std::sin(4.0 * i * test::kFrame_s);
      rolling.place(2, turned({0.1 * swing, 0.04, 0.35}, is_door ? 0.02 * swing : 5.0 * swing));
      const HandPose tracked = stroking(i, 0.02);
      ASSERT_TRUE(test::same_bits(one.update(tracked, still, i * kFrame_ns).pose,
                                  other.update(tracked, rolling, i * kFrame_ns).pose))
          << "frame " << i;
    }
  }
}

/// A ball that rolls along under the fingertips' front, and goes.
TEST(SceneObjects, OneThatStrikesTheFingersDoesNotMoveThePalmOffTheTable) {
  const auto top = test::block({0.4F, 0.02F, 0.4F});
  const SphereSurface ball(0.03);
  Scene scene;
  scene.add(1, *top);
  scene.add(2, ball, test::upright({0.0, 0.03, -0.4}));
  const Object on_table(*top);
  HandCorrector corrector(test::settling());
  PopMeter pops;
  bool touched = false;
  for (int i = 0; i < 270; ++i) {
    const double forth = std::clamp((i - 100) / 80.0, 0.0, 2.0);
    const double z_m = -0.4 + 0.29 * (forth < 1.0 ? forth : 2.0 - forth);
    scene.place(2, test::upright({0.0, 0.03, z_m}));
    const HandPose tracked = test::on_the_way_down(i, 60, 0.01);
    const CorrectedHand& hand = corrector.update(tracked, scene, i * kFrame_ns);
    for (std::size_t k = 0; k < hand.skin_contact_count; ++k) {
      touched = touched || hand.skin_contacts[k].object == 2;
    }
    if (i < 70) continue;
    pops.add(tracked, hand.pose);
    EXPECT_GT(test::least_room(hand.pose, on_table, 0.05), -0.002) << "frame " << i;
    EXPECT_LT(test::lowest_skin(hand.pose, on_table, 0.05), 0.002) << "frame " << i;
  }
  EXPECT_TRUE(touched);
  EXPECT_LT(pops.largest_m(), 0.005);
}

/// Two tables that meet under the hand are one, also where they stand on a cart.
TEST(SceneObjects, AHandSlidesFromOneToTheNext) {
  const auto half = test::table();
  const auto whole = test::block({0.4F, 0.02F, 0.15F});
  for (const Method method : kMethods) {
    for (const double speed_mps : {0.0, 1.0}) {
      SCOPED_TRACE(std::string(name_of(method)) + " " + std::to_string(speed_mps));
      Scene halves;
      halves.add(1, *half);
      halves.add(2, *half);
      HandCorrector on_two(by(method));
      HandCorrector on_one(by(method));
      for (int i = 0; i < 270; ++i) {
        const double down = std::min(1.0, i / 60.0);
        const double along = std::clamp((i - 90) / 90.0, 0.0, 1.0);
        const Vec3 cart(0.0, 0.0, speed_mps * i * test::kFrame_s);
        halves.place(1, test::upright(cart + Vec3(-0.2, 0.0, 0.0)));
        halves.place(2, test::upright(cart + Vec3(0.2, 0.0, 0.0)));
        const HandPose tracked = test::pressed_hand(-0.08 + 0.095 * down, 0.0,
                                                    cart + Vec3(-0.15 + 0.3 * along, 0.0, 0.0));
        const HandPose one =
            on_one.update(tracked, Object(*whole, test::upright(cart)), i * kFrame_ns).pose;
        const HandPose two = on_two.update(tracked, halves, i * kFrame_ns).pose;
        ASSERT_LT(largest_motion(one, two), 5e-4) << "frame " << i;
      }
    }
  }
}

/// Lies on the table, and goes on over a ball that lies on it.
TEST(SceneObjects, AHandSlidesFromTheTableOntoABall) {
  const auto top = test::block({0.4F, 0.02F, 0.4F});
  const SphereSurface ball(0.06);
  for (const Method method : kMethods) {
    SCOPED_TRACE(name_of(method));
    Scene scene;
    scene.add(1, *top);
    scene.add(2, ball, test::upright({0.2, -0.02, 0.0}));
    HandCorrector corrector(by(method));
    PopMeter pops;
    bool touched_ball = false;
    for (int i = 0; i < 360; ++i) {
      const double along = std::clamp((i - 90) / 200.0, 0.0, 1.0);
      const HandPose tracked = test::pressed_hand(std::min(0.015, -0.08 + 0.095 * i / 60.0), 0.0,
                                                  {-0.1 + 0.3 * along, 0.02 * along, 0.0});
      const CorrectedHand& hand = corrector.update(tracked, scene, i * kFrame_ns);
      if (i > 70) pops.add(tracked, hand.pose);
      for (std::size_t k = 0; k < hand.skin_contact_count; ++k) {
        touched_ball = touched_ball || hand.skin_contacts[k].object == 2;
      }
    }
    EXPECT_TRUE(touched_ball);
    EXPECT_LT(pops.largest_m(), method == Method::nade ? 0.003 : 0.02);
  }
}

/// The floor and a wall beside it stand. As on a cart that is the only thing in the world.
TEST(SceneObjects, AHandRidesOnACartWhileOthersStand) {
  const auto cart = test::table();
  const PlaneSurface floor;
  const BoxSurface wall({2.0, 1.0, 0.05});
  Scene scene;
  scene.add(1, *cart);
  scene.add(2, floor, test::upright({0.0, -0.25, 0.0}));
  scene.add(3, wall, test::upright({0.0, 0.0, -0.4}));
  HandCorrector among(test::settling());
  HandCorrector alone(test::settling());
  for (int i = 0; i < 270; ++i) {
    const double time_s = std::max(0.0, i * test::kFrame_s - 1.0);
    const Placement place = turned({0.4 * time_s * time_s, 0.0, 0.0}, 0.2 * time_s);
    scene.place(1, place);
    const HandPose tracked = moved(test::on_the_way_down(i, 80, 0.02), place.pose);
    const CorrectedHand& hand = among.update(tracked, scene, i * kFrame_ns);
    const HandPose expected = alone.update(tracked, Object(*cart, place), i * kFrame_ns).pose;
    ASSERT_LT(largest_motion(hand.pose, expected), 5e-4) << "frame " << i;
    if (i < 120) continue;
    ASSERT_GT(hand.skin_contact_count, 0U);
    for (std::size_t k = 0; k < hand.skin_contact_count; ++k) {
      EXPECT_EQ(hand.skin_contacts[k].object, 1U);
      EXPECT_LT(hand.skin_contacts[k].velocity_mps.norm(), 0.02) << "frame " << i;
    }
  }
}

TEST(SceneObjects, AHandOnATableRidesOnItWhileAnotherMoves) {
  const auto top = test::table();
  const SphereSurface fan(0.05);
  Scene scene;
  scene.add(1, *top);
  scene.add(2, fan, test::upright({0.0, 0.05, 0.3}));
  HandCorrector corrector(test::settling());
  for (int i = 0; i < 270; ++i) {
    const double swing =
        i < 90 ? 0.0 : std::sin(2.0 * std::numbers::pi * test::kFrame_s * (i - 90));
    scene.place(1, test::upright({0.0, 0.02 * swing, 0.0}));
    scene.place(2, test::upright({0.1 * swing, 0.05, 0.3}));
    const HandPose drawn =
        corrector.update(test::on_the_way_down(i, 60, 0.015), scene, i * kFrame_ns).pose;
    if (i < 70) continue;
    EXPECT_GT(test::least_room(drawn, *scene.find(1), 0.05), -0.001) << "frame " << i;
    EXPECT_LT(test::lowest_skin(drawn, *scene.find(1), 0.05), 0.001) << "frame " << i;
  }
}

/// It fades, as where an object alone is taken away.
TEST(SceneObjects, AHandComesSlowlyBackFromOneThatIsRemoved) {
  const SphereSurface ball(0.15);
  const PlaneSurface floor;
  for (const Method method : kMethods) {
    for (const bool leaves_floor : {false, true}) {
      SCOPED_TRACE(std::string(name_of(method)) + (leaves_floor ? " floor" : ""));
      Scene scene;
      scene.add(1, ball, test::upright({0.0, -0.15, 0.0}));
      if (leaves_floor) scene.add(2, floor, test::upright({0.0, -0.15, 0.0}));
      HandCorrector corrector(by(method));
      PopMeter pops;
      HandPose tracked;
      HandPose drawn;
      for (int i = 0; i < 300; ++i) {
        if (i == 150) {
          EXPECT_TRUE(scene.remove(1));
        }
        tracked = test::on_the_way_down(i, 90, 0.04);
        drawn = corrector.update(tracked, scene, i * kFrame_ns).pose;
        if (i > 140) pops.add(tracked, drawn);
      }
      EXPECT_LT(pops.largest_m(), 0.006);
      EXPECT_LT(largest_motion(drawn, tracked), 0.001);
    }
  }
}

TEST(SceneObjects, AHandComesSlowlyOutOfOneThatIsAdded) {
  const PlaneSurface plane;
  const SphereSurface ball(0.06);
  for (const bool is_put : {false, true}) {
    SCOPED_TRACE(is_put ? "put" : "added");
    Scene scene;
    scene.add(1, plane);
    if (is_put) scene.add(2, ball, test::upright({0.0, 0.0, 9.0}));
    HandCorrector corrector(test::settling());
    PopMeter pops;
    HandPose drawn;
    for (int i = 0; i < 300; ++i) {
      if (i == 150 && is_put) scene.place(2, {});
      if (i == 150 && !is_put) scene.add(2, ball);
      const HandPose tracked = test::on_the_way_down(i, 90, 0.03);
      drawn = corrector.update(tracked, scene, i * kFrame_ns).pose;
      if (i > 140) pops.add(tracked, drawn);
    }
    EXPECT_LT(pops.largest_m(), 0.006);
    EXPECT_GT(test::least_room(drawn, Object(ball), 0.05), -0.001);
  }
}

TEST(SceneObjects, ContactsSayWhatTouchesWhatAndHow) {
  const BoxSurface left({0.2, 0.02, 0.3});
  const BoxSurface right({0.2, 0.02, 0.3});
  const double speed_mps = 0.1;
  for (const Method method : kMethods) {
    SCOPED_TRACE(name_of(method));
    Scene scene;
    scene.add(11, left, test::upright({-0.2, -0.02, 0.0}));
    scene.add(22, right, test::upright({0.2, -0.02, 0.0}));
    HandCorrector corrector(by(method));
    const CorrectedHand* hand = nullptr;
    for (int i = 0; i < 180; ++i) {
      const double along_m = speed_mps * (std::max(i, 90) - 90) * test::kFrame_s;
      const HandPose tracked =
          test::pressed_hand(std::min(0.02, -0.08 + 0.1 * i / 60.0), 0.0, {0.0, 0.0, along_m});
      hand = &corrector.update(tracked, scene, i * kFrame_ns);
      if (i == 0) {
        EXPECT_EQ(hand->skin_contact_count, 0U);
        EXPECT_EQ(hand->velocity_mps[0], Vec3::Zero());
      }
    }
    std::array<int, 2> of_side{};
    std::vector<Joint> bones;
    for (std::size_t k = 0; k < hand->skin_contact_count; ++k) {
      const SkinContact& contact = hand->skin_contacts[k];
      ++of_side[contact.object == 11 ? 0 : 1];
      EXPECT_TRUE(contact.object == 11 || contact.object == 22);
      if (std::abs(contact.point.x()) > 0.002) {
        EXPECT_EQ(contact.object, contact.point.x() < 0.0 ? 11U : 22U);
      }
      EXPECT_NEAR(contact.point.y(), 0.0, 1e-6);
      EXPECT_GT(contact.normal.y(), 0.999);
      EXPECT_GE(contact.depth_m, 0.0);
      EXPECT_LT(contact.depth_m, 0.05);
      EXPECT_LT((contact.velocity_mps - Vec3(0.0, 0.0, speed_mps)).norm(), 0.02);
      EXPECT_EQ(std::find(bones.begin(), bones.end(), contact.bone), bones.end());
      bones.push_back(contact.bone);
    }
    EXPECT_GT(of_side[0], 0);
    EXPECT_GT(of_side[1], 0);
    EXPECT_LT((hand->velocity_mps[0] - Vec3(0.0, 0.0, speed_mps)).norm(), 0.01);
  }
}

TEST(SceneObjects, AskedAgainTheAnswerIsTheSame) {
  const auto top = test::table();
  const SphereSurface ball(0.06);
  for (const Method method : kMethods) {
    SCOPED_TRACE(name_of(method));
    Scene scene;
    scene.add(1, *top);
    scene.add(2, ball, test::upright({0.0, -0.02, -0.1}));
    HandCorrector once(by(method));
    HandCorrector twice(by(method));
    for (int i = 0; i < 150; ++i) {
      scene.place(2, test::upright({0.05 * std::sin(i * test::kFrame_s), -0.02, -0.1}));
      const HandPose tracked = stroking(i, 0.02);
      const HandPose expected = once.update(tracked, scene, i * kFrame_ns).pose;
      ASSERT_TRUE(test::same_bits(expected, twice.update(tracked, scene, i * kFrame_ns).pose));
      ASSERT_TRUE(test::same_bits(expected, twice.update(tracked, scene, i * kFrame_ns).pose));
    }
    // What changed is another question: the hand is out of what came up.
    scene.place(1, test::upright({0.0, 0.01, 0.0}));
    const HandPose before = twice.update(stroking(149, 0.02), scene, 149 * kFrame_ns).pose;
    const HandPose expected = once.update(stroking(149, 0.02), scene, 149 * kFrame_ns).pose;
    EXPECT_TRUE(test::same_bits(before, expected));
  }
}

TEST(SceneObjects, AFrameAllocatesNothing) {
  const auto top = test::table();
  const SphereSurface ball(0.06);
  for (const Method method : kMethods) {
    Scene scene;
    scene.add(1, *top);
    for (ObjectId id = 2; id < 100; ++id) {
      scene.add(id, ball, test::upright({0.0, -0.05, 0.1 * static_cast<double>(id)}));
    }
    HandCorrector corrector(by(method));
    for (int i = 0; i < 150; ++i) {
      const HandPose tracked = stroking(i, 0.02, {0.0, 0.0, 0.01 * i});
      const auto count = test::allocations_of([&] {
        for (ObjectId id = 2; id < 50; ++id) {
          const double z_m = 0.1 * static_cast<double>(id) + 0.02 * std::sin(i * test::kFrame_s);
          scene.place(id, test::upright({0.0, -0.05, z_m}));
        }
        SettleOptions feel;
        feel.softness_m = i % 2 == 0 ? 0.0 : 0.005;
        scene.set_feel(1, feel);
        scene.deformed(1);
        corrector.update(tracked, scene, i * kFrame_ns);
      });
      ASSERT_EQ(count, 0U) << "frame " << i;
    }
  }
}

/// One that grows from out of reach is found where the scene is told.
TEST(SceneObjects, OneThatDeformsIsLookedForWhereItIsNow) {
  TriangleSoup soup = test::box_mesh({0.2F, 0.02F, 0.15F});
  for (Eigen::Vector3f& corner : soup.vertices) corner.y() -= 1.0F;
  const auto surface = MeshSurface::build(soup, "block").value();
  Scene scene;
  scene.add(1, *surface);
  scene.add(2, *surface, test::upright({5.0, 0.0, 0.0}));
  HandCorrector corrector(test::settling());
  const HandPose tracked = test::pressed_hand(0.02);
  EXPECT_TRUE(test::same_bits(tracked, corrector.update(tracked, scene, 0).pose));
  for (Eigen::Vector3f& corner : soup.vertices) corner.y() += 0.98F;
  surface->refit(soup.vertices);
  EXPECT_TRUE(scene.deformed(1));
  HandPose drawn;
  for (int i = 1; i < 100; ++i) drawn = corrector.update(tracked, scene, i * kFrame_ns).pose;
  EXPECT_GT(test::least_room(drawn, *scene.find(1), 0.1), -0.001);
  EXPECT_GT(largest_motion(drawn, tracked), 0.01);
}

TEST(SceneObjects, EachHasItsFeel) {
  const PlaneSurface plane;
  HandCorrector corrector(test::settling());
  Scene scene;
  scene.add(1, plane);
  const auto lowest = [&](int from) {
    HandPose drawn;
    for (int i = from; i < from + 150; ++i) {
      drawn = corrector.update(test::on_the_way_down(i, 60, 0.03), scene, i * kFrame_ns).pose;
    }
    return test::lowest_skin(drawn, Object(plane));
  };
  const double hard_m = lowest(0);
  SettleOptions soft;
  soft.softness_m = 0.015;
  EXPECT_TRUE(scene.set_feel(1, soft));
  EXPECT_LT(lowest(150), hard_m - 0.005);
}

/// The soft one that it left is still near.
TEST(SceneObjects, TheFeelIsThatOfTheOneThatIsTouched) {
  const BoxSurface half({0.2, 0.02, 0.3});
  Scene scene;
  SettleOptions soft;
  soft.softness_m = 0.015;
  scene.add(1, half, test::upright({-0.2, -0.02, 0.0}), soft);
  scene.add(2, half, test::upright({0.2, -0.02, 0.0}));
  HandCorrector corrector(test::settling());
  std::array<double, 2> lowest_m{};
  for (int i = 0; i < 400; ++i) {
    const double along = std::clamp((i - 150) / 100.0, 0.0, 1.0);
    const HandPose tracked = test::pressed_hand(std::min(0.03, -0.08 + 0.11 * i / 60.0), 0.0,
                                                {-0.2 + 0.4 * along, 0.0, 0.0});
    const HandPose drawn = corrector.update(tracked, scene, i * kFrame_ns).pose;
    if (i == 149) lowest_m[0] = test::lowest_skin(drawn, *scene.find(1));
    if (i == 399) lowest_m[1] = test::lowest_skin(drawn, *scene.find(2));
  }
  EXPECT_LT(lowest_m[0], lowest_m[1] - 0.005);
}

/// Of more than there is room for, the nearest.
TEST(SceneObjects, AHandAmongHundredsLiesOnTheNearest) {
  const SphereSurface pebble(0.01);
  const PlaneSurface plane;
  Scene scene;
  test::Random random;
  for (ObjectId id = 2; id < 400; ++id) {
    const Vec3 where = random.point({-0.2, -0.25, -0.2}, {0.2, -0.1, 0.2});
    scene.add(id, pebble, test::upright(where));
  }
  scene.add(1, plane);
  HandCorrector corrector(test::settling());
  HandCorrector alone(test::settling());
  for (int i = 0; i < 150; ++i) {
    const HandPose tracked = stroking(i, 0.01);
    const HandPose drawn = corrector.update(tracked, scene, i * kFrame_ns).pose;
    const HandPose expected = alone.update(tracked, Object(plane), i * kFrame_ns).pose;
    ASSERT_LT(largest_motion(drawn, expected), 5e-4) << "frame " << i;
  }
}

TEST(SceneObjects, OfNoneIsNothing) {
  const SphereSurface ball(0.15);
  Scene scene;
  HandCorrector corrector(test::settling());
  const HandPose tracked = test::pressed_hand(0.02);
  EXPECT_TRUE(test::same_bits(tracked, corrector.update(tracked, scene, 0).pose));
  scene.add(1, ball, {{}, 0.0});
  scene.add(2, ball, test::upright(Vec3::Constant(std::nan(""))));
  EXPECT_TRUE(test::same_bits(tracked, corrector.update(tracked, scene, kFrame_ns).pose));
}

}  // namespace
}  // namespace nade
