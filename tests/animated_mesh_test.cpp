#include "nade/io/animated_mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "nade/io/mesh_file.h"
#include "nade/io/object_file.h"
#include "nade/mesh.h"

namespace nade {
namespace {

using Json = nlohmann::json;
using Vec3f = Eigen::Vector3f;

/// A .gltf file with one triangle, moved as a test says.
class MovingFile {
 public:
  explicit MovingFile(const std::string& name)
      : path_((std::filesystem::path(testing::TempDir()) / (name + ".gltf")).string()) {
    gltf = Json::parse(R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
      "nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
      "accessors":[],"bufferViews":[],
      "animations":[{"name":"sway","channels":[],"samplers":[]}]})");
    add({0, 0, 0, 1, 0, 0, 0, 0, -1}, "VEC3");
    add_bytes(std::vector<std::uint16_t>{0, 1, 2}, 5123, "SCALAR", 3);
  }

  int add(const std::vector<float>& numbers, const std::string& type) {
    const std::size_t width = type == "SCALAR" ? 1 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
    return add_bytes(numbers, 5126, type, numbers.size() / width);
  }

  template <class Number>
  int add_bytes(const std::vector<Number>& numbers, int component, const std::string& type,
                std::size_t count) {
    const std::size_t start = bytes_.size();
    const std::size_t size = numbers.size() * sizeof(Number);
    bytes_.resize(start + (size + 3) / 4 * 4);
    std::memcpy(bytes_.data() + start, numbers.data(), size);
    gltf["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", start}, {"byteLength", size}});
    gltf["accessors"].push_back({{"bufferView", gltf["bufferViews"].size() - 1},
                                 {"componentType", component},
                                 {"type", type},
                                 {"count", count}});
    return static_cast<int>(gltf["accessors"].size()) - 1;
  }

  /// Moves a property of a node.
  void animate(int node, const std::string& property, const std::string& interpolation,
               const std::vector<float>& times, const std::vector<float>& values) {
    const std::string type = property == "rotation"  ? "VEC4"
                             : property == "weights" ? "SCALAR"
                                                     : "VEC3";
    Json& animation = gltf["animations"][0];
    animation["samplers"].push_back({{"input", add(times, "SCALAR")},
                                     {"output", add(values, type)},
                                     {"interpolation", interpolation}});
    animation["channels"].push_back({{"sampler", animation["samplers"].size() - 1},
                                     {"target", {{"node", node}, {"path", property}}}});
  }

  /// Writes it; its path.
  const std::string& write() {
    const std::string bin = path_ + ".bin";
    std::ofstream(bin, std::ios::binary) << bytes_;
    gltf["buffers"] = {
        {{"byteLength", bytes_.size()}, {"uri", std::filesystem::path(bin).filename().string()}}};
    std::ofstream(path_) << gltf.dump();
    return path_;
  }

  Json gltf;

 private:
  std::string path_;
  std::string bytes_;
};

std::vector<Vec3f> sampled(AnimatedMesh& mesh, double time_s) {
  std::vector<Vec3f> vertices(mesh.vertex_count());
  mesh.sample(time_s, vertices);
  return vertices;
}

void expect_at(const Vec3f& found, const Vec3f& expected) {
  EXPECT_LT((found - expected).norm(), 1e-5F) << found.transpose();
}

TEST(AnimatedMesh, NodesMoveStraightFromKeyToKeyAndRoundAgain) {
  MovingFile file("nade_sway");
  file.animate(0, "translation", "LINEAR", {0, 1, 2}, {0, 0, 0, 0, 2, 0, 0, 0, 0});
  auto mesh = AnimatedMesh::load(file.write());
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_DOUBLE_EQ(mesh->duration_s(), 2.0);
  expect_at(sampled(*mesh, 0.25)[1], {1.0F, 0.5F, 0.0F});
  expect_at(sampled(*mesh, 1.5)[1], {1.0F, 1.0F, 0.0F});
  expect_at(sampled(*mesh, 4.25)[1], {1.0F, 0.5F, 0.0F});
  expect_at(sampled(*mesh, -0.25)[1], {1.0F, 0.5F, 0.0F});
}

TEST(AnimatedMesh, StepsAndSplines) {
  MovingFile steps("nade_steps");
  steps.animate(0, "scale", "STEP", {0, 1, 2}, {1, 1, 1, 3, 3, 3, 1, 1, 1});
  auto stepping = AnimatedMesh::load(steps.write());
  ASSERT_TRUE(stepping.ok()) << stepping.error().message;
  expect_at(sampled(*stepping, 0.99)[1], {1.0F, 0.0F, 0.0F});
  expect_at(sampled(*stepping, 1.01)[1], {3.0F, 0.0F, 0.0F});
  // In tangent, value, out tangent: y = t^2 between the keys.
  MovingFile spline("nade_spline");
  spline.animate(0, "translation", "CUBICSPLINE", {0, 1},
                 {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 1, 0, 0, 0, 0});
  auto bending = AnimatedMesh::load(spline.write());
  ASSERT_TRUE(bending.ok()) << bending.error().message;
  expect_at(sampled(*bending, 0.5)[0], {0.0F, 0.25F, 0.0F});
}

TEST(AnimatedMesh, TurnsTheShortWay) {
  MovingFile file("nade_turn");
  const float half = std::sqrt(0.5F);
  file.animate(0, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, -half, 0, -half});
  auto mesh = AnimatedMesh::load(file.write());
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  expect_at(sampled(*mesh, 0.5)[1], {half, 0.0F, -half});
}

TEST(AnimatedMesh, MorphTargets) {
  MovingFile file("nade_morph");
  Json& primitive = file.gltf["meshes"][0]["primitives"][0];
  primitive["targets"] = {{{"POSITION", file.add({0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3")}},
                          {{"POSITION", file.add({0, 0, 0, 5, 0, 0, 0, 0, 0}, "VEC3")}}};
  file.gltf["meshes"][0]["weights"] = {0.5, 0.0};
  file.animate(0, "weights", "LINEAR", {0, 1}, {0, 0, 1, 0.2F});
  auto mesh = AnimatedMesh::load(file.write());
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  expect_at(sampled(*mesh, 0.5)[1], {1.5F, 0.5F, 0.0F});
}

TEST(AnimatedMesh, BonesCarryTheSkin) {
  MovingFile file("nade_bones");
  file.gltf["nodes"] = Json::parse(
      R"([{"mesh":0,"skin":0,"translation":[9,9,9]},{"children":[2]},{"translation":[1,0,0]}])");
  file.gltf["scenes"][0]["nodes"] = {0, 1};
  std::vector<float> inverse(32, 0.0F);
  for (std::size_t bone = 0; bone < 2; ++bone) {
    for (std::size_t i = 0; i < 4; ++i) inverse[16 * bone + 5 * i] = 1.0F;
  }
  inverse[16 + 12] = -1.0F;
  file.gltf["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", file.add(inverse, "MAT4")}}};
  Json& attributes = file.gltf["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = file.add_bytes(
      std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, 5121, "VEC4", 3);
  attributes["WEIGHTS_0"] = file.add({1, 0, 0, 0, 1, 0, 0, 0, 0.5F, 0.5F, 0, 0}, "VEC4");
  file.animate(2, "translation", "LINEAR", {0, 1}, {1, 0, 0, 1, 2, 0});
  auto mesh = AnimatedMesh::load(file.write());
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  const std::vector<Vec3f> vertices = sampled(*mesh, 0.5);
  expect_at(vertices[0], {0.0F, 0.0F, 0.0F});
  expect_at(vertices[1], {1.0F, 1.0F, 0.0F});
  expect_at(vertices[2], {0.0F, 0.5F, -1.0F});
}

TEST(AnimatedMesh, SaysWhatCannotBePlayed) {
  MovingFile still("nade_still");
  still.gltf.erase("animations");
  const auto none = AnimatedMesh::load(still.write());
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.error().message.find("expected an animation, found none"), std::string::npos);

  MovingFile file("nade_names");
  file.animate(0, "translation", "LINEAR", {0, 1}, {0, 0, 0, 0, 1, 0});
  const auto unknown = AnimatedMesh::load(file.write(), "walk");
  ASSERT_FALSE(unknown.ok());
  EXPECT_NE(unknown.error().message.find("no animation 'walk': expected one of sway"),
            std::string::npos);
  EXPECT_TRUE(AnimatedMesh::load(file.write(), "sway").ok());

  MovingFile short_of("nade_short");
  short_of.animate(0, "translation", "LINEAR", {0, 1}, {0, 0, 0});
  const auto few = AnimatedMesh::load(short_of.write());
  ASSERT_FALSE(few.ok());
  EXPECT_NE(few.error().message.find("channel 0: expected 6 numbers for 2 keys, found 3"),
            std::string::npos);
}

TEST(AnimatedMesh, AnObjectIsAliveWhereItsNameSaysSo) {
  MovingFile file("nade_alive");
  file.animate(0, "translation", "LINEAR", {0, 1}, {0, 0, 0, 0, 1, 0});
  const std::string path = file.write();
  const auto still = load_object(path);
  ASSERT_TRUE(still.ok());
  EXPECT_FALSE(still->animation.has_value());
  auto alive = load_object(path + ":alive:sway");
  ASSERT_TRUE(alive.ok()) << alive.error().message;
  const std::uint64_t before = alive->surface->shape();
  alive->move_to(0.5);
  EXPECT_NE(alive->surface->shape(), before);
  expect_at(alive->soup->vertices[0], {0.0F, 0.5F, 0.0F});
  const auto hit = alive->placed().first_hit({{0.2, 3.0, -0.2}, -Vec3::UnitY(), 10.0});
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(hit->distance, 2.5, 1e-5);
  EXPECT_FALSE(load_object("plane:alive").ok());
  EXPECT_FALSE(load_object("dog:alivest").ok());
}

TEST(AnimatedMesh, TheDogAtItsAnimationsStartIsTheDogAtRest) {
  auto rest = load_mesh(NADE_TEST_DOG);
  auto dog = AnimatedMesh::load(NADE_TEST_DOG);
  ASSERT_TRUE(rest.ok() && dog.ok());
  ASSERT_EQ(dog->vertex_count(), rest->soup.vertices.size());
  for (const double time_s : {0.0, dog->duration_s()}) {
    const std::vector<Vec3f> vertices = sampled(*dog, time_s);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      ASSERT_LT((vertices[i] - rest->soup.vertices[i]).norm(), 1e-6F) << i;
    }
  }
}

/// No two neighbouring triangles fold over, and it is one solid, whatever it does.
TEST(AnimatedMesh, TheLivingDogStaysSmooth) {
  auto rest = load_mesh(NADE_TEST_DOG);
  auto dog = AnimatedMesh::load(NADE_TEST_DOG);
  ASSERT_TRUE(rest.ok() && dog.ok());
  for (int moment = 0; moment < 12; ++moment) {
    rest->soup.vertices = sampled(*dog, 0.5 * moment + 0.19);
    const auto surface = MeshSurface::build(rest->soup, "dog");
    ASSERT_TRUE(surface.ok());
    EXPECT_EQ((*surface)->report().solid, MeshSolid::closed);
    std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3f> normals;
    for (const auto& t : rest->soup.triangles) {
      const auto& v = rest->soup.vertices;
      const Vec3f normal = (v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]).normalized();
      for (std::size_t i = 0; i < 3; ++i) normals[{t[i], t[(i + 1) % 3]}] = normal;
    }
    for (const auto& [edge, normal] : normals) {
      ASSERT_GT(normal.dot(normals.at({edge.second, edge.first})), 0.0F) << "a fold";
    }
  }
}

}  // namespace
}  // namespace nade
