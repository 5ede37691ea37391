// What of a glTF file `load_mesh` reads beyond a list of triangles.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "nade/io/mesh_file.h"
#include "support/gltf_file.h"

namespace nade {
namespace {

using Json = nlohmann::json;
using test::GltfFile;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

MeshFile loaded(GltfFile& file) { return load_mesh(file.write()).value(); }

Json& primitive_of(GltfFile& file) { return file.gltf["meshes"][0]["primitives"][0]; }

void expect_at(const Eigen::Vector3f& found, const Eigen::Vector3f& expected) {
  EXPECT_LT((found - expected).norm(), 1e-6F) << found.transpose();
}

TEST(GltfMesh, StripsFansAndTrianglesWithoutIndices) {
  GltfFile file("nade_modes");
  Json& primitive = primitive_of(file);
  primitive["attributes"]["POSITION"] =
      file.add({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, "VEC3");
  primitive.erase("indices");
  EXPECT_EQ(loaded(file).soup.triangles, (Triangles{{0, 1, 2}}));
  primitive["mode"] = 5;
  EXPECT_EQ(loaded(file).soup.triangles, (Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
  primitive["mode"] = 6;
  EXPECT_EQ(loaded(file).soup.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
  primitive["mode"] = 1;
  const auto lines = load_mesh(file.write());
  ASSERT_FALSE(lines.ok());
  EXPECT_NE(lines.error().message.find("expected triangles, found none"), std::string::npos);
}

TEST(GltfMesh, WithoutASceneEveryNodeIsShown) {
  GltfFile file("nade_no_scene");
  file.gltf.erase("scene");
  file.gltf.erase("scenes");
  file.gltf["nodes"] = Json::parse(R"([{"mesh":0},{"mesh":0,"translation":[0,3,0]}])");
  const MeshFile mesh = loaded(file);
  ASSERT_EQ(mesh.soup.vertices.size(), 6U);
  expect_at(mesh.soup.vertices[3], {0, 3, 0});
}

TEST(GltfMesh, PlacesAreThoseOfTheSceneInItsOrder) {
  GltfFile file("nade_places");
  file.gltf["nodes"] =
      Json::parse(R"([{"mesh":0},{"name":"place-b"},{"name":"place-hidden"},{"name":"place-a"}])");
  file.gltf["scenes"][0]["nodes"] = {0, 3, 1};
  const MeshFile mesh = loaded(file);
  ASSERT_EQ(mesh.places.size(), 2U);
  EXPECT_EQ(mesh.places[0].name, "a");
  EXPECT_EQ(mesh.places[1].name, "b");
}

/// KHR_mesh_quantization.
TEST(GltfMesh, WholeNumbers) {
  GltfFile file("nade_whole");
  Json& position = primitive_of(file)["attributes"]["POSITION"];
  // A row is 8 bytes: three numbers and what aligns the next.
  position = file.add_bytes(std::vector<std::int16_t>{0, 0, 0, 0, 300, 0, 0, 0, 0, -7, 0, 0}, 5122,
                            "VEC3", 3);
  file.gltf["bufferViews"].back()["byteStride"] = 8;
  expect_at(loaded(file).soup.vertices[1], {300, 0, 0});
  file.gltf["accessors"].back()["normalized"] = true;
  expect_at(loaded(file).soup.vertices[2], {0, -7.0F / 32767.0F, 0});
}

TEST(GltfMesh, SparseNumbers) {
  GltfFile file("nade_sparse");
  const int places = file.add_bytes(std::vector<std::uint16_t>{0, 2}, 5123, "SCALAR", 2);
  const int values = file.add({0, 5, 0, 6, 0, 0}, "VEC3");
  Json& position = file.gltf["accessors"][0];
  position["sparse"] = {{"count", 2},
                        {"indices", {{"bufferView", places}, {"componentType", 5123}}},
                        {"values", {{"bufferView", values}}}};
  const MeshFile mesh = loaded(file);
  expect_at(mesh.soup.vertices[0], {0, 5, 0});
  expect_at(mesh.soup.vertices[1], {1, 0, 0});
  expect_at(mesh.soup.vertices[2], {6, 0, 0});
  position.erase("bufferView");
  expect_at(loaded(file).soup.vertices[1], {0, 0, 0});
  position["sparse"]["count"] = 3;
  const auto beyond = load_mesh(file.write());
  ASSERT_FALSE(beyond.ok());
  EXPECT_NE(beyond.error().message.find("POSITION (accessor 0): "), std::string::npos);
}

/// At rest, the bones and the weights are where the file leaves them.
TEST(GltfMesh, IsShownAsItStandsBeforeAnyAnimation) {
  GltfFile file("nade_rest");
  file.gltf["nodes"] =
      Json::parse(R"([{"mesh":0,"skin":0,"translation":[9,9,9]},{"translation":[0,1,0]}])");
  file.gltf["scenes"][0]["nodes"] = {0, 1};
  file.gltf["skins"] = {{{"joints", {1}}}};
  Json& primitive = primitive_of(file);
  primitive["targets"] = {{{"POSITION", file.add({2, 0, 0, 2, 0, 0, 2, 0, 0}, "VEC3")}}};
  file.gltf["meshes"][0]["weights"] = {0.5};
  Json& attributes = primitive["attributes"];
  attributes["JOINTS_0"] = file.add_bytes(std::vector<std::uint8_t>(12, 0), 5121, "VEC4", 3);
  // The last vertex has no weights: it goes with its first bone.
  attributes["WEIGHTS_0"] = file.add({1, 0, 0, 0, 0.5F, 0.5F, 0, 0, 0, 0, 0, 0}, "VEC4");
  const MeshFile mesh = loaded(file);
  expect_at(mesh.soup.vertices[0], {1, 1, 0});
  expect_at(mesh.soup.vertices[1], {2, 1, 0});
  expect_at(mesh.soup.vertices[2], {1, 1, -1});
}

/// tinygltf takes what is malformed for left out.
TEST(GltfMesh, WhatIsMalformedIsNamed) {
  struct Case {
    std::string patch;  // RFC 7396
    std::string sentence;
  };
  const std::vector<Case> cases{
      {R"({"asset":{"version":"3.0"}})", R"(asset: version: expected "2.0", found "3.0")"},
      {R"({"asset":null})", R"(asset: version: expected "2.0", found none)"},
      {R"({"extensionsRequired":["FOO_bar"]})",
       "requires the extension FOO_bar, which is not read"},
      {R"({"nodes":[{"mesh":0,"translation":"x"}]})",
       "node 0: translation: expected 3 numbers, found \"x\""},
      {R"({"nodes":[{"mesh":0,"scale":[1,1]}]})", "node 0: scale: expected 3 numbers, found 2"},
      {R"({"nodes":[{"mesh":0,"matrix":[1,1]}]})", "node 0: matrix: expected 16 numbers, found 2"},
      {R"({"nodes":[{"mesh":0,"children":"x"}]})",
       "node 0: children: expected the numbers of nodes, found \"x\""},
      {R"({"nodes":[{"mesh":0.5}]})", "node 0: mesh: expected a whole number from 0 on, found 0.5"},
      {R"({"bufferViews":[{"byteOffset":-48}]})",
       "buffer view 0: byteOffset: expected a whole number from 0 on, found -48"},
      {R"({"accessors":[{"sparse":{"values":{"byteOffset":"1"}}}]})",
       "accessor 0: sparse: values: byteOffset: expected a whole number from 0 on, found \"1\""}};
  for (const auto& [patch, sentence] : cases) {
    GltfFile file("nade_malformed");
    file.gltf.merge_patch(Json::parse(patch));
    const std::string& path = file.write();
    const auto mesh = load_mesh(path);
    ASSERT_FALSE(mesh.ok()) << patch;
    EXPECT_EQ(mesh.error().message, path + ": " + sentence);
  }
  GltfFile looks("nade_looks");
  looks.gltf["extensionsRequired"] = {"KHR_mesh_quantization", "KHR_materials_unlit"};
  EXPECT_TRUE(load_mesh(looks.write()).ok());
}

TEST(GltfMesh, CompressedFilesAreRefusedByName) {
  GltfFile file("nade_compressed");
  file.gltf["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  const auto mesh = load_mesh(file.write());
  ASSERT_FALSE(mesh.ok());
  EXPECT_TRUE(mesh.error().message.ends_with(
      "compressed by KHR_draco_mesh_compression, which is not read"));
}

TEST(GltfMesh, OneMeshNamedWithoutEnd) {
  GltfFile file("nade_many");
  Json nodes = Json::array();
  Json children = Json::array();
  for (int i = 0; i < 100'001; ++i) {
    nodes.push_back({{"mesh", 0}});
    children.push_back(i);
  }
  file.gltf["nodes"] = nodes;
  file.gltf["scenes"][0]["nodes"] = children;
  const auto mesh = load_mesh(file.write());
  ASSERT_FALSE(mesh.ok());
  EXPECT_NE(mesh.error().message.find("expected at most 100000 parts"), std::string::npos);
}

}  // namespace
}  // namespace nade
