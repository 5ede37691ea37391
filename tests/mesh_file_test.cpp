#include "nade/io/mesh_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "support/meshes.h"
#include "support/random.h"

namespace nade {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

template <class Value>
void put(std::string& bytes, Value value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string off_text(const TriangleSoup& soup) {
  std::ostringstream out;
  out << "OFF\n# made by a test\n"
      << soup.vertices.size() << ' ' << soup.triangles.size() << " 0\n";
  for (const auto& v : soup.vertices) out << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
  for (const auto& [a, b, c] : soup.triangles) out << "3 " << a << ' ' << b << ' ' << c << '\n';
  return out.str();
}

std::string obj_text(const TriangleSoup& soup) {
  std::ostringstream out;
  for (const auto& v : soup.vertices) out << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
  for (const auto& [a, b, c] : soup.triangles) {
    out << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
  }
  return out.str();
}

std::string ply_header(const TriangleSoup& soup, const std::string& format) {
  return "ply\nformat " + format + " 1.0\ncomment a test\nelement vertex " +
         std::to_string(soup.vertices.size()) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
         "element face " +
         std::to_string(soup.triangles.size()) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string ply_text(const TriangleSoup& soup) {
  std::ostringstream out;
  out << ply_header(soup, "ascii");
  for (const auto& v : soup.vertices) out << v.x() << ' ' << v.y() << ' ' << v.z() << " 255\n";
  for (const auto& [a, b, c] : soup.triangles) out << "3 " << a << ' ' << b << ' ' << c << '\n';
  return out.str();
}

std::string ply_binary(const TriangleSoup& soup) {
  std::string out = ply_header(soup, "binary_little_endian");
  for (const auto& v : soup.vertices) {
    for (int axis = 0; axis < 3; ++axis) put(out, v[axis]);
    put(out, std::uint8_t{255});
  }
  for (const auto& triangle : soup.triangles) {
    put(out, std::uint8_t{3});
    for (const std::uint32_t vertex : triangle) put(out, vertex);
  }
  return out;
}

std::string stl_text(const TriangleSoup& soup) {
  std::ostringstream out;
  out << "solid box\n";
  for (const auto& triangle : soup.triangles) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t i : triangle) {
      const auto& v = soup.vertices[i];
      out << "vertex " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
    }
    out << "endloop\nendfacet\n";
  }
  out << "endsolid box\n";
  return out.str();
}

std::string stl_binary(const TriangleSoup& soup) {
  std::string out(80, 'x');
  put(out, static_cast<std::uint32_t>(soup.triangles.size()));
  for (const auto& triangle : soup.triangles) {
    for (int i = 0; i < 3; ++i) put(out, 0.0F);
    for (const std::uint32_t i : triangle) {
      for (int axis = 0; axis < 3; ++axis) put(out, soup.vertices[i][axis]);
    }
    put(out, std::uint16_t{0});
  }
  return out;
}

std::string glb_binary(const TriangleSoup& soup, const json& nodes) {
  std::string data;
  for (const auto& v : soup.vertices) {
    for (int axis = 0; axis < 3; ++axis) put(data, v[axis]);
  }
  const std::size_t split = data.size();
  for (const auto& triangle : soup.triangles) {
    for (const std::uint32_t vertex : triangle) put(data, vertex);
  }
  const json document{
      {"asset", {{"version", "2.0"}}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", nodes},
      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
      {"accessors",
       {{{"bufferView", 0},
         {"componentType", 5126},
         {"count", soup.vertices.size()},
         {"type", "VEC3"},
         {"min", {-1, -1, -1}},
         {"max", {1, 1, 1}}},
        {{"bufferView", 1},
         {"componentType", 5125},
         {"count", 3 * soup.triangles.size()},
         {"type", "SCALAR"}}}},
      {"bufferViews",
       {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", split}},
        {{"buffer", 0}, {"byteOffset", split}, {"byteLength", data.size() - split}}}},
      {"buffers", {{{"byteLength", data.size()}}}}};
  std::string text = document.dump();
  text.append((4 - text.size() % 4) % 4, ' ');
  std::string out = "glTF";
  put(out, std::uint32_t{2});
  put(out, static_cast<std::uint32_t>(28 + text.size() + data.size()));
  put(out, static_cast<std::uint32_t>(text.size()));
  out += "JSON" + text;
  put(out, static_cast<std::uint32_t>(data.size()));
  out += "BIN";
  out += '\0';
  return out + data;
}

json plain_nodes() { return {{{"mesh", 0}}}; }

class MeshFiles : public ::testing::Test {
 protected:
  MeshFiles() { fs::create_directories(folder_); }
  ~MeshFiles() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  std::string write(const std::string& name, const std::string& content) {
    const std::string path = (folder_ / name).string();
    std::ofstream(path, std::ios::binary) << content;
    return path;
  }
  /// The error's sentence without the folder; "" where it loads.
  std::string message(const std::string& path) {
    const Result<MeshFile> file = load_mesh(path);
    if (file.ok()) return "";
    const std::string text = file.error().message;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    EXPECT_TRUE(text.starts_with(path + ": ")) << text;
    return fs::path(path).filename().string() + text.substr(path.size());
  }

  struct Sample {
    std::string name;
    std::string content;
  };
  static std::vector<Sample> samples(const TriangleSoup& soup) {
    return {{"a.off", off_text(soup)},
            {"b.obj", obj_text(soup)},
            {"c.ply", ply_text(soup)},
            {"d.ply", ply_binary(soup)},
            {"e.stl", stl_text(soup)},
            {"f.stl", stl_binary(soup)},
            {"g.glb", glb_binary(soup, plain_nodes())}};
  }

  fs::path folder_ =
      fs::temp_directory_path() / ("nade_mesh_file_test_" + std::to_string(::getpid()));
};

TEST_F(MeshFiles, EveryFormatHoldsTheSameBox) {
  const TriangleSoup box = test::box_mesh({0.1F, 0.2F, 0.3F});
  for (const auto& [name, content] : samples(box)) {
    const auto file = load_mesh(write(name, content));
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_EQ(file->soup.triangles.size(), 12U) << name;
    const auto mesh = MeshSurface::build(file->soup, name);
    ASSERT_TRUE(mesh.ok()) << name;
    EXPECT_EQ((*mesh)->report().solid, MeshSolid::closed) << name;
    SurfaceHint hint;
    EXPECT_NEAR((*mesh)->closest_point({0.0, 0.0, 0.25}, 1.0, hint)->signed_distance, -0.05, 1e-7);
  }
}

TEST_F(MeshFiles, EndingsInCapitals) {
  EXPECT_EQ(message(write("A.OFF", off_text(test::box_mesh({1, 1, 1})))), "");
}

TEST_F(MeshFiles, PolygonsBecomeTriangles) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  EXPECT_EQ(load_mesh(write("quad.obj", corners + "f 1 2 3 4\n"))->soup.triangles.size(), 2U);
  const auto off =
      load_mesh(write("quad.off", "OFF 4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 0\n"));
  EXPECT_EQ(off->soup.triangles.size(), 2U);
  // The corner at (0.1, 0.1) points inward: cut there, or a triangle lies outside.
  const auto dart =
      load_mesh(write("dart.off", "OFF 4 1 0\n0 0 0\n1 0 0\n0.1 0.1 0\n0 1 0\n4 1 2 3 0\n"));
  ASSERT_TRUE(dart.ok());
  for (const auto& [a, b, c] : dart->soup.triangles) {
    const auto& v = dart->soup.vertices;
    EXPECT_GT((v[b] - v[a]).cross(v[c] - v[a]).z(), 0.0F);
  }
}

TEST_F(MeshFiles, NodesMoveTurnAndMirror) {
  const json nodes{{{"children", {1, 2, 3}}, {"translation", {1, 2, 3}}},
                   {{"mesh", 0}},
                   {{"mesh", 0}, {"translation", {5, 0, 0}}, {"scale", {-1, 1, 1}}},
                   {{"name", "place-back"},
                    {"translation", {0, 0.5, 0}},
                    {"rotation", {0, 0.70710678, 0, 0.70710678}},
                    {"scale", {2, 3, 4}}}};
  const auto file =
      load_mesh(write("scene.glb", glb_binary(test::box_mesh({.1F, .1F, .1F}), nodes)));
  ASSERT_TRUE(file.ok()) << file.error().message;
  const auto mesh = MeshSurface::build(file->soup, "scene");
  EXPECT_EQ((*mesh)->report().triangles_used, 24U);
  EXPECT_EQ((*mesh)->report().triangles_turned, 0U);
  SurfaceHint hint;
  EXPECT_NEAR((*mesh)->closest_point({1, 2, 3}, 1.0, hint)->signed_distance, -0.1, 1e-6);
  EXPECT_NEAR((*mesh)->closest_point({6, 2, 3}, 1.0, hint)->signed_distance, -0.1, 1e-6);
  ASSERT_EQ(file->places.size(), 1U);
  EXPECT_EQ(file->places[0].name, "back");
  EXPECT_NEAR((file->places[0].pose.position - Vec3(1, 2.5, 3)).norm(), 0.0, 1e-6);
  EXPECT_NEAR(file->places[0].pose.rotation.norm(), 1.0, 1e-12);
  EXPECT_NEAR((file->places[0].pose.rotation * -Vec3::UnitZ() + Vec3::UnitX()).norm(), 0.0, 1e-6);
}

/// However it is written, no vertex is lost, and so none counted wrongly.
TEST_F(MeshFiles, SpellingsOfObj) {
  const std::string rest = "v 1 0 -1\nv 1 0 1\nv -1 0 1\nv 5 5 5\n";
  const std::string face = "f 4 3 2 1\n";
  const std::vector<std::string> spellings{
      "\xEF\xBB\xBFv -1 0 -1\n" + rest + face,
      face + "v -1 0 -1\n" + rest,
      "  v -1. +.0 -.1e1 # a corner\n" + rest + "\t f 4 3 2 1\n",
      "# a path\\\nv\t-1 0\\\r\n-1\r\n" + rest + "f 4 3 \\\n2 1\n",
      "v -1 0 -1\rv 1 0 -1\rv 1 0 1\rv -1 0 1\rf 4 3 2 1\r",
      "v -2 0 -2 2\nv 1 0 -1 1 1\nv 1 0 1 .5 .5 .5\nv -1 0 1 1 1 1 1\n" + face,
      "v -1 0 -1\n" + rest + "vt .5 .5\nvn 0 1 0\nf -2/1/1 -3//1 -4/1 1/\n",
      "v -1 0 -1\ncstype bezier\n" + rest + "end\nl 1 9\np 0\nV x\n" + face};
  for (const std::string& spelling : spellings) {
    const auto file = load_mesh(write("a.obj", spelling));
    ASSERT_TRUE(file.ok()) << file.error().message;
    const auto mesh = MeshSurface::build(file->soup, "a.obj");
    ASSERT_TRUE(mesh.ok()) << spelling;
    SurfaceHint hint;
    for (const Vec3& corner : {Vec3(-1, 0, -1), Vec3(1, 0, -1), Vec3(1, 0, 1), Vec3(-1, 0, 1)}) {
      EXPECT_NEAR((*mesh)->closest_point(corner, 1.0, hint)->signed_distance, 0.0, 1e-6);
    }
    EXPECT_EQ(file->soup.triangles.size(), 2U) << spelling;
  }
}

TEST_F(MeshFiles, WrongLinesOfObjAreNamed) {
  const std::string corners = "v -1 0 -1\nv 1 0 -1\nv 1 0 1\n\nv -1 0 1\n";
  const std::vector<Sample> cases{
      {"v -1 0", "line 6: v: expected 3 numbers, found 2"},
      {"v -1 0 abc", "line 6: v: expected a number, found 'abc'"},
      {"v -1,0 -1 1", "line 6: v: expected a number, found '-1,0'"},
      {"v 1 1 1 0", "line 6: v: expected a weight other than 0, found 0"},
      {"f 1 2 5", "line 6: expected vertices up to 4, found 5"},
      {"f -1 -2 -9", "line 6: expected vertices up to 4, found -9"},
      {"f 0 1 2", "line 6: f: expected the numbers of vertices, from 1 on, found '0'"},
      {"f 1.5 2 3", "line 6: f: expected the numbers of vertices, from 1 on, found '1.5'"},
      {"f 1/1/1/1 2 3", "line 6: f: expected the numbers of vertices, from 1 on, found '1/1/1/1'"},
      {"f 1 2 99999999999999999999",
       "line 6: f: expected the numbers of vertices, from 1 on, found '99999999999999999999'"}};
  for (const auto& [line, sentence] : cases) {
    EXPECT_EQ(message(write("a.obj", corners + line + "\n")), "a.obj: " + sentence);
  }
}

TEST_F(MeshFiles, SaysWhatIsWrong) {
  EXPECT_EQ(message((folder_ / "missing.obj").string()), "missing.obj: no such file");
  fs::create_directories(folder_ / "folder.obj");
  EXPECT_EQ(message((folder_ / "folder.obj").string()),
            "folder.obj: expected a mesh file, found a directory");
  EXPECT_EQ(message(write("mesh.xyz", "0")),
            "mesh.xyz: expected a mesh file ending in .glb .gltf .obj .stl .ply or .off");
  for (const std::string ending : {"glb", "gltf", "obj", "stl", "ply", "off"}) {
    EXPECT_EQ(message(write("empty." + ending, "")),
              "empty." + ending + ": expected a mesh, found an empty file");
    EXPECT_NE(message(write("words." + ending, "hello\nworld\n")), "");
  }
  const TriangleSoup box = test::box_mesh({1, 1, 1});
  EXPECT_EQ(message(write("short.off", off_text(box).substr(0, 60))),
            "short.off: line 8: expected a coordinate of vertex 4 of 8, found the end of the file");
  EXPECT_EQ(
      message(write("short.stl", stl_binary(box).substr(0, 300))),
      "short.stl: expected 'solid', or 684 bytes for the 12 triangles of its header, found 300 "
      "bytes");
  EXPECT_EQ(message(write("words.glb", "{\n  \"asset\": oh")),
            "words.glb: not a readable glTF file: line 2, column 12: expected valid JSON");
  const std::string glb = glb_binary(box, plain_nodes());
  EXPECT_EQ(message(write("version.glb", "glTF\x09" + glb.substr(5))),
            "version.glb: expected version 2 of the .glb form, found 9");
  EXPECT_EQ(message(write("short.glb", glb.substr(0, 300))),
            "short.glb: expected " + std::to_string(glb.size()) + " bytes, found 300");
}

TEST_F(MeshFiles, NothingIsLeftOutBehindTheEnd) {
  const TriangleSoup box = test::box_mesh({1, 1, 1});
  EXPECT_EQ(message(write("more.off", off_text(box) + "3 0 1 2\n")),
            "more.off: line 24: expected the end of the file, found '3'");
  EXPECT_EQ(message(write("more.ply", ply_text(box) + "3 0 1 2\n")),
            "more.ply: line 32: expected the end of the file, found '3'");
  EXPECT_EQ(message(write("more.ply", ply_binary(box) + std::string(13, '\3'))),
            "more.ply: expected the end of the file after its elements, found 13 bytes more");
  EXPECT_EQ(message(write("space.ply", ply_binary(box) + "\r\n")), "");
  EXPECT_EQ(message(write("more.stl", stl_binary(box) + std::string(100, '\0'))),
            "more.stl: expected 12 triangles, as its header says, found 14");
  EXPECT_EQ(message(write("note.stl", stl_binary(box) + "made by a test")), "");
}

TEST_F(MeshFiles, PlyWithoutACoordinate) {
  std::string text = ply_text(test::box_mesh({1, 1, 1}));
  text.replace(text.find("float z"), 7, "float w");
  EXPECT_EQ(message(write("flat.ply", text)),
            "flat.ply: expected the properties x, y and z of a vertex, found no z");
}

TEST_F(MeshFiles, NumbersThatCannotBe) {
  TriangleSoup soup = test::box_mesh({1, 1, 1});
  for (const float bad : {std::nanf(""), std::numeric_limits<float>::infinity()}) {
    soup.vertices[3].x() = bad;
    for (const auto& [name, content] : samples(soup)) {
      EXPECT_NE(message(write(name, content)).find("expected finite coordinates"),
                std::string::npos)
          << name << ": " << message(write(name, content));
    }
  }
  soup = test::box_mesh({1, 1, 1});
  soup.triangles[5][1] = 99;
  for (const auto& [name, content] :
       {Sample{"a.off", off_text(soup)}, Sample{"c.ply", ply_text(soup)},
        Sample{"d.ply", ply_binary(soup)}, Sample{"g.glb", glb_binary(soup, plain_nodes())}}) {
    EXPECT_NE(message(write(name, content)).find("expected vertices below 8, found 99"),
              std::string::npos)
        << name;
  }
  EXPECT_NE(message(write("b.obj", obj_text(soup))), "");
  for (const auto& [name, content] : samples({soup.vertices, {}})) {
    EXPECT_NE(message(write(name, content)), "") << name;
  }
}

TEST_F(MeshFiles, CutOffAnywhereIsRefused) {
  for (const auto& [name, content] : samples(test::box_mesh({0.1F, 0.1F, 0.1F}))) {
    // A text's last word may go on or not, and an OBJ file has no end of its own.
    for (std::size_t size = 1; size + 13 < content.size(); size += 7) {
      const std::string text = message(write(name, content.substr(0, size)));
      // Nor needs a .stl file its last line.
      const bool whole_facets = content.substr(0, size).ends_with("endfacet\n") ||
                                content.substr(0, size).ends_with("endfacet");
      EXPECT_TRUE(text != "" || name.ends_with(".obj") || whole_facets)
          << name << " cut off at " << size;
    }
  }
}

TEST_F(MeshFiles, DamageNeverCrashes) {
  SCOPED_TRACE("NADE_TEST_SEED=" + std::to_string(test::seed()));
  test::Random random;
  for (const auto& [name, content] : samples(test::box_mesh({0.1F, 0.1F, 0.1F}))) {
    for (int i = 0; i < 150; ++i) {
      std::string damaged = content;
      for (int k = 0; k < 3; ++k) {
        damaged[random.below(static_cast<std::uint32_t>(damaged.size()))] =
            static_cast<char>(random.below(256));
      }
      const auto file = load_mesh(write(name, damaged));
      if (file.ok()) static_cast<void>(MeshSurface::build(file->soup, name));
    }
  }
}

TEST_F(MeshFiles, AMillionTriangles) {
  const TriangleSoup soup = test::uv_sphere(0.15F, 708, 708);
  const auto file = load_mesh(write("big.stl", stl_binary(soup)));
  ASSERT_TRUE(file.ok());
  const auto mesh = MeshSurface::build(file->soup, "big.stl");
  EXPECT_EQ((*mesh)->report().solid, MeshSolid::closed);
  EXPECT_TRUE(load_mesh(write("big.glb", glb_binary(soup, plain_nodes()))).ok());
}

/// An L of six corners, first corner beside the notch: a fan would cover the notch.
TEST_F(MeshFiles, ConcavePolygonsAreCutInside) {
  const std::string rows = "0 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\n"
      "property float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n" +
      rows;
  for (int first = 0; first < 6; ++first) {
    std::string corners;
    for (int i = 0; i < 6; ++i) corners += " " + std::to_string((first + i) % 6);
    for (const std::string& path : {write("l.off", "OFF\n6 1 0\n" + rows + "6" + corners + "\n"),
                                    write("l.ply", ply + "6" + corners + "\n")}) {
      const auto file = load_mesh(path);
      ASSERT_TRUE(file.ok()) << file.error().message;
      double area = 0.0;
      for (const auto& [a, b, c] : file->soup.triangles) {
        const auto& v = file->soup.vertices;
        const double twice = static_cast<double>((v[b] - v[a]).cross(v[c] - v[a]).z());
        EXPECT_GE(twice, 0.0);
        area += twice / 2.0;
      }
      EXPECT_NEAR(area, 3.0, 1e-6) << path << " from corner " << first;
    }
  }
}

/// A comb of 30,000 teeth, a spiral, and a polygon of random corners, which has no inside.
TEST_F(MeshFiles, LargePolygonsAreCutInTheirTime) {
  const auto cut_area = [&](const std::vector<Eigen::Vector2d>& corners) {
    std::string text = "OFF\n" + std::to_string(corners.size()) + " 1 0\n";
    for (const auto& corner : corners) {
      text += std::to_string(corner.x()) + " " + std::to_string(corner.y()) + " 0\n";
    }
    text += std::to_string(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) text += " " + std::to_string(i);
    const auto file = load_mesh(write("large.off", text));
    double area = 0.0;
    if (!file) return area;
    EXPECT_EQ(file->soup.triangles.size(), corners.size() - 2);
    for (const auto& [a, b, c] : file->soup.triangles) {
      const auto& v = file->soup.vertices;
      area += static_cast<double>((v[b] - v[a]).cross(v[c] - v[a]).norm()) / 2.0;
    }
    return area;
  };
  constexpr int kCorners = 60'000;
  std::vector<Eigen::Vector2d> comb{{0.0, -1.0}, {kCorners - 1.0, -1.0}};
  for (int i = kCorners - 1; i >= 0; --i) comb.emplace_back(i, i % 2);
  EXPECT_NEAR(cut_area(comb), 1.5 * (kCorners - 1), 1e-3 * kCorners);
  std::vector<Eigen::Vector2d> spiral;
  const auto at = [](double turn, double radius) {
    return Eigen::Vector2d(radius * std::cos(turn), radius * std::sin(turn));
  };
  for (int i = 0; i <= kCorners / 2; ++i) spiral.push_back(at(0.01 * i, 1.0 + 0.01 * i));
  for (int i = kCorners / 2; i >= 0; --i) spiral.push_back(at(0.01 * i, 0.99 + 0.01 * i));
  const double turns = 0.01 * kCorners / 2;
  EXPECT_NEAR(cut_area(spiral), 0.01 * (0.995 * turns + turns * turns / 2), 1e-2 * turns);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place;
  std::vector<Eigen::Vector2d> tangle(kCorners);
  for (auto& corner : tangle) corner = {place(random), place(random)};
  const auto start = std::chrono::steady_clock::now();
  cut_area(tangle);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST_F(MeshFiles, AHeaderOfBlender24) {
  const std::string text =
      "ply\nformat ascii 1.0\nCreated by Blender3D 247 - www.blender.org, source file: \n"
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar uint vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_EQ(message(write("a.ply", text)), "");
}

TEST_F(MeshFiles, SpellingsOfOffAndStl) {
  const std::string rest = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  for (const std::string header :
       {"OFF3 1 0\n", "off\n3 1 0\n", "OFF\n3 1\n", "OFF\n3\n1\n0\n", "\xEF\xBB\xBFOFF 3 1 0\n"}) {
    EXPECT_EQ(message(write("a.off", header + rest)), "") << header;
  }
  EXPECT_EQ(message(write("a.off", "OFF\r3 1 0\r0 0 0\r1 0 0\r0 1 0\r3 0 1 2\r")), "");
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";
  for (const std::string& text :
       {"  solid a\n" + facet + "endloop\nendfacet\nendsolid\n",
        "solid a\n" + facet + "end loop\nend facet\nend solid\n",
        "solid a\n" + facet + "endloop\nendfacet\n",
        std::string("SOLID A FACET NORMAL 0 0 1 OUTER LOOP VERTEX 0 0 0 VERTEX 1 0 0 VERTEX 0 1 0 "
                    "ENDLOOP ENDFACET ENDSOLID")}) {
    const auto file = load_mesh(write("a.stl", text));
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_EQ(file->soup.triangles.size(), 1U) << text;
  }
  EXPECT_NE(message(write("a.stl", "solid a\n" + facet)), "");
  std::string streamed = stl_binary(test::box_mesh({1, 1, 1}));
  streamed.replace(80, 4, 4, '\0');
  EXPECT_EQ(load_mesh(write("b.stl", streamed))->soup.triangles.size(), 12U);
}

TEST_F(MeshFiles, PlyHeadersThatSayTooMuchOrTooLittle) {
  const std::string vertices =
      "element vertex 4\nproperty float x\nproperty float y\n"
      "property float z\n";
  const std::string rows = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
  const std::string start = "ply\nformat ascii 1.0\n";
  EXPECT_EQ(message(write("a.ply", start + "element foo 18446744073709551615\n" + vertices +
                                       "end_header\n" + rows)),
            "a.ply: element foo: expected properties, found none");
  EXPECT_EQ(message(write("a.ply", start + vertices +
                                       "element face 1\nproperty list uchar int "
                                       "ids\nend_header\n" +
                                       rows + "3 0 1 2\n")),
            "a.ply: element face: expected a list vertex_indices, found only 'ids'");
  const auto strip = load_mesh(write("a.ply", start + vertices +
                                                  "element tristrips 1\nproperty list int int "
                                                  "vertex_indices\nend_header\n" +
                                                  rows + "4 0 1 2 3\n"));
  ASSERT_TRUE(strip.ok()) << strip.error().message;
  EXPECT_EQ(strip->soup.triangles.size(), 2U);
}

}  // namespace
}  // namespace nade
