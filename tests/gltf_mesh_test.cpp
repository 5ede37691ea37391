// What of a glTF file `load_mesh` reads beyond a list of triangles.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
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

void expect_refused(GltfFile& file, const std::string& part) {
  const auto mesh = load_mesh(file.write());
  ASSERT_FALSE(mesh.ok()) << "expected: " << part;
  EXPECT_NE(mesh.error().message.find(part), std::string::npos) << mesh.error().message;
}

std::string percent_of(int byte) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  const auto value = static_cast<std::size_t>(byte);
  return {'%', kDigits[value / 16], kDigits[value % 16]};
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
  expect_refused(file, "compressed by KHR_draco_mesh_compression, which is not read");
  file.gltf.erase("extensionsRequired");
  file.gltf["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  primitive_of(file)["extensions"] = {{"KHR_draco_mesh_compression", {{"bufferView", 0}}}};
  EXPECT_EQ(loaded(file).soup.triangles.size(), 1U) << "the plain form is there too";
  for (Json& accessor : file.gltf["accessors"]) accessor.erase("bufferView");
  expect_refused(file, "compressed by KHR_draco_mesh_compression, which is not read");
}

TEST(GltfMesh, ExtensionsThatLeaveTheShapeAreAccepted) {
  GltfFile file("nade_shapeless");
  for (const char* name :
       {"KHR_node_visibility", "KHR_lights_punctual", "EXT_lights_image_based",
        "KHR_animation_pointer", "KHR_materials_unlit", "EXT_texture_webp", "VRMC_vrm"}) {
    file.gltf["extensionsRequired"] = nlohmann::json::array({name});
    EXPECT_TRUE(load_mesh(file.write()).ok()) << name;
  }
  file.gltf["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  expect_refused(file, "requires the extension EXT_mesh_gpu_instancing, which is not read");
}

TEST(GltfMesh, ARepeatedNodeIsThereOnceAndThatIsSaid) {
  GltfFile file("nade_repeated");
  file.gltf["nodes"][0]["name"] = "leaf";
  file.gltf["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = 0;
  file.gltf["extensionsUsed"] = nlohmann::json::array({"EXT_mesh_gpu_instancing"});
  const auto mesh = load_mesh(file.write());
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->soup.triangles.size(), 1U);
  ASSERT_EQ(mesh->warnings.size(), 1U);
  EXPECT_TRUE(mesh->warnings[0].ends_with(
      "node 'leaf' is there once: EXT_mesh_gpu_instancing, which repeats it, is not read"))
      << mesh->warnings[0];
}

TEST(GltfMesh, HiddenNodesAreNotSolid) {
  GltfFile file("nade_hidden");
  file.gltf["nodes"] = Json::parse(R"([{"mesh":0},
    {"children":[2],"extensions":{"KHR_node_visibility":{"visible":false}}},{"mesh":0},
    {"mesh":0,"extensions":{"KHR_node_visibility":{"visible":true}}}])");
  file.gltf["scenes"][0]["nodes"] = {0, 1, 3};
  EXPECT_EQ(loaded(file).soup.triangles.size(), 2U);
}

TEST(GltfMesh, MoreThanFourBonesCarryAVertex) {
  GltfFile file("nade_eight");
  file.gltf["nodes"] = Json::parse(R"([{"mesh":0,"skin":0},{},{"translation":[0,4,0]}])");
  file.gltf["scenes"][0]["nodes"] = {0, 1, 2};
  file.gltf["skins"] = {{{"joints", {1, 2}}}};
  Json& attributes = primitive_of(file)["attributes"];
  attributes["JOINTS_0"] = file.add_bytes(std::vector<std::uint8_t>(12, 0), 5121, "VEC4", 3);
  attributes["JOINTS_1"] = file.add_bytes(std::vector<std::uint8_t>(12, 1), 5121, "VEC4", 3);
  // A weight may be rounded to below 0.
  attributes["WEIGHTS_0"] = file.add({0.25F, -0.001F, 0, 0, 1, 0, 0, 0, 0.5F, 0, 0, 0}, "VEC4");
  attributes["WEIGHTS_1"] = file.add({0.25F, 0.5F, 0, 0, 0, 0, 0, 0, 0.5F, 0, 0, 0}, "VEC4");
  const MeshFile mesh = loaded(file);
  expect_at(mesh.soup.vertices[0], {0, 3, 0});
  expect_at(mesh.soup.vertices[1], {1, 0, 0});
  expect_at(mesh.soup.vertices[2], {0, 2, -1});
  attributes["WEIGHTS_1"] = file.add({-0.5F, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
  expect_refused(file, "WEIGHTS_1 of vertex 0: expected 0 to 1");
}

TEST(GltfMesh, MirroredBonesTurnTheirTriangles) {
  GltfFile file("nade_mirrored_bones");
  file.gltf["nodes"] = Json::parse(R"([{"mesh":0,"skin":0},{"scale":[-1,1,1]}])");
  file.gltf["scenes"][0]["nodes"] = {0, 1};
  file.gltf["skins"] = {{{"joints", {1}}}};
  Json& attributes = primitive_of(file)["attributes"];
  attributes["JOINTS_0"] = file.add_bytes(std::vector<std::uint8_t>(12, 0), 5121, "VEC4", 3);
  attributes["WEIGHTS_0"] = file.add({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  EXPECT_EQ(loaded(file).soup.triangles, (Triangles{{0, 2, 1}}));
  file.gltf["nodes"][1]["scale"] = {-1, -1, 1};
  EXPECT_EQ(loaded(file).soup.triangles, (Triangles{{0, 1, 2}}));
}

TEST(GltfMesh, DataUrisOfEveryType) {
  // The corners 0 0 0, 1 0 0 and 0 0 -1, and the three indices.
  const std::string base64 = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIC/AAABAAIA";
  std::string percents;
  for (const int byte : {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,   128, 63, 0, 0, 0, 0, 0,
                         0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 128, 191, 0,  0, 1, 0, 2, 0}) {
    percents += percent_of(byte);
  }
  for (const std::string& uri :
       {"data:application/octet-stream;charset=utf-8;base64," + base64, "data:;base64," + base64,
        "data:model/gltf-buffer;base64," + base64, "data:application/gltf-buffer," + percents}) {
    GltfFile file("nade_data");
    const std::string& path = file.write();
    file.gltf["buffers"][0] = {{"byteLength", 42}, {"uri", uri}};
    std::ofstream(path) << file.gltf.dump();
    const auto mesh = load_mesh(path);
    ASSERT_TRUE(mesh.ok()) << mesh.error().message;
    expect_at(mesh->soup.vertices[1], {1, 0, 0});
  }
  GltfFile file("nade_no_data");
  const std::string& path = file.write();
  file.gltf["buffers"][0] = {{"byteLength", 42}, {"uri", "data:;base64," + std::string(5000, '!')}};
  std::ofstream(path) << file.gltf.dump();
  const auto mesh = load_mesh(path);
  ASSERT_FALSE(mesh.ok());
  EXPECT_LT(mesh.error().message.size(), path.size() + 200);
}

/// Every file that a glTF file names is below its own folder.
TEST(GltfMesh, NamesNoFileOutsideItsFolder) {
  namespace fs = std::filesystem;
  const fs::path outer = fs::path(testing::TempDir()) / "nade_outer";
  const fs::path inner = outer / "inner";
  fs::remove_all(outer);
  fs::create_directories(inner / "parts");
  GltfFile file("nade_outer/inner/model");
  const std::string path = file.write();
  const fs::path bytes = path + ".bin";
  fs::copy_file(bytes, outer / "out.bin");
  fs::copy_file(bytes, inner / "parts" / "in.bin");
  fs::copy_file(bytes, inner / "a b.bin");
  fs::create_symlink(outer / "out.bin", inner / "link.bin");
  fs::create_symlink(outer, inner / "folder");
  fs::create_symlink(bytes, inner / "own.bin");
  const auto load_with = [&](const std::string& uri) {
    file.gltf["buffers"][0]["uri"] = uri;
    std::ofstream(path) << file.gltf.dump();
    return load_mesh(path);
  };
  for (const std::string& uri :
       {std::string("../out.bin"), std::string("%2e%2e/out.bin"), std::string("..%2Fout.bin"),
        std::string("parts/../../out.bin"), std::string("..\\out.bin"),
        (outer / "out.bin").string(), bytes.string(), "file://" + bytes.string(),
        std::string("link.bin"), std::string("folder/out.bin"), std::string("http://x/a.bin")}) {
    const auto mesh = load_with(uri);
    ASSERT_FALSE(mesh.ok()) << uri;
    EXPECT_TRUE(mesh.error().message.ends_with("below the glTF file's own folder"))
        << mesh.error().message;
  }
  for (const char* uri : {"parts/in.bin", "./parts/in.bin", "a%20b.bin", "a b.bin", "own.bin"}) {
    const auto mesh = load_with(uri);
    EXPECT_TRUE(mesh.ok()) << mesh.error().message;
  }
  fs::remove_all(outer);
}

TEST(GltfMesh, NestedWithoutEnd) {
  GltfFile file("nade_nested");
  const std::string& path = file.write();
  const std::string text = file.gltf.dump();
  for (const std::size_t depth : {65U, 100'000U}) {
    const std::string nest = std::string(depth, '[') + std::string(depth, ']');
    std::ofstream(path) << text.substr(0, text.size() - 1) << ",\"extras\":" << nest << "}";
    const auto mesh = load_mesh(path);
    ASSERT_FALSE(mesh.ok());
    EXPECT_TRUE(
        mesh.error().message.ends_with("expected values nested at most 64 deep, found more"));
  }
}

/// A few bytes that ask for much: rows of zeros, morph targets, instances, animations.
TEST(GltfMesh, HasABudgetOfNumbers) {
  const std::string sentence = "expected meshes and animations of at most 4";
  GltfFile zeros("nade_zeros");
  zeros.gltf["accessors"][0]["count"] = 100'000'000;
  zeros.gltf["accessors"][0].erase("bufferView");
  expect_refused(zeros, sentence);
  zeros.gltf["accessors"][0]["count"] = 1'000'000;
  Json& targets = primitive_of(zeros)["targets"];
  for (int i = 0; i < 3; ++i) targets.push_back({{"POSITION", 0}});
  expect_refused(zeros, sentence);

  GltfFile nodes("nade_instances");
  Json& accessor = nodes.gltf["accessors"][0];
  accessor["count"] = 10'000;
  accessor.erase("bufferView");
  accessor["sparse"] = {{"count", 1},
                        {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
                        {"values", {{"bufferView", 0}}}};
  for (int i = 1; i < 1000; ++i) nodes.gltf["nodes"].push_back({{"mesh", 0}});
  expect_refused(nodes, sentence);
  nodes.gltf["nodes"] = Json::array({{{"mesh", 0}}});
  EXPECT_TRUE(load_mesh(nodes.write()).ok());

  GltfFile channels("nade_channels");
  channels.animate(0, "translation", "LINEAR", {0, 1}, {0, 0, 0, 0, 1, 0});
  Json& animation = channels.gltf["animations"][0];
  channels.gltf["accessors"].back()["count"] = 1'000'000;
  for (int i = 0; i < 3; ++i) animation["channels"].push_back(animation["channels"][0]);
  expect_refused(channels, sentence);

  GltfFile elements("nade_elements");
  elements.gltf["scenes"] = Json::array();
  for (int i = 0; i < 200'000; ++i) elements.gltf["scenes"].push_back(Json::object());
  expect_refused(elements, "scenes: expected at most 1");
}

TEST(GltfMesh, OneFileNamedByManyBuffers) {
  GltfFile file("nade_buffers");
  const std::string& path = file.write();
  const Json buffer = file.gltf["buffers"][0];
  for (int i = 0; i < 16; ++i) file.gltf["buffers"].push_back(buffer);
  std::ofstream(path) << file.gltf.dump();
  const auto mesh = load_mesh(path);
  ASSERT_FALSE(mesh.ok());
  EXPECT_TRUE(mesh.error().message.ends_with(
      "buffer 16: expected at most 16 buffers of one file, found more"));
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
