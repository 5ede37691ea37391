#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "nade/io/mesh_file.h"
#include "nade/mesh.h"
#include "support/files.h"

namespace nade {
namespace {

class Dog : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    auto loaded = load_mesh(NADE_TEST_DOG);
    ASSERT_TRUE(loaded.ok()) << loaded.error().message;
    file_ = new MeshFile(std::move(loaded.value()));
  }
  static void TearDownTestSuite() {
    delete file_;
    file_ = nullptr;
  }

  void SetUp() override { ASSERT_NE(file_, nullptr); }

  static const TriangleSoup& soup() { return file_->soup; }
  static Vec3 vertex(std::uint32_t index) { return soup().vertices[index].cast<double>(); }
  static std::array<Vec3, 3> corners(const std::array<std::uint32_t, 3>& t) {
    return {vertex(t[0]), vertex(t[1]), vertex(t[2])};
  }
  static Vec3 face_normal(const std::array<std::uint32_t, 3>& t) {
    const auto [a, b, c] = corners(t);
    return (b - a).cross(c - a).normalized();
  }
  /// The highest point within a slab across the body, near the middle plane.
  static double top_between(float from, float to) {
    float top = 0.0F;
    for (const Eigen::Vector3f& v : soup().vertices)
      if (v.x() > from && v.x() < to && std::abs(v.z()) < 0.02F) top = std::max(top, v.y());
    return top;
  }

  static MeshFile* file_;
};

MeshFile* Dog::file_ = nullptr;

TEST_F(Dog, ClosedManifoldInOnePieceWithoutHandles) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : soup().triangles)
    for (std::size_t i = 0; i < 3; ++i)
      ASSERT_TRUE(edges.emplace(t[i], t[(i + 1) % 3]).second) << "two triangles on one side";
  for (const auto& [from, to] : edges) ASSERT_TRUE(edges.contains({to, from})) << "a hole";

  std::vector<std::uint32_t> parent(soup().vertices.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  std::size_t pieces = parent.size();
  for (const auto& [from, to] : edges) {
    const std::uint32_t a = root(from);
    const std::uint32_t b = root(to);
    if (a == b) continue;
    parent[a] = b;
    --pieces;
  }
  EXPECT_EQ(pieces, 1U);
  // With every vertex in one piece, characteristic 2 also leaves no vertex with two fans.
  const auto euler = static_cast<std::ptrdiff_t>(soup().vertices.size()) -
                     static_cast<std::ptrdiff_t>(edges.size() / 2) +
                     static_cast<std::ptrdiff_t>(soup().triangles.size());
  EXPECT_EQ(euler, 2);
}

TEST_F(Dog, IsACleanSolidToTheLibrary) {
  const auto surface = MeshSurface::build(soup(), "dog");
  ASSERT_TRUE(surface.ok()) << surface.error().message;
  const MeshReport& report = surface.value()->report();
  EXPECT_EQ(report.solid, MeshSolid::closed);
  EXPECT_EQ(report.triangles_used, soup().triangles.size());
  EXPECT_EQ(report.triangles_turned, 0U);
}

TEST_F(Dog, HasWellShapedTriangles) {
  EXPECT_GE(soup().triangles.size(), 30000U);
  EXPECT_LE(soup().triangles.size(), 60000U);
  std::vector<double> smallest;
  for (const auto& t : soup().triangles) {
    const auto [a, b, c] = corners(t);
    const auto angle = [](const Vec3& u, const Vec3& v) {
      return std::atan2(u.cross(v).norm(), u.dot(v)) / kDegree;
    };
    smallest.push_back(std::min({angle(b - a, c - a), angle(c - b, a - b), angle(a - c, b - c)}));
  }
  std::sort(smallest.begin(), smallest.end());
  EXPECT_GT(smallest.front(), 15.0);
  EXPECT_GT(smallest[smallest.size() / 100], 35.0);
  EXPECT_GT(smallest[smallest.size() / 2], 50.0);
}

TEST_F(Dog, StandsInItsFrame) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& v : soup().vertices) box.extend(v);
  EXPECT_NEAR(box.min().y(), 0.0F, 0.003F);
  EXPECT_NEAR(box.center().x(), 0.0F, 0.02F);
  EXPECT_NEAR(box.center().z(), 0.0F, 0.005F);
  // Withers behind the neck, over the fore legs; the head higher and at -X.
  const double withers = top_between(-0.10F, -0.06F);
  EXPECT_GT(withers, 0.43);
  EXPECT_LT(withers, 0.47);
  EXPECT_GT(top_between(-0.30F, -0.22F), withers + 0.08);
  EXPECT_LT(box.min().x(), -0.3F);
}

TEST_F(Dog, FacesOutward) {
  double volume = 0.0;
  for (const auto& t : soup().triangles) {
    const auto [a, b, c] = corners(t);
    volume += a.dot(b.cross(c)) / 6.0;
  }
  EXPECT_GT(volume, 0.008);  // cubic metres
  EXPECT_LT(volume, 0.025);

  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3> normals;
  for (const auto& t : soup().triangles)
    for (std::size_t i = 0; i < 3; ++i) normals[{t[i], t[(i + 1) % 3]}] = face_normal(t);
  for (const auto& [edge, normal] : normals)
    EXPECT_GT(normal.dot(normals.at({edge.second, edge.first})), 0.0) << "a fold";
}

TEST_F(Dog, PlacesLieOnTheSurface) {
  std::map<std::string, Pose> places;
  for (const MeshPlace& place : file_->places) places[place.name] = place.pose;
  for (const std::string name : {"back", "flank", "head", "ear", "leg"}) {
    ASSERT_TRUE(places.contains(name)) << name;
    const Pose& pose = places[name];
    double nearest = std::numeric_limits<double>::max();
    Vec3 normal = Vec3::Zero();
    for (const auto& t : soup().triangles) {
      const auto [a, b, c] = corners(t);
      const Vec3 face = face_normal(t);
      // Within the prism over the triangle: inside all three edges.
      const Vec3 p = pose.position;
      if ((b - a).cross(p - a).dot(face) < -1e-12 || (c - b).cross(p - b).dot(face) < -1e-12 ||
          (a - c).cross(p - c).dot(face) < -1e-12)
        continue;
      const double away = std::abs((p - a).dot(face));
      if (away < nearest) {
        nearest = away;
        normal = face;
      }
    }
    EXPECT_LT(nearest, 0.001) << name;
    EXPECT_GT(normal.dot(pose.rotation * Vec3::UnitY()), std::cos(5.0 * kDegree)) << name;
  }
  // With the lie of the coat: head to tail, brow to neck, root to tip, downward.
  const auto stroke = [&](const std::string& name) -> Vec3 {
    return places[name].rotation * -Vec3::UnitZ();
  };
  EXPECT_GT(stroke("back").x(), 0.95);
  EXPECT_GT(stroke("flank").x(), 0.95);
  EXPECT_GT(stroke("head").x(), 0.9);
  EXPECT_LT(stroke("ear").y(), -0.8);
  EXPECT_LT(stroke("leg").y(), -0.9);
}

TEST_F(Dog, ComesOutTheSameEveryTime) {
  const auto again = std::filesystem::path(testing::TempDir()) / "dog_again.glb";
  const std::string command = "\"" NADE_TEST_MAKE_DOG "\" \"" + again.string() + "\" > /dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string first = test::read_file(NADE_TEST_DOG);
  EXPECT_FALSE(first.empty());
  EXPECT_TRUE(first == test::read_file(again));
  std::filesystem::remove(again);
}

TEST_F(Dog, LeavesNothingWhereItCannotWrite) {
  const std::string nowhere = testing::TempDir() + "no_such_folder/dog.glb";
  const std::string command = "\"" NADE_TEST_MAKE_DOG "\" \"" + nowhere + "\" > /dev/null 2>&1";
  EXPECT_NE(std::system(command.c_str()), 0);
  EXPECT_FALSE(std::filesystem::exists(nowhere));
}

}  // namespace
}  // namespace nade
