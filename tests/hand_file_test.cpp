#include "nade/io/hand_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "generic_hand.h"
#include "skinned_hand_file.h"
#include "support/files.h"

namespace nade {
namespace {

using nlohmann::json;
using test::SkinnedHandFile;

TEST(HandFile, GenericHandsLoadByJointName) {
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    NADE_TEST_GENERIC_HAND(mesh, side);
    EXPECT_EQ(mesh.vertices.size(), 1360U);
    EXPECT_EQ(mesh.triangles.size(), 2314U);
    EXPECT_EQ(mesh.normals.size(), mesh.vertices.size());
    EXPECT_EQ(mesh.texcoords.size(), mesh.vertices.size());
    EXPECT_TRUE(is_usable(mesh.bind));
    EXPECT_NEAR(hand_length(mesh.bind), kGenericHandLength, 1e-7);
    const Pose palm = palm_from_middle_metacarpal(mesh.bind);
    EXPECT_EQ(mesh.bind[Joint::palm].position, palm.position);
    for (const auto& weights : mesh.weights) {
      EXPECT_NEAR(weights[0] + weights[1] + weights[2] + weights[3], 1.0F, 1e-6F);
    }
  }
}

TEST(HandFile, OtherHandIsRefused) {
  const std::optional<std::string> path = test::generic_hand_path(Handedness::left);
  if (!path) GTEST_SKIP() << "generic hand not fetched";
  const Result<HandMesh> mesh = load_hand_mesh(*path, Handedness::right);
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().message, *path + ": is a left hand, expected a right one");
}

TEST(HandFile, MissingFile) {
  const Result<HandMesh> mesh = load_hand_mesh("/nowhere/hand.glb", Handedness::right);
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, ErrorCode::not_found);
  EXPECT_EQ(mesh.error().message, "/nowhere/hand.glb: no such file");
}

TEST(HandFile, OwnHandLoads) {
  const SkinnedHandFile file;
  const Result<HandMesh> mesh = load_hand_mesh(file.write("own"), Handedness::right);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->vertices.size(), 3U);
  EXPECT_NEAR((mesh->bind[Joint::index_tip].position - file.joint(Joint::index_tip)).norm(), 0.0,
              1e-8);
  // The file has no normals: they are those of its triangle.
  for (const Eigen::Vector3f& normal : mesh->normals) EXPECT_NEAR(normal.norm(), 1.0F, 1e-6F);
}

TEST(HandFile, ScaleInTheBindMatricesGoesIntoTheMesh) {
  SkinnedHandFile plain;
  SkinnedHandFile centimetres;
  centimetres.unit = 100.0;
  const Result<HandMesh> expected = load_hand_mesh(plain.write("metres"), Handedness::right);
  const Result<HandMesh> mesh = load_hand_mesh(centimetres.write("cm"), Handedness::right);
  ASSERT_TRUE(expected) << expected.error().message;
  ASSERT_TRUE(mesh) << mesh.error().message;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    EXPECT_LT((mesh->bind.joints[i].position - expected->bind.joints[i].position).norm(), 1e-6);
  }
  EXPECT_LT((mesh->vertices[0] - expected->vertices[0]).norm(), 1e-6F);
}

TEST(HandFile, UnnormalisedWeightsSumToOne) {
  SkinnedHandFile file;
  file.weights = {0.2F, 0.2F, 0.0F, 0.0F};
  const Result<HandMesh> mesh = load_hand_mesh(file.write("weights"), Handedness::right);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_FLOAT_EQ(mesh->weights[0][0], 0.5F);
}

TEST(HandFile, ExtraBoneCountsAsItsAncestor) {
  SkinnedHandFile file;
  file.extra_bone_parent = Joint::index_distal;
  const Result<HandMesh> mesh = load_hand_mesh(file.write("extra"), Handedness::right);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->bones[0][0], index_of(Joint::index_distal));
}

TEST(HandFile, ExtraBoneWithoutAncestorIsRefused) {
  SkinnedHandFile file;
  file.extra_bone_parent = std::nullopt;
  file.has_extra_bone = true;
  const Result<HandMesh> mesh = load_hand_mesh(file.write("loose"), Handedness::right);
  ASSERT_FALSE(mesh);
  EXPECT_NE(mesh.error().message.find("neither a joint of the hand nor below one"),
            std::string::npos)
      << mesh.error().message;
}

TEST(HandFile, MissingJointIsNamed) {
  SkinnedHandFile file;
  file.misnamed = Joint::ring_distal;
  const Result<HandMesh> mesh = load_hand_mesh(file.write("joint"), Handedness::right);
  ASSERT_FALSE(mesh);
  EXPECT_NE(mesh.error().message.find("no joint ring_distal"), std::string::npos)
      << mesh.error().message;
}

TEST(HandFile, NodeTransformsDoNotCount) {
  SkinnedHandFile file;
  json gltf = file.gltf();
  for (json& node : gltf["nodes"]) node["translation"] = {1.0, 2.0, 3.0};
  const Result<HandMesh> mesh = load_hand_mesh(file.write("moved", gltf), Handedness::right);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_NEAR((mesh->bind[Joint::wrist].position - file.joint(Joint::wrist)).norm(), 0.0, 1e-8);
}

TEST(HandFile, AccessorBeyondItsBufferIsRefused) {
  const SkinnedHandFile file;
  struct Damage {
    const char* key;
    std::size_t value;
  };
  constexpr std::size_t kLarge = 1U << 20U;
  constexpr std::size_t kWraps = std::size_t{1} << 62U;
  for (const Damage& damage :
       {Damage{"count", kLarge}, Damage{"count", kWraps}, Damage{"byteOffset", kLarge},
        Damage{"byteOffset", kWraps}, Damage{"bufferView", kLarge}}) {
    for (std::size_t accessor = 0; accessor < 5; ++accessor) {
      json gltf = file.gltf();
      gltf["accessors"][accessor][damage.key] = damage.value;
      const std::string path = SkinnedHandFile::write("beyond", gltf);
      const Result<HandMesh> mesh = load_hand_mesh(path, Handedness::right);
      ASSERT_FALSE(mesh) << damage.key << " of accessor " << accessor;
      EXPECT_EQ(mesh.error().message.find(path), 0U);
    }
  }
}

TEST(HandFile, CutOffAnywhereIsAnError) {
  const std::optional<std::string> path = test::generic_hand_path(Handedness::right);
  if (!path) GTEST_SKIP() << "generic hand not fetched";
  const std::string bytes = test::read_file(*path);
  const std::string cut = testing::TempDir() + "nade_cut.glb";
  for (std::size_t length = 0; length < bytes.size(); length += 997) {
    test::write_file(cut, bytes.substr(0, length));
    EXPECT_FALSE(load_hand_mesh(cut, Handedness::right)) << length;
  }
  std::filesystem::remove(cut);
}

TEST(HandFile, DamagedBytesNeverCrash) {
  const std::optional<std::string> path = test::generic_hand_path(Handedness::right);
  if (!path) GTEST_SKIP() << "generic hand not fetched";
  const std::string bytes = test::read_file(*path);
  const std::string damaged_path = testing::TempDir() + "nade_damaged.glb";
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    std::string damaged = bytes;
    // Mostly in the JSON part, where a number changes what is read.
    for (int i = 0; i < 3; ++i) damaged[random() % 7800U] = static_cast<char>('0' + random() % 10);
    test::write_file(damaged_path, damaged);
    const Result<HandMesh> mesh = load_hand_mesh(damaged_path, Handedness::right);
    EXPECT_TRUE(mesh || !mesh.error().message.empty());
  }
  std::filesystem::remove(damaged_path);
}

}  // namespace
}  // namespace nade
