// Recordings as glTF models: what a reader of glTF makes of them is the skin of the recorded hands.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "nade/hand_mesh.h"
#include "nade/io/hand_file.h"
#include "nade/io/object_file.h"
#include "nade/io/recording.h"
#include "support/files.h"
#include "support/scratch_folder.h"

namespace nade {
namespace {

using test::read_file;
using test::write_file;

HandMesh hand_mesh(Handedness side) {
  const std::string file = std::string(NADE_TEST_HANDS_DIR) + "/" + std::string(name_of(side));
  return load_hand_mesh(file + ".glb", side).value();
}

/// A hand 8 % larger than the mesh that turns on its way, with bent fingers.
HandPose hand_at(const HandMesh& mesh, double time_s) {
  HandPose hand = mesh.bind;
  const Quat turn(Eigen::AngleAxisd(2.5 * time_s, Vec3(0.3, 1.0, -0.2).normalized()));
  const Quat bend(Eigen::AngleAxisd(-0.6 * std::sin(3.0 * time_s), Vec3::UnitX()));
  for (std::size_t i = 0; i < kJointCount; ++i) {
    Pose& joint = hand.joints[i];
    joint.position = Vec3(0.2 * time_s, 1.0, -0.3) + turn * (1.08 * joint.position);
    joint.rotation = turn * joint.rotation;
    if (joint_at(i) == Joint::index_tip) joint.rotation = joint.rotation * bend;
  }
  return hand;
}

class AnimatedHandsTest : public test::FolderTest {
 protected:
  static constexpr std::int64_t kStep_ns = 11'000'000;
  static constexpr int kFrames = 60;
  static constexpr int kLeftFrom = 20;
  static constexpr int kLeftTo = 40;

  void write(const std::string& name, const ModelOptions& options) const {
    auto writer = RecordingWriter::create(path(name), {}, {}, options);
    ASSERT_TRUE(writer) << writer.error().message;
    for (int i = 0; i < kFrames; ++i) {
      RecordedFrame frame;
      frame.time_ns = 5'000'000'000 + i * kStep_ns;
      const double time_s = 1e-9 * static_cast<double>(i * kStep_ns);
      frame.hands[1] = RecordedHand{hand_at(right_, time_s), {}, {}, {}};
      if (i >= kLeftFrom && i < kLeftTo) {
        frame.hands[0] = RecordedHand{hand_at(left_, time_s), {}, {}, {}};
      }
      if (i == 30) frame.hands[1]->contact[0] = RecordedContact{{1, 2, 3}, {0, 1, 0}, 0.004};
      ASSERT_TRUE(writer->write(frame));
    }
    ASSERT_TRUE(writer->finish());
  }

  [[nodiscard]] nlohmann::json json_of(const std::string& name) const {
    const std::string bytes = read_file(path(name));
    const auto byte = [&](std::size_t i) {
      return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i]));
    };
    const std::size_t length = byte(12) | byte(13) << 8 | byte(14) << 16;
    return nlohmann::json::parse(bytes.substr(20, length));
  }

  HandMesh left_ = hand_mesh(Handedness::left);
  HandMesh right_ = hand_mesh(Handedness::right);
};

TEST_F(AnimatedHandsTest, AReaderOfGltfSeesTheRecordedSkin) {
  for (const bool chained : {true, false}) {
    write("hands.glb", {chained, nullptr});
    Result<LoadedObject> object = load_object(path("hands.glb") + ":alive");
    ASSERT_TRUE(object) << object.error().message;
    ASSERT_EQ(object->soup->vertices.size(), left_.vertices.size() + right_.vertices.size());
    for (const int i : {0, 7, 25, 39, 58}) {
      const double time_s = 1e-9 * static_cast<double>(i * kStep_ns);
      object->move_to(time_s);
      std::vector<Eigen::Vector3f> skin(right_.vertices.size());
      pose_skin(right_, hand_at(right_, time_s), 1.08, skin, {});
      float worst = 0.0F;
      for (std::size_t v = 0; v < skin.size(); ++v) {
        const auto& shown = object->soup->vertices[left_.vertices.size() + v];
        worst = std::max(worst, (shown - skin[v]).norm());
      }
      EXPECT_LT(worst, 1e-5F) << "frame " << i << ", chained " << chained;
      if (i < kLeftFrom || i >= kLeftTo) continue;
      skin.resize(left_.vertices.size());
      pose_skin(left_, hand_at(left_, time_s), 1.08, skin, {});
      for (std::size_t v = 0; v < skin.size(); v += 50) {
        EXPECT_LT((object->soup->vertices[v] - skin[v]).norm(), 1e-5F) << "frame " << i;
      }
    }
  }
}

TEST_F(AnimatedHandsTest, AHandThatIsMissingHasNoSize) {
  write("hands.glb", {});
  Result<LoadedObject> object = load_object(path("hands.glb") + ":alive");
  ASSERT_TRUE(object) << object.error().message;
  const auto spread_at = [&](int frame) {
    object->move_to(1e-9 * static_cast<double>(frame * kStep_ns) + 1e-3);
    const auto& vertices = object->soup->vertices;
    return (vertices[0] - vertices[left_.vertices.size() / 2]).norm();
  };
  EXPECT_EQ(spread_at(0), 0.0F);
  EXPECT_GT(spread_at(kLeftFrom), 0.005F);
  EXPECT_GT(spread_at(kLeftTo - 1), 0.005F);
  EXPECT_EQ(spread_at(kLeftTo), 0.0F);
}

TEST_F(AnimatedHandsTest, NamesHeaderAndContactsAreThere) {
  write("hands.glb", {true, std::make_shared<const TriangleSoup>(
                                TriangleSoup{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}})});
  const nlohmann::json model = json_of("hands.glb");
  std::vector<std::string> roots;
  for (const auto& node : model["scenes"][0]["nodes"]) {
    roots.push_back(model["nodes"][node.get<std::size_t>()]["name"]);
  }
  EXPECT_EQ(roots, (std::vector<std::string>{"left-hand", "right-hand", "object"}));
  ASSERT_EQ(model["skins"].size(), 2U);
  for (const auto& skin : model["skins"]) {
    ASSERT_EQ(skin["joints"].size(), 25U);
    for (std::size_t i = 0; i < 25; ++i) {
      const auto& node = model["nodes"][skin["joints"][i].get<std::size_t>()];
      EXPECT_EQ(node["name"], webxr_name_of(joint_at(i + 1)));
    }
  }
  const auto& hand = model["nodes"][model["scenes"][0]["nodes"][1].get<std::size_t>()];
  const auto& palm = hand["extras"]["contacts"]["palm"];
  EXPECT_NEAR(palm["time_s"][0].get<double>(), 0.33, 1e-6);
  EXPECT_EQ(palm["point"][0], (nlohmann::json{1.0, 2.0, 3.0}));
  EXPECT_EQ(palm["depth_m"][0], 0.004);
}

TEST_F(AnimatedHandsTest, ARecordingWithoutHandsIsAModelWithout) {
  auto writer = RecordingWriter::create(path("none.glb"), {});
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->write({}));
  ASSERT_TRUE(writer->finish());
  EXPECT_FALSE(json_of("none.glb").contains("animations"));
}

}  // namespace
}  // namespace nade
