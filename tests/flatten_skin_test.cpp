#include "nade/flatten_skin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "generic_hand.h"
#include "nade/corrector.h"
#include "nade/mesh.h"
#include "nade/scene.h"
#include "support/allocation_counter.h"
#include "support/meshes.h"
#include "support/pressed_hand.h"
#include "support/random.h"

namespace nade {
namespace {

using Vec3f = Eigen::Vector3f;

/// A posed skin, and what becomes of it.
struct Skin {
  std::vector<Vec3f> posed;
  std::vector<Vec3f> flattened;
  std::vector<Vec3f> normals;
};

Skin flattened(const HandMesh& mesh, SkinFlattener& flattener, const HandPose& hand,
               const Object& object, double give_m = 0.0) {
  const double scale = hand_scale(mesh, hand);
  Skin skin;
  skin.posed.resize(mesh.vertices.size());
  skin.normals.resize(mesh.vertices.size());
  pose_skin(mesh, hand, scale, skin.posed, skin.normals);
  skin.flattened.resize(mesh.vertices.size());
  flattener.flatten(object, hand, scale, give_m, skin.posed, skin.flattened, skin.normals);
  return skin;
}

Skin flattened(const HandMesh& mesh, const HandPose& hand, const Object& object,
               double give_m = 0.0) {
  SkinFlattener flattener(mesh);
  return flattened(mesh, flattener, hand, object, give_m);
}

double lowest(const std::vector<Vec3f>& skin, const Object& object) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3f& vertex : skin) {
    SurfaceHint hint;
    const auto near = object.closest_point(vertex.cast<double>(), 0.1, hint);
    if (near) least = std::min(least, near->signed_distance);
  }
  return least;
}

class FlattenSkin : public testing::Test {
 protected:
  void SetUp() override {
    mesh_ = test::generic_hand(Handedness::right);
    if (!mesh_) GTEST_SKIP() << "no generic hand";
  }

  /// The bind pose, palm down, the palm's skin `depth_m` below y = 0; `size` times as large.
  [[nodiscard]] HandPose at_depth(double depth_m, double size = 1.0) const {
    const Quat turn = mesh_->bind[Joint::palm].rotation.conjugate();
    const Vec3 to(0.0, size * generic_skin_depths()[Part::palm] - depth_m, 0.0);
    HandPose hand = mesh_->bind;
    for (Pose& joint : hand.joints) joint.position *= size;
    return test::placed_hand(hand, to, turn);
  }

  /// The hand that is drawn after it has come down so deep.
  [[nodiscard]] HandPose pressed(double depth_m, const Object& object, double size = 1.0) const {
    HandCorrector corrector(test::settling());
    HandPose drawn;
    for (int i = 0; i <= 100; ++i) {
      const double down = std::min(1.0, i / 80.0);
      const HandPose tracked = at_depth(down * (0.05 + depth_m) - 0.05, size);
      drawn = corrector.update(tracked, object, i * test::kFrame_ns).pose;
    }
    return drawn;
  }

  /// No edge of the mesh is torn: what its ends are moved by differs by less than its length.
  void expect_whole(const Skin& skin) const {
    for (const auto& triangle : mesh_->triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = triangle[k];
        const std::uint32_t b = triangle[(k + 1) % 3];
        const Vec3f moved_a = skin.flattened[a] - skin.posed[a];
        const Vec3f moved_b = skin.flattened[b] - skin.posed[b];
        EXPECT_LT((moved_a - moved_b).norm(),
                  1.1F * (skin.posed[a] - skin.posed[b]).norm() + 0.0002F)
            << "vertices " << a << " and " << b;
      }
    }
  }

  std::optional<HandMesh> mesh_;
};

TEST_F(FlattenSkin, NoSkinIsBelowAPlane) {
  for (const double depth_m : {0.005, 0.02, 0.04}) {
    const Skin skin = flattened(*mesh_, pressed(depth_m, test::plane()), test::plane());
    EXPECT_LT(lowest(skin.posed, test::plane()), -0.003);
    EXPECT_GT(lowest(skin.flattened, test::plane()), 0.00015) << depth_m;
    expect_whole(skin);
  }
}

TEST_F(FlattenSkin, NoSkinIsBelowABall) {
  for (const double radius_m : {0.15, 0.06}) {
    const SphereSurface sphere(radius_m);
    const Object ball(sphere, {{{0.0, -radius_m, 0.0}, Quat::Identity()}, 1.0});
    const Skin skin = flattened(*mesh_, pressed(0.02, ball), ball);
    EXPECT_LT(lowest(skin.posed, ball), -0.002);
    EXPECT_GT(lowest(skin.flattened, ball), 0.0001) << radius_m;
    expect_whole(skin);
  }
}

TEST_F(FlattenSkin, NothingIsOnTheOtherSideOfAThinBoard) {
  for (const float thick_m : {0.001F, 0.003F, 0.008F}) {
    const auto board = test::block({0.3F, 0.5F * thick_m, 0.3F});
    const Object object(*board);
    for (const double size : {0.8, 1.0, 1.15}) {
      const Skin skin = flattened(*mesh_, pressed(0.015, object, size), object);
      const auto lowest_y = [](const std::vector<Vec3f>& vertices) {
        float lowest = 1.0F;
        for (const Vec3f& vertex : vertices) lowest = std::min(lowest, vertex.y());
        return lowest;
      };
      EXPECT_LT(lowest_y(skin.posed), -0.003F);
      EXPECT_GT(lowest_y(skin.flattened), 0.00015F) << thick_m << " m, size " << size;
      expect_whole(skin);
    }
  }
}

TEST_F(FlattenSkin, SunkSkinLiesAlongTheSurface) {
  const Skin skin = flattened(*mesh_, pressed(0.02, test::plane()), test::plane());
  std::size_t sunk = 0;
  for (std::size_t i = 0; i < skin.posed.size(); ++i) {
    EXPECT_NEAR(skin.normals[i].norm(), 1.0F, 1e-4F);
    if (skin.posed[i].y() > -0.0025F) continue;
    ++sunk;
    EXPECT_LT(skin.normals[i].y(), -0.99F);
    // Straight up: it does not slide.
    EXPECT_LT((skin.flattened[i] - skin.posed[i]).cross(Vec3f::UnitY()).norm(), 1e-5F);
  }
  EXPECT_GT(sunk, 20U);
}

TEST_F(FlattenSkin, WhatIsFarFromTheSurfaceStaysBitForBit) {
  const Skin free = flattened(*mesh_, at_depth(-0.1), test::plane());
  EXPECT_TRUE(free.flattened == free.posed);
  const Skin beyond = flattened(*mesh_, at_depth(0.2), test::plane());
  EXPECT_TRUE(beyond.flattened == beyond.posed);
  const Skin nowhere = flattened(*mesh_, at_depth(0.02), nothing());
  EXPECT_TRUE(nowhere.flattened == nowhere.posed);
  const Skin lying = flattened(*mesh_, pressed(0.02, test::plane()), test::plane());
  std::vector<Vec3f> normals(mesh_->vertices.size());
  const HandPose hand = pressed(0.02, test::plane());
  std::vector<Vec3f> posed(mesh_->vertices.size());
  pose_skin(*mesh_, hand, hand_scale(*mesh_, hand), posed, normals);
  for (std::size_t i = 0; i < lying.posed.size(); ++i) {
    if (lying.posed[i].y() < 0.00201F) continue;
    EXPECT_EQ(lying.flattened[i], lying.posed[i]);
    EXPECT_EQ(lying.normals[i], normals[i]);
  }
}

/// A palm on a table, the fingers on a box on it: under both skin is flat.
TEST_F(FlattenSkin, InASceneNoSkinIsBelowAnyObject) {
  const auto box = test::block({0.08F, 0.05F, 0.05F});
  const Placement beside{{{0.0, 0.003, -0.13}, Quat::Identity()}, 1.0};
  Scene scene;
  scene.add(1, test::plane().surface());
  scene.add(2, *box, beside);
  const SphereSurface far_ball(0.1);
  scene.add(3, far_ball, {{{5.0, 0.0, 0.0}, Quat::Identity()}, 1.0});
  HandCorrector corrector(test::settling());
  HandPose drawn;
  for (int i = 0; i <= 100; ++i) {
    drawn =
        corrector
            .update(at_depth(0.065 * std::min(1.0, i / 80.0) - 0.05), scene, i * test::kFrame_ns)
            .pose;
  }
  const double scale = hand_scale(*mesh_, drawn);
  SkinFlattener flattener(*mesh_);
  Skin skin;
  skin.posed.resize(mesh_->vertices.size());
  skin.normals.resize(mesh_->vertices.size());
  pose_skin(*mesh_, drawn, scale, skin.posed, skin.normals);
  skin.flattened = skin.posed;
  flattener.flatten(scene, drawn, scale, 0.0, skin.posed, skin.flattened, skin.normals);
  for (const Object& object : {test::plane(), Object(*box, beside)}) {
    EXPECT_LT(lowest(skin.posed, object), -0.0015);
    EXPECT_GT(lowest(skin.flattened, object), -0.0005);
  }
  expect_whole(skin);

  // The flattener has met the scene; alone the table is as ever.
  const Skin on_table = flattened(*mesh_, flattener, pressed(0.02, test::plane()), test::plane());
  EXPECT_GT(lowest(on_table.flattened, test::plane()), 0.00015);
  Scene nowhere;
  flattener.flatten(nowhere, drawn, scale, 0.0, skin.posed, skin.flattened, skin.normals);
  EXPECT_TRUE(skin.flattened == skin.posed);
}

/// As it comes down and strokes along, flattened skin moves hardly faster than posed skin.
TEST_F(FlattenSkin, ItFollowsAStrokeWithoutJumps) {
  HandCorrector corrector(test::settling());
  SkinFlattener flattener(*mesh_);
  std::optional<Skin> last;
  float farthest = 0.0F;
  for (int i = 0; i < 200; ++i) {
    const double down = std::clamp(i / 80.0, 0.0, 1.0);
    const Pose along{{0.1 * std::clamp((i - 80) / 100.0, 0.0, 1.0), 0.0, 0.0}, Quat::Identity()};
    const HandPose tracked = moved(at_depth(0.07 * down - 0.05), along);
    const HandPose& drawn = corrector.update(tracked, test::ball(), i * test::kFrame_ns).pose;
    Skin skin = flattened(*mesh_, flattener, drawn, test::ball());
    for (std::size_t v = 0; last && v < skin.posed.size(); ++v) {
      farthest = std::max(farthest, (skin.flattened[v] - last->flattened[v]).norm() -
                                        (skin.posed[v] - last->posed[v]).norm());
    }
    last = std::move(skin);
  }
  EXPECT_LT(farthest, 0.001F);
}

/// Even one that is not corrected: where skin is too deep to be flattened, that fades.
TEST_F(FlattenSkin, AHandThatSinksInIsLetGoSmoothly) {
  SkinFlattener flattener(*mesh_);
  std::optional<Skin> last;
  float farthest = 0.0F;
  for (double depth_m = -0.01; depth_m < 0.03; depth_m += 0.0002) {
    Skin skin = flattened(*mesh_, flattener, at_depth(depth_m), test::ball());
    for (std::size_t v = 0; last && v < skin.posed.size(); ++v) {
      farthest = std::max(farthest, (skin.flattened[v] - last->flattened[v]).norm());
    }
    last = std::move(skin);
  }
  EXPECT_LT(farthest, 0.005F);
}

TEST_F(FlattenSkin, ASoftObjectIsPressedInFirst) {
  const HandPose hand = pressed(0.02, test::plane());
  const Skin skin = flattened(*mesh_, hand, test::plane(), 0.004);
  EXPECT_NEAR(lowest(skin.flattened, test::plane()), -0.004 + 0.0002, 5e-5);
  expect_whole(skin);
}

TEST_F(FlattenSkin, TheOtherHandIsTheMirrorImage) {
  const auto mirror = [](const Vec3f& v) { return Vec3f(-v.x(), v.y(), v.z()); };
  HandMesh other = *mesh_;
  other.side = Handedness::left;
  other.bind = mirrored(mesh_->bind);
  for (Vec3f& vertex : other.vertices) vertex = mirror(vertex);
  for (Vec3f& normal : other.normals) normal = mirror(normal);
  for (auto& triangle : other.triangles) std::swap(triangle[1], triangle[2]);
  const HandPose hand = pressed(0.02, test::ball());
  const Skin right = flattened(*mesh_, hand, test::ball());
  const Skin left = flattened(other, mirrored(hand), test::ball());
  for (std::size_t i = 0; i < right.posed.size(); ++i) {
    EXPECT_LT((mirror(right.flattened[i]) - left.flattened[i]).norm(), 1e-5F);
    EXPECT_LT((mirror(right.normals[i]) - left.normals[i]).norm(), 1e-2F);
  }
}

TEST_F(FlattenSkin, MovedWithTheObjectItIsTheSame) {
  const Pose motion{{0.7, -0.3, 1.1},
                    Quat(Eigen::AngleAxisd(1.3, Vec3(0.3, -0.8, 0.5).normalized()))};
  const HandPose hand = pressed(0.02, test::ball());
  const Skin here = flattened(*mesh_, hand, test::ball());
  const Object ball(test::kBall, {motion * test::ball().placement().pose, 1.0});
  const Skin there = flattened(*mesh_, moved(hand, motion), ball);
  for (std::size_t i = 0; i < here.posed.size(); ++i) {
    const Vec3 expected = motion.apply(here.flattened[i].cast<double>());
    EXPECT_LT((expected - there.flattened[i].cast<double>()).norm(), 1e-5);
  }
}

TEST_F(FlattenSkin, HostilePosesLeaveNoNaN) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto board = test::block({0.3F, 0.0005F, 0.3F});
  const Object object(*board);
  SkinFlattener flattener(*mesh_);
  std::vector<Vec3f> posed(mesh_->vertices.size());
  std::vector<Vec3f> normals(mesh_->vertices.size());
  std::vector<Vec3f> out(mesh_->vertices.size());
  test::Random random(7);
  for (int round = 0; round < 200; ++round) {
    HandPose hand = at_depth(random.uniform(-0.05, 0.1));
    for (Pose& joint : hand.joints) {
      if (random.uniform(0.0, 1.0) < 0.5) continue;
      joint.position += 0.05 * Vec3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                                    random.uniform(-1.0, 1.0));
      joint.rotation = Quat(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                            random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0))
                           .normalized();
    }
    const double scale = random.uniform(0.1, 3.0);
    pose_skin(*mesh_, hand, scale, posed, normals);
    flattener.flatten(object, hand, scale, 0.0, posed, out, normals);
    for (std::size_t i = 0; i < out.size(); ++i) {
      ASSERT_TRUE(out[i].allFinite() && normals[i].allFinite());
      ASSERT_LT((out[i] - posed[i]).norm(), 0.02F);
    }
  }
  HandPose broken = at_depth(0.01);
  pose_skin(*mesh_, broken, 1.0, posed, normals);
  broken[Joint::wrist].position.x() = nan;
  flattener.flatten(object, broken, 1.0, 0.0, posed, out, normals);
  EXPECT_TRUE(out == posed);
  for (const double scale : {nan, 0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    flattener.flatten(object, at_depth(0.01), scale, 0.0, posed, out, normals);
    EXPECT_TRUE(out == posed);
  }
  flattener.flatten(object, at_depth(0.01), 1.0, nan, posed, out, normals);
  EXPECT_TRUE(out == posed);
}

TEST_F(FlattenSkin, AllocatesNothing) {
  const HandPose hand = pressed(0.02, test::ball());
  SkinFlattener flattener(*mesh_);
  std::vector<Vec3f> skin(mesh_->vertices.size());
  std::vector<Vec3f> normals(mesh_->vertices.size());
  pose_skin(*mesh_, hand, 1.0, skin, normals);
  EXPECT_EQ(test::allocations_of(
                [&] { flattener.flatten(test::ball(), hand, 1.0, 0.0, skin, skin, normals); }),
            0U);
  Scene scene;
  scene.add(1, test::ball().surface(), test::ball().placement());
  EXPECT_EQ(
      test::allocations_of([&] { flattener.flatten(scene, hand, 1.0, 0.0, skin, skin, normals); }),
      0U);
}

}  // namespace
}  // namespace nade
