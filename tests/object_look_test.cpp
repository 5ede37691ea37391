// A user's own files as they are drawn: their pictures, colours and skins.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "nade/draw/stage.h"
#include "support/files.h"
#include "support/gltf_file.h"
#include "support/scratch_folder.h"
#include "support/stage_fixture.h"

namespace nade::draw {
namespace {

/// A user's own objects: a board 20 cm wide, facing +Y.
class StageFiles : public StageTest {
 protected:
  void SetUp() override {
    StageTest::SetUp();
    Image texture = Image::blank(4, 4);
    for (std::size_t i = 0; i < 16; ++i) {
      // The left half red, the right half blue.
      const bool left = i % 4 < 2;
      texture.rgba[4 * i] = left ? 255 : 0;
      texture.rgba[4 * i + 1] = 0;
      texture.rgba[4 * i + 2] = left ? 0 : 255;
      texture.rgba[4 * i + 3] = 255;
    }
    ASSERT_TRUE(save_png(path("board.png"), texture).ok());
  }
  [[nodiscard]] std::string path(const std::string& name) const { return scratch_.path(name); }

  void write_obj(const std::string& name, const std::string& material) {
    std::ofstream(path(name + ".mtl")) << "newmtl board\n" << material;
    std::ofstream(path(name + ".obj"))
        << "mtllib " << std::filesystem::path(name).filename().string() << ".mtl\n"
        << "v -0.1 0 -0.1\nv 0.1 0 -0.1\nv 0.1 0 0.1\n"
           "v -0.1 0 0.1\n"
           "vt 0 1\nvt 1 1\nvt 1 0\nvt 0 0\n"
           "usemtl board\nf 1/1 4/4 3/3\nf 1/1 3/3 2/2\n";
  }

  /// As a .gltf file whose picture is where `image` says.
  void write_gltf(const std::string& name, const nlohmann::json& image) {
    const std::vector<float> numbers{-0.1F, 0,    -0.1F, 0.1F, 0, -0.1F, 0.1F, 0, 0.1F, -0.1F,
                                     0,     0.1F, 0,     0,    1, 0,     1,    1, 0,    1};
    const std::vector<std::uint16_t> indices{0, 3, 2, 0, 2, 1};
    std::ofstream bin(path(name + ".bin"), std::ios::binary);
    bin.write(reinterpret_cast<const char*>(numbers.data()), 80);
    bin.write(reinterpret_cast<const char*>(indices.data()), 12);
    nlohmann::json gltf;
    gltf["asset"]["version"] = "2.0";
    gltf["buffers"] = {{{"uri", name + ".bin"}, {"byteLength", 92}}};
    gltf["bufferViews"] = {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 48}},
                           {{"buffer", 0}, {"byteOffset", 48}, {"byteLength", 32}},
                           {{"buffer", 0}, {"byteOffset", 80}, {"byteLength", 12}}};
    gltf["accessors"] = {
        {{"bufferView", 0},
         {"componentType", 5126},
         {"count", 4},
         {"type", "VEC3"},
         {"min", {-0.1, 0, -0.1}},
         {"max", {0.1, 0, 0.1}}},
        {{"bufferView", 1}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}},
        {{"bufferView", 2}, {"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}}};
    gltf["images"].push_back(image);
    gltf["textures"] = {{{"source", 0}}};
    gltf["materials"] = {{{"pbrMetallicRoughness",
                           {{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0.0}}}}};
    gltf["meshes"] = {{{"primitives",
                        {{{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}},
                          {"indices", 2},
                          {"material", 0}}}}}};
    gltf["nodes"] = {{{"mesh", 0}}};
    gltf["scenes"] = {{{"nodes", {0}}}};
    gltf["scene"] = 0;
    std::ofstream(path(name + ".gltf")) << gltf.dump();
  }

  /// A picture of the object alone from above, +X to the right.
  Image board_picture(const std::string& file) {
    show(path(file));
    return renderer_->picture(stage_->arrange_object(), above(0.5), kWidth, kHeight);
  }

  static void expect_red_left_blue_right(const Image& image) {
    EXPECT_GT(red_share(image, kWidth / 2 - 40, kHeight / 2), 0.7);
    EXPECT_LT(red_share(image, kWidth / 2 + 40, kHeight / 2), 0.4);
  }

  test::ScratchFolder scratch_;
};

std::string base64(const std::string& bytes) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool there = i + k < bytes.size();
      group = group << 8U | (there ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? letters[group >> (18U - 6U * k) & 63U] : '=';
    }
  }
  return text;
}

TEST_F(StageFiles, TextureBesideAGltfFile) {
  write_gltf("outside", {{"uri", "board.png"}});
  expect_red_left_blue_right(board_picture("outside.gltf"));
  EXPECT_TRUE(stage_->warnings().empty());
}

TEST_F(StageFiles, TextureInAGltfFile) {
  const std::string board = test::read_file(path("board.png"));
  write_gltf("inside", {{"uri", "data:image/png;base64," + base64(board)}});
  expect_red_left_blue_right(board_picture("inside.gltf"));
  EXPECT_TRUE(stage_->warnings().empty());
}

TEST_F(StageFiles, TextureOfAnObjFile) {
  write_obj("textured", "Kd 0 0 0\nmap_Kd board.png\n");
  expect_red_left_blue_right(board_picture("textured.obj"));
}

TEST_F(StageFiles, ObjFileBehindAByteOrderMark) {
  write_obj("marked", "Kd 0 0 0\nmap_Kd board.png\n");
  const std::string text = test::read_file(path("marked.obj"));
  test::write_file(path("marked.obj"), "\xEF\xBB\xBF" + text);
  expect_red_left_blue_right(board_picture("marked.obj"));
}

TEST_F(StageFiles, ColorOfAnObjFile) {
  write_obj("plain", "Kd 0.8 0.1 0.1\n");
  const Image image = board_picture("plain.obj");
  EXPECT_GT(red_share(image, kWidth / 2 + 40, kHeight / 2), 0.65);
}

TEST_F(StageFiles, MissingTextureIsSaidAndTheObjectDrawn) {
  write_obj("lost", "Kd 0.8 0.1 0.1\nmap_Kd nowhere.png\n");
  const Image image = board_picture("lost.obj");
  ASSERT_EQ(stage_->warnings().size(), 1u);
  EXPECT_NE(stage_->warnings().front().find("nowhere.png"), std::string::npos);
  EXPECT_GT(red_share(image, kWidth / 2, kHeight / 2), 0.65);
}

TEST_F(StageFiles, TextureOutsideTheFolderIsNotOpened) {
  std::filesystem::create_directory(path("below"));
  write_obj("below/out", "Kd 0.8 0.1 0.1\nmap_Kd ../board.png\n");
  const Image image = board_picture("below/out.obj");
  ASSERT_EQ(stage_->warnings().size(), 1u);
  EXPECT_TRUE(stage_->warnings().front().ends_with("'../board.png' lies outside its folder"))
      << stage_->warnings().front();
  EXPECT_GT(red_share(image, kWidth / 2, kHeight / 2), 0.65);
}

/// Our reader of solids knows spellings that the reader of colours does not.
TEST_F(StageFiles, WhatIsSolidIsDrawn) {
  const std::string ply =
      "ply\rformat ascii 1.0\relement vertex 4\rproperty float x\rproperty float y\r"
      "property float z\relement face 1\rproperty list uchar int vertex_indices\rend_header\r"
      "-0.1 0 -0.1\r-0.1 0 0.1\r0.1 0 0.1\r0.1 0 -0.1\r4 0 1 2 3\r";
  test::write_file(path("board.ply"), ply);
  show(path("board.ply"));
  const DepthMap map =
      renderer_->depths(stage_->object_only(), above(0.5), kWidth, kHeight, Faces::front);
  EXPECT_GT(count_covered(map), 3000u);
}

/// Hundreds of boards in one place, which a software renderer would draw for a minute.
TEST_F(StageFiles, LayersUponLayersAreThinned) {
  std::string text = "OFF\n4 1000 0\n-0.1 0 -0.1\n0.1 0.01 -0.1\n0.1 0 0.1\n-0.1 0.01 0.1\n";
  for (int i = 0; i < 1000; ++i) text += "3 0 3 2\n";
  test::write_file(path("layers.off"), text);
  show(path("layers.off"));
  ASSERT_FALSE(stage_->warnings().empty());
  EXPECT_NE(stage_->warnings().back().find("layers: drawn with one in"), std::string::npos);
  const DepthMap map =
      renderer_->depths(stage_->object_only(), above(0.5), kWidth, kHeight, Faces::front);
  EXPECT_GT(count_covered(map), 1000u);
}

TEST_F(StageFiles, MissingTextureOfAGltfFileIsSaidAndTheObjectDrawn) {
  write_gltf("lost", {{"uri", "nowhere.png"}});
  show(path("lost.gltf"));
  ASSERT_EQ(stage_->warnings().size(), 1u);
  EXPECT_NE(stage_->warnings().front().find("nowhere.png"), std::string::npos);
  const DepthMap map =
      renderer_->depths(stage_->object_only(), above(0.5), kWidth, kHeight, Faces::front);
  EXPECT_GT(count_covered(map), 3000u);
}

/// A skin stands where its joints are, also before anything moves.
TEST_F(StageFiles, SkinnedFileIsDrawnWhereItIsFelt) {
  test::GltfFile file("nade_drawn_skin");
  file.gltf["nodes"] = {{{"mesh", 0}, {"skin", 0}}, {{"translation", {0, 0.3, 0}}}};
  file.gltf["scenes"][0]["nodes"] = {0, 1};
  file.gltf["skins"] = {{{"joints", {1}}}};
  nlohmann::json& attributes = file.gltf["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = file.add_bytes(std::vector<std::uint8_t>(12, 0), 5121, "VEC4", 3);
  attributes["WEIGHTS_0"] = file.add({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  attributes["NORMAL"] = file.add({0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3");
  show(file.write());
  const auto felt = object().first_hit({{0.1, 2.0, -0.1}, -Vec3::UnitY(), 3.0});
  ASSERT_TRUE(felt.has_value());
  EXPECT_NEAR(felt->distance, 1.7, 1e-6);
  const DepthMap drawn =
      renderer_->depths(stage_->object_only(), above(2.0), kWidth, kHeight, Faces::front);
  EXPECT_NEAR(*std::min_element(drawn.depth_m.begin(), drawn.depth_m.end()), 1.7, 1e-3);
}

TEST_F(StageFiles, MeshesWithoutMaterialsAreDrawn) {
  std::ofstream(path("board.off"))
      << "OFF\n4 2 0\n-0.1 0 -0.1\n0.1 0 -0.1\n0.1 0 0.1\n-0.1 0 0.1\n3 0 3 2\n3 0 2 1\n";
  show(path("board.off"));
  const DepthMap map =
      renderer_->depths(stage_->object_only(), above(0.5), kWidth, kHeight, Faces::front);
  EXPECT_GT(count_covered(map), 3000u);
}

}  // namespace
}  // namespace nade::draw
