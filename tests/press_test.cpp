#include "nade/eval/press.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "nade/hand_mesh.h"
#include "support/meshes.h"

namespace nade {
namespace {

/// A hand of the generic size whose palm's skin is at `skin`, its back up.
RecordedHand hand_with_skin_at(const Vec3& skin, Handedness side) {
  RecordedHand hand;
  hand.pose.side = side;
  const Vec3 palm = skin + Vec3(0.0, generic_skin_depths()[Part::palm], 0.0);
  for (Pose& joint : hand.pose.joints) joint.position = palm;
  hand.pose[Joint::wrist].position = palm + Vec3(0.0, 0.0, 0.5 * kGenericHandLength);
  hand.pose[Joint::middle_proximal].position = palm - Vec3(0.0, 0.0, 0.5 * kGenericHandLength);
  return hand;
}

RecordedFrame frame_with(const Vec3& skin, Handedness side = Handedness::right) {
  RecordedFrame frame;
  frame.hands[index_of(side)] = hand_with_skin_at(skin, side);
  return frame;
}

/// A palm that wanders to and fro and up and down about (0.3, 0.2, -0.1).
PalmTrack wandering_track() {
  PalmTrack track;
  for (int i = 0; i < 301; ++i) {
    const double t = 0.02 * i;
    track.add(frame_with(Vec3(0.3 + 0.04 * std::sin(t), 0.2 + 0.02 * std::sin(2.3 * t),
                              -0.1 + 0.03 * std::cos(1.7 * t))));
  }
  return track;
}

LoadedObject loaded(const std::string& spec) {
  auto object = load_object(spec);
  EXPECT_TRUE(object.ok()) << object.error().message;
  return std::move(object).value();
}

TEST(PalmTrack, SkinIsBelowThePalmJointByTheScaledDepth) {
  const Vec3 skin(0.1, 0.2, 0.3);
  const auto found = palm_skin(hand_with_skin_at(skin, Handedness::left).pose);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR((*found - skin).norm(), 0.0, 1e-12);
  HandPose broken;
  EXPECT_FALSE(palm_skin(broken).has_value());
}

TEST(PalmTrack, LongRecordingsAreThinnedEvenly) {
  PalmTrack track;
  constexpr int kFrames = 100'000;
  for (int i = 0; i < kFrames; ++i) track.add(frame_with(Vec3(0.0, i, 0.0)));
  ASSERT_LT(track.frames().size(), PalmTrack::kCapacity);
  ASSERT_GT(track.frames().size(), PalmTrack::kCapacity / 3);
  const double first_step = (*track.frames()[1][1] - *track.frames()[0][1]).y();
  for (std::size_t i = 1; i < track.frames().size(); ++i) {
    EXPECT_NEAR((*track.frames()[i][1] - *track.frames()[i - 1][1]).y(), first_step, 1e-6);
  }
  EXPECT_GT((*track.frames().back()[1]).y(), kFrames - 2 * first_step);
}

TEST(Press, MedianDepthIsTheOneAskedFor) {
  const PalmTrack track = wandering_track();
  for (const char* spec : {"plane", "sphere", "sphere:0.08"}) {
    const LoadedObject object = loaded(spec);
    for (const double depth : {0.005, 0.03}) {
      const auto placement = press(object, {}, track, depth);
      ASSERT_TRUE(placement.ok()) << placement.error().message;
      EXPECT_NEAR(median_depth(object.placed(*placement), track.frames()), depth, 1e-6) << spec;
    }
  }
}

TEST(Press, OneFarGlitchIsNoMatter) {
  const LoadedObject object = loaded("plane");
  for (const double height : {1e8, -1e8}) {
    PalmTrack track = wandering_track();
    track.add(frame_with(Vec3(0.3, height, -0.1)));
    const auto pressed = press(object, {}, track, 0.02);
    ASSERT_TRUE(pressed.ok()) << pressed.error().message;
    EXPECT_NEAR(median_depth(object.placed(*pressed), track.frames()), 0.02, 1e-6);
    const auto without = press(object, {}, wandering_track(), 0.02);
    EXPECT_NEAR((pressed->pose.position - without->pose.position).norm(), 0.0, 0.002);
  }
}

TEST(Press, TurnAndScaleAreKept) {
  const LoadedObject object = loaded("sphere:0.1");
  Placement placement;
  placement.pose.rotation = Quat(Eigen::AngleAxisd(0.4, Vec3::UnitZ()));
  placement.scale = 1.5;
  const auto pressed = press(object, placement, wandering_track(), 0.02);
  ASSERT_TRUE(pressed.ok());
  EXPECT_EQ(pressed->pose.rotation.coeffs(), placement.pose.rotation.coeffs());
  EXPECT_EQ(pressed->scale, 1.5);
}

TEST(Press, WallIsPressedAlongItsNormal) {
  const LoadedObject object = loaded("plane");
  Placement placement;
  placement.pose.rotation = Quat(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX()));
  const PalmTrack track = wandering_track();
  const auto pressed = press(object, placement, track, 0.02);
  ASSERT_TRUE(pressed.ok()) << pressed.error().message;
  EXPECT_NEAR(median_depth(object.placed(*pressed), track.frames()), 0.02, 1e-6);
}

TEST(Press, HandsFarApartPutTheObjectUnderOne) {
  PalmTrack track;
  for (int i = 0; i < 100; ++i) {
    RecordedFrame frame = frame_with(Vec3(0.3, 0.2, 0.0), Handedness::right);
    frame.hands[0] = hand_with_skin_at(Vec3(-0.3, 0.2, 0.0), Handedness::left);
    track.add(frame);
  }
  const LoadedObject object = loaded("sphere:0.06");
  const auto pressed = press(object, {}, track, 0.02);
  ASSERT_TRUE(pressed.ok()) << pressed.error().message;
  EXPECT_NEAR(median_depth(object.placed(*pressed), track.frames()), 0.02, 1e-6);
}

TEST(Press, WhatCannotBeReachedIsToldWithItsDepth) {
  const auto error = press(loaded("sphere:0.01"), {}, wandering_track(), 0.03);
  ASSERT_FALSE(error.ok());
  EXPECT_EQ(error.error().code, ErrorCode::bad_value);
  EXPECT_NE(error.error().message.find("can be no deeper than 0.0"), std::string::npos);
  EXPECT_EQ(press(loaded("plane"), {}, wandering_track(), 0.0).error().code,
            ErrorCode::out_of_range);
  EXPECT_EQ(press(loaded("plane"), {}, PalmTrack(), 0.03).error().code, ErrorCode::bad_value);
}

/// A board 40 cm wide, its top at y = 0.
std::string board_file(double thickness_m) {
  const TriangleSoup soup = test::box_mesh({0.2F, static_cast<float>(0.5 * thickness_m), 0.2F});
  const std::string path = testing::TempDir() + "nade_press_board.obj";
  std::ofstream file(path);
  for (const Eigen::Vector3f& v : soup.vertices) {
    file << "v " << v.x() << ' ' << v.y() - 0.5 * thickness_m << ' ' << v.z() << '\n';
  }
  for (const auto& t : soup.triangles) {
    file << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  }
  return path;
}

TEST(Press, BoardsArePressedFromTheSideThatIsEntered) {
  PalmTrack track;
  track.add(frame_with(Vec3(0.3, 0.2, -0.1)));
  for (const double thickness_m : {0.001, 0.003, 0.01, 0.03}) {
    const LoadedObject board = loaded(board_file(thickness_m));
    for (const double depth_m : {0.0004, 0.002, 0.008, 0.02}) {
      const auto pressed = press(board, {}, track, depth_m);
      ASSERT_TRUE(pressed.ok()) << pressed.error().message;
      EXPECT_NEAR(pressed->pose.position.y(), 0.2 + depth_m, 1e-6) << thickness_m;
    }
  }
  // Of what is no wall, depth is the distance to the surface: it ends in the middle.
  EXPECT_FALSE(press(loaded(board_file(0.08)), {}, track, 0.045).ok());
}

TEST(Press, RealRecordingsLieAsDeepAsAsked) {
  const std::filesystem::path folder = std::filesystem::path(NADE_TEST_SHARED_DATA) / "leap";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << folder << " is not there";
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    auto reader = RecordingReader::open(file.path().string());
    ASSERT_TRUE(reader.ok()) << reader.error().message;
    PalmTrack track;
    for (;;) {
      auto frame = reader->next();
      ASSERT_TRUE(frame.ok()) << frame.error().message;
      if (!frame->has_value()) break;
      track.add(**frame);
    }
    for (const char* spec : {"plane", "sphere", "dog"}) {
      auto object = load_object(spec);
      if (!object.ok()) GTEST_SKIP() << object.error().message;
      const auto pressed = press(*object, {}, track, 0.03);
      ASSERT_TRUE(pressed.ok()) << file.path() << pressed.error().message;
      EXPECT_NEAR(median_depth(object->placed(*pressed), track.frames()), 0.03, 1e-5)
          << file.path() << spec;
    }
  }
}

}  // namespace
}  // namespace nade
