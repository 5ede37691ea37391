#include "nade/hand_mesh.h"

#include <gtest/gtest.h>

#include <vector>

#include "generic_hand.h"

namespace nade {
namespace {

constexpr std::array<Handedness, 2> kSides{Handedness::left, Handedness::right};

std::vector<Eigen::Vector3f> skin_of(const HandMesh& mesh, const HandPose& hand, double scale) {
  std::vector<Eigen::Vector3f> skin(mesh.vertices.size());
  pose_skin(mesh, hand, scale, skin, {});
  return skin;
}

TEST(HandMesh, BindPoseGivesTheMeshBack) {
  for (const Handedness side : kSides) {
    NADE_TEST_GENERIC_HAND(mesh, side);
    const std::vector<Eigen::Vector3f> skin = skin_of(mesh, mesh.bind, 1.0);
    for (std::size_t i = 0; i < skin.size(); ++i) {
      EXPECT_LT((skin[i] - mesh.vertices[i]).norm(), 1e-6F);
    }
  }
}

TEST(HandMesh, FollowsAMovedHandFarFromTheOrigin) {
  NADE_TEST_GENERIC_HAND(mesh, Handedness::right);
  const Pose motion{{3.0, 1.5, -2.0}, Quat(Eigen::AngleAxisd(1.0, Vec3(1, 2, 3).normalized()))};
  const std::vector<Eigen::Vector3f> skin = skin_of(mesh, moved(mesh.bind, motion), 1.0);
  std::vector<Eigen::Vector3f> positions(skin.size());
  std::vector<Eigen::Vector3f> normals(skin.size());
  pose_skin(mesh, moved(mesh.bind, motion), 1.0, positions, normals);
  for (std::size_t i = 0; i < skin.size(); ++i) {
    const Vec3 expected = motion.apply(mesh.vertices[i].cast<double>());
    EXPECT_LT((skin[i].cast<double>() - expected).norm(), 1e-6);
    EXPECT_EQ(skin[i], positions[i]);
    const Vec3 normal = motion.rotation * mesh.normals[i].cast<double>();
    EXPECT_LT((normals[i].cast<double>() - normal).norm(), 1e-5);
  }
}

TEST(HandMesh, GrowsWithTheHand) {
  NADE_TEST_GENERIC_HAND(mesh, Handedness::left);
  HandPose large = mesh.bind;
  for (Pose& joint : large.joints) joint.position *= 1.2;
  EXPECT_NEAR(hand_scale(mesh, large), 1.2, 1e-9);
  const std::vector<Eigen::Vector3f> skin = skin_of(mesh, large, hand_scale(mesh, large));
  for (std::size_t i = 0; i < skin.size(); ++i) {
    EXPECT_LT((skin[i] - 1.2F * mesh.vertices[i]).norm(), 1e-6F);
  }
}

TEST(HandMesh, HandWithoutLengthIsNotScaled) {
  NADE_TEST_GENERIC_HAND(mesh, Handedness::left);
  EXPECT_EQ(hand_scale(mesh, HandPose{}), 1.0);
  EXPECT_EQ(hand_scale(HandMesh{}, mesh.bind), 1.0);
}

TEST(HandMesh, SkinDepthsOfTheGenericHand) {
  for (const Handedness side : kSides) {
    NADE_TEST_GENERIC_HAND(mesh, side);
    const SkinDepths measured = measure_skin_depths(mesh);
    const SkinDepths stored = generic_skin_depths();
    for (std::size_t i = 0; i < kPartCount; ++i) {
      EXPECT_NEAR(measured.depth_m[i], stored.depth_m[i], 2e-4) << name_of(part_at(i));
      // As measured by others, along axes a few degrees from the joints' own.
      constexpr std::array<double, kPartCount> kPublished_mm{20.5, 8.8, 6.6, 7.0, 6.5, 5.0};
      EXPECT_NEAR(1e3 * measured.depth_m[i], kPublished_mm[i], 1.0) << name_of(part_at(i));
    }
  }
}

TEST(HandMesh, SkinDepthWithoutSkinIsZero) {
  EXPECT_EQ(measure_skin_depths(HandMesh{})[Part::palm], 0.0);
}

}  // namespace
}  // namespace nade
