#include "nade/io/object_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "nade/io/assets.h"
#include "support/scratch_folder.h"

namespace nade {
namespace {

double signed_distance(const Object& object, const Vec3& point) {
  SurfaceHint hint;
  const auto nearest = object.closest_point(point, 10.0, hint);
  return nearest ? nearest->signed_distance : NAN;
}

std::string temp_file(const std::string& name, const std::string& content) {
  const auto path = std::filesystem::temp_directory_path() / ("nade_object_file_" + name);
  std::ofstream(path) << content;
  return path.string();
}

TEST(ObjectFile, PlaneIsSolidBelowZero) {
  const auto plane = load_object("plane");
  ASSERT_TRUE(plane.ok());
  EXPECT_NEAR(signed_distance(plane->placed(), {1.0, -0.02, 3.0}), -0.02, 1e-12);
}

TEST(ObjectFile, SphereHasItsTopAtTheOriginOfItsFrame) {
  for (const auto& [spec, radius] : {std::pair{"sphere", 0.15}, std::pair{"sphere:0.06", 0.06}}) {
    const auto sphere = load_object(spec);
    ASSERT_TRUE(sphere.ok()) << spec;
    const Object object = sphere->placed();
    EXPECT_NEAR(signed_distance(object, Vec3::Zero()), 0.0, 1e-12);
    EXPECT_NEAR(signed_distance(object, {0.0, -radius, 0.0}), -radius, 1e-12);
  }
}

TEST(ObjectFile, PlacementActsOnTheObjectsOwnFrame) {
  const auto sphere = load_object("sphere:0.1");
  ASSERT_TRUE(sphere.ok());
  Placement placement;
  placement.pose.position = Vec3(0.3, 0.2, 0.1);
  placement.pose.rotation = Quat(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ()));
  placement.scale = 2.0;
  // The top stays at the placement's position; the ball, now of 0.2 m, hangs off it along +X.
  const Object object = sphere->placed(placement);
  EXPECT_NEAR(signed_distance(object, placement.pose.position), 0.0, 1e-12);
  EXPECT_NEAR(signed_distance(object, {0.5, 0.2, 0.1}), -0.2, 1e-12);
}

TEST(ObjectFile, ObjectsWithoutPlacesOfTheirOwnHaveATop) {
  for (const char* spec : {"plane", "sphere"}) {
    const auto object = load_object(spec);
    ASSERT_TRUE(object.ok());
    const auto top = object->place();
    ASSERT_TRUE(top.ok());
    EXPECT_EQ(top->name, "top");
    EXPECT_NEAR((top->pose.position - Vec3::Zero()).norm(), 0.0, 1e-12);
    EXPECT_NEAR((top->pose.rotation * Vec3::UnitY() - Vec3::UnitY()).norm(), 0.0, 1e-12);
    EXPECT_NEAR((top->pose.rotation * Vec3::UnitZ() - Vec3::UnitZ()).norm(), 0.0, 1e-12);
  }
}

TEST(ObjectFile, MeshFileHasItsTopAboveItsCentroid) {
  const std::string path =
      temp_file("tetrahedron.obj",
                "v 0 0 0\nv 1 0 0\nv 0 0 1\nv 0.25 1 0.25\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n");
  const auto mesh = load_object(path);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  ASSERT_TRUE(mesh->soup.has_value());
  const auto top = mesh->place();
  ASSERT_TRUE(top.ok());
  EXPECT_NEAR(signed_distance(mesh->placed(), top->pose.position), 0.0, 1e-6);
  EXPECT_GT((top->pose.rotation * Vec3::UnitY()).y(), 0.0);
}

TEST(ObjectFile, DogHasThePlacesOfTheCommandLine) {
  const auto dog = load_object("dog");
  if (!dog.ok()) GTEST_SKIP() << dog.error().message;
  for (const char* name : {"back", "flank", "head", "ear", "leg"}) {
    const auto place = dog->place(name);
    ASSERT_TRUE(place.ok()) << place.error().message;
    EXPECT_NEAR(signed_distance(dog->placed(), place->pose.position), 0.0, 0.005) << name;
  }
  EXPECT_EQ(dog->place()->name, "back");
}

TEST(ObjectFile, MisuseIsToldInASentence) {
  for (const char* spec :
       {"sphere:-1", "sphere:0", "sphere:", "sphere:1x", "sphere:nan", "sphere:inf", "cube", ""}) {
    const auto object = load_object(spec);
    ASSERT_FALSE(object.ok()) << spec;
    EXPECT_EQ(object.error().code, ErrorCode::out_of_range) << spec;
    EXPECT_NE(object.error().message.find("expected"), std::string::npos);
  }
  const auto plane = load_object("plane");
  const auto place = plane->place("ear");
  ASSERT_FALSE(place.ok());
  EXPECT_EQ(place.error().message, "object plane: no place 'ear': expected one of top");
}

TEST(ObjectFile, MissingFileIsNotFound) {
  const auto object = load_object("/nowhere/cat.glb");
  ASSERT_FALSE(object.ok());
  EXPECT_EQ(object.error().code, ErrorCode::not_found);
  EXPECT_NE(object.error().message.find("/nowhere/cat.glb"), std::string::npos);
}

TEST(ObjectFile, PlacingSurvivesAHeader) {
  ObjectPlacing placing{"sphere:0.06", {}};
  placing.placement.pose.position = Vec3(0.1, -0.2, 1.0 / 3.0);
  placing.placement.pose.rotation = Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  placing.placement.scale = 1.25;
  const std::string header = with_placing(R"({"method":"paper"})", placing);
  EXPECT_NE(header.find(R"("method":"paper")"), std::string::npos);
  const auto read = placing_from(header, "r.jsonl");
  ASSERT_TRUE(read.ok());
  ASSERT_TRUE(read->has_value());
  const ObjectPlacing& back = **read;
  EXPECT_EQ(back.object, placing.object);
  EXPECT_NEAR((back.placement.pose.position - placing.placement.pose.position).norm(), 0, 1e-15);
  EXPECT_LT(back.placement.pose.rotation.angularDistance(placing.placement.pose.rotation), 1e-7);
  EXPECT_EQ(back.placement.scale, 1.25);
}

/// No one's folders travel with a recording.
TEST(ObjectFile, AHeaderHasTheNameOfAMeshFileOnly) {
  EXPECT_EQ(object_name("/home/me/cat.GLB:alive:Walk/slow"), "cat.GLB:alive:Walk/slow");
  EXPECT_EQ(object_name("../models/cat.obj"), "cat.obj");
  EXPECT_EQ(object_name("sphere:0.06"), "sphere:0.06");
  EXPECT_EQ(object_name("dog:alive"), "dog:alive");
  const std::string header = with_placing("{}", {"/home/me/cat.obj", {}});
  EXPECT_EQ(header.find("/home"), std::string::npos);
}

TEST(ObjectFile, TheMeshOfAHeaderIsTheOneBesideTheRecording) {
  const test::ScratchFolder folder;
  std::ofstream(folder.path("cat.obj")) << "v 0 0 0\n";
  const auto object = [&](const std::string& spec) {
    const auto read = placing_from(R"({"object":")" + spec + R"("})", folder.path("stroke.jsonl"));
    return (*read)->object;
  };
  EXPECT_EQ(object("cat.obj"), folder.path("cat.obj"));
  EXPECT_EQ(object("/elsewhere/cat.obj"), folder.path("cat.obj")) << "as it was written before";
  EXPECT_EQ(object("/elsewhere/dog.obj"), "/elsewhere/dog.obj");
}

TEST(ObjectFile, HeaderWithoutAnObjectHasNoPlacing) {
  for (const char* header : {"", "{}", R"({"method":"paper"})"}) {
    const auto read = placing_from(header, "r.jsonl");
    ASSERT_TRUE(read.ok());
    EXPECT_FALSE(read->has_value());
  }
}

TEST(ObjectFile, BadPlacingInAHeaderIsNamed) {
  const auto message = [](const char* header) {
    const auto read = placing_from(header, "r.jsonl");
    return read.ok() ? std::string() : read.error().message;
  };
  EXPECT_EQ(message(R"({"object":7})"), "r.jsonl: header: object: expected a text");
  EXPECT_EQ(message(R"({"object":"dog","at":[1,2]})"), "r.jsonl: header: at: expected 3 numbers");
  EXPECT_EQ(message(R"({"object":"dog","turn":[0,0,0,0]})"),
            "r.jsonl: header: turn: expected 4 numbers, not all 0");
  EXPECT_EQ(message(R"({"object":"dog","scale":0})"),
            "r.jsonl: header: scale: expected a number above 0");
}

TEST(Assets, EnvironmentNamesTheFolder) {
  const std::string file = temp_file("asset.txt", "x");
  const std::filesystem::path path(file);
  ::setenv("NADE_ASSETS", path.parent_path().c_str(), 1);
  const auto found = find_asset(path.filename().string());
  ASSERT_TRUE(found.ok());
  EXPECT_EQ(*found, file);
  const auto missing = find_asset("no/such.thing");
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().code, ErrorCode::not_found);
  EXPECT_NE(missing.error().message.find(path.parent_path().string()), std::string::npos);
  ::unsetenv("NADE_ASSETS");
}

TEST(ObjectFile, SheetThatLooksDownIsTold) {
  const std::string corners = "v 0 0 0\nv 0.2 0 0\nv 0.2 0 0.2\nv 0 0 0.2\n";
  const auto down = load_object(temp_file("down.obj", corners + "f 1 2 3\nf 1 3 4\n"));
  ASSERT_TRUE(down.ok()) << down.error().message;
  const std::string told = facing_hint(*down, Quat::Identity());
  EXPECT_NE(told.find("front looks down"), std::string::npos) << told;
  EXPECT_NE(told.find("--turn 1,0,0,0 "), std::string::npos) << told;
  const Quat over(0.0, 1.0, 0.0, 0.0);
  EXPECT_EQ(facing_hint(*down, over), "");
  const auto up = load_object(temp_file("up.obj", corners + "f 3 2 1\nf 4 3 1\n"));
  ASSERT_TRUE(up.ok()) << up.error().message;
  EXPECT_EQ(facing_hint(*up, Quat::Identity()), "");
  EXPECT_NE(facing_hint(*up, over), "");
  EXPECT_EQ(facing_hint(*load_object("plane"), over), "");
}

}  // namespace
}  // namespace nade
