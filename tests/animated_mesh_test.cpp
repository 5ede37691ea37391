#include "nade/io/animated_mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "nade/io/mesh_file.h"
#include "nade/io/object_file.h"
#include "nade/mesh.h"
#include "support/gltf_file.h"

namespace nade {
namespace {

using Json = nlohmann::json;
using test::GltfFile;
using Vec3f = Eigen::Vector3f;

std::vector<Vec3f> sampled(AnimatedMesh& mesh, double time_s) {
  std::vector<Vec3f> vertices(mesh.vertex_count());
  mesh.sample(time_s, vertices);
  return vertices;
}

void expect_at(const Vec3f& found, const Vec3f& expected) {
  EXPECT_LT((found - expected).norm(), 1e-5F) << found.transpose();
}

TEST(AnimatedMesh, NodesMoveStraightFromKeyToKeyAndRoundAgain) {
  GltfFile file("nade_sway");
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
  GltfFile steps("nade_steps");
  steps.animate(0, "scale", "STEP", {0, 1, 2}, {1, 1, 1, 3, 3, 3, 1, 1, 1});
  auto stepping = AnimatedMesh::load(steps.write());
  ASSERT_TRUE(stepping.ok()) << stepping.error().message;
  expect_at(sampled(*stepping, 0.99)[1], {1.0F, 0.0F, 0.0F});
  expect_at(sampled(*stepping, 1.01)[1], {3.0F, 0.0F, 0.0F});
  // In tangent, value, out tangent: y = t^2 between the keys.
  GltfFile spline("nade_spline");
  spline.animate(0, "translation", "CUBICSPLINE", {0, 1},
                 {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 1, 0, 0, 0, 0});
  auto bending = AnimatedMesh::load(spline.write());
  ASSERT_TRUE(bending.ok()) << bending.error().message;
  expect_at(sampled(*bending, 0.5)[0], {0.0F, 0.25F, 0.0F});
}

TEST(AnimatedMesh, TurnsTheShortWay) {
  GltfFile file("nade_turn");
  const float half = std::sqrt(0.5F);
  file.animate(0, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, -half, 0, -half});
  auto mesh = AnimatedMesh::load(file.write());
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  expect_at(sampled(*mesh, 0.5)[1], {half, 0.0F, -half});
}

TEST(AnimatedMesh, MorphTargets) {
  GltfFile file("nade_morph");
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
  GltfFile file("nade_bones");
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
  GltfFile still("nade_still");
  still.gltf.erase("animations");
  const auto none = AnimatedMesh::load(still.write());
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.error().message.find("expected an animation, found none"), std::string::npos);

  GltfFile file("nade_names");
  file.animate(0, "translation", "LINEAR", {0, 1}, {0, 0, 0, 0, 1, 0});
  const auto unknown = AnimatedMesh::load(file.write(), "walk");
  ASSERT_FALSE(unknown.ok());
  EXPECT_NE(unknown.error().message.find("no animation 'walk': expected one of sway"),
            std::string::npos);
  EXPECT_TRUE(AnimatedMesh::load(file.write(), "sway").ok());

  GltfFile short_of("nade_short");
  short_of.animate(0, "translation", "LINEAR", {0, 1}, {0, 0, 0});
  const auto few = AnimatedMesh::load(short_of.write());
  ASSERT_FALSE(few.ok());
  EXPECT_NE(few.error().message.find("channel 0: expected 6 numbers for 2 keys, found 3"),
            std::string::npos);
}

TEST(AnimatedMesh, OneMomentStandsStillAndNamesTheOthers) {
  GltfFile file("nade_moment");
  file.animate(0, "translation", "LINEAR", {0}, {0, 2, 0});
  Json pose = file.gltf["animations"][0];
  pose["name"] = "T-Pose";
  file.gltf["animations"] = Json::array({pose});
  auto alone = load_object(file.write() + ":alive");
  ASSERT_TRUE(alone.ok()) << alone.error().message;
  ASSERT_EQ(alone->warnings.size(), 2U);
  EXPECT_TRUE(
      alone->warnings[1].ends_with("animation 'T-Pose' has one moment only, so it stands still"));
  for (const double time_s : {0.0, 0.7, -3.0}) {
    alone->move_to(time_s);
    expect_at(alone->soup->vertices[0], {0, 2, 0});
  }
  file.gltf["animations"] = {
      {{"name", "Walk"}, {"channels", Json::array()}, {"samplers", Json::array()}}};
  file.animate(0, "translation", "LINEAR", {0, 1}, {0, 0, 0, 0, 1, 0});
  file.gltf["accessors"][file.gltf["animations"][0]["samplers"][0]["input"].get<std::size_t>()]
           ["max"] = {1};
  file.gltf["animations"] = {pose, file.gltf["animations"][0]};
  const auto first = load_object(file.write() + ":alive");
  ASSERT_TRUE(first.ok()) << first.error().message;
  EXPECT_TRUE(first->warnings.at(1).ends_with("stands still; others: Walk"));
}

TEST(AnimatedMesh, TheEndingMayBeInCapitals) {
  GltfFile file("nade_capitals");
  file.animate(0, "translation", "LINEAR", {0, 1}, {0, 0, 0, 0, 1, 0});
  const std::filesystem::path path = file.write();
  std::filesystem::path capitals = path;
  capitals.replace_extension(".GLTF");
  std::filesystem::copy_file(path, capitals, std::filesystem::copy_options::overwrite_existing);
  const auto object = load_object(capitals.string() + ":alive");
  ASSERT_TRUE(object.ok()) << object.error().message;
  EXPECT_TRUE(object->animation.has_value());
}

TEST(AnimatedMesh, AnObjectIsAliveWhereItsNameSaysSo) {
  GltfFile file("nade_alive");
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
