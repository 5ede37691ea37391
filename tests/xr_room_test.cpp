#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "motion_files.h"
#include "support/allocation_counter.h"
#include "support/scratch_folder.h"
#include "xr/room_fixture.h"

namespace nade::xr {
namespace {

TEST_F(RoomTest, ObjectStandsBeforeThePersonAndTheHandOnIt) {
  room_->update(frame_at(bind_, 0));
  EXPECT_LT((room_->object_spot().position - Vec3(0.0, 1.18, -0.40)).norm(), 1e-3);
  const auto& hand = room_->hands()[index_of(Handedness::right)];
  ASSERT_TRUE(hand);
  EXPECT_EQ(hand->corrected.status, HandStatus::corrected);
  EXPECT_GT(hand->corrected.pose[Joint::palm].position.y(),
            hand->tracked[Joint::palm].position.y() + 0.003);
}

TEST_F(RoomTest, HeightAndRecentre) {
  room_->update(frame_at(bind_, 0));
  room_->raise(0.02);
  EXPECT_NEAR(room_->object_spot().position.y(), 1.20, 1e-6);
  TrackedFrame frame = frame_at(bind_, 1);
  frame.head->position = Vec3(1.0, 1.5, 2.0);
  frame.head->rotation = Quat(Eigen::AngleAxisd(1.5707963, Vec3::UnitY()));  // looks to -X
  room_->recentre();
  room_->update(frame);
  EXPECT_LT((room_->object_spot().position - Vec3(0.6, 1.08, 2.0)).norm(), 1e-3);
}

TEST_F(RoomTest, EyesSeeTheRoomFromWhereTheyAre) {
  const TrackedFrame frame = frame_at(bind_, 0);
  room_->update(frame);
  const draw::Image left = room_->picture(frame.eyes[0], kWidth, kHeight);
  const draw::Image right = room_->picture(frame.eyes[1], kWidth, kHeight);
  EXPECT_NE(left.rgba, right.rgba);
  std::size_t lit = 0;
  for (std::size_t i = 0; i < left.rgba.size(); i += 4) lit += left.rgba[i] > 40 ? 1 : 0;
  EXPECT_GT(lit, static_cast<std::size_t>(kWidth * kHeight / 2));
}

class LivingRoomTest : public RoomTest {
 protected:
  void furnish(RoomSetup& setup) override { setup.objects = {"sphere", "dog:alive"}; }
};

TEST_F(LivingRoomTest, ALivingObjectMovesFromTheFirstFrameThatShowsItOn) {
  room_->update(frame_at(bind_, 0));
  EXPECT_FALSE(room_->animation_start_ns()) << "the ball does not move";
  Show show = chooser_.show();
  show.object = "dog:alive";
  room_->set(show);
  Result<LoadedObject> dog = load_object("dog:alive");
  ASSERT_TRUE(dog.ok());
  for (const int index : {10, 50, 120}) {
    const TrackedFrame frame = frame_at(bind_, index);
    room_->update(frame);
    EXPECT_EQ(room_->animation_start_ns(), frame_at(bind_, 10).time_ns);
    dog->move_to(1e-9 * static_cast<double>(frame.time_ns - *room_->animation_start_ns()));
    EXPECT_TRUE(room_->object()->soup->vertices == dog->soup->vertices) << index;
  }
}

class SoftRoomTest : public RoomTest {
 protected:
  static constexpr double kSoftness_m = 0.012;
  void furnish(RoomSetup& setup) override { setup.corrector.settle.softness_m = kSoftness_m; }

  /// The room's last frame as a stage has it, without the panel.
  draw::Image staged(const TrackedFrame& frame, double softness_m) {
    Result<draw::Renderer> renderer = draw::Renderer::create();
    Result<draw::Stage> stage = draw::Stage::create(*renderer, room_->meshes());
    const Placement spot{room_->object_spot(), 1.0};
    EXPECT_TRUE(stage->set_object(*room_->object(), composed(spot, room_->placement())).ok());
    draw::StageFrame shown;
    const auto& hand = room_->hands()[index_of(Handedness::right)];
    shown.hands[index_of(Handedness::right)] = {hand->tracked, hand->corrected.pose, {}, {}};
    shown.softness_m = softness_m;
    draw::Scene scene = stage->arrange(shown);
    scene.floor_y = frame.floor_y;
    return renderer->picture(scene, frame.eyes[0], kWidth, kHeight);
  }
};

TEST_F(SoftRoomTest, ASoftObjectGivesWayToTheHand) {
  Show show = chooser_.show();
  show.has_panel = false;
  room_->set(show);
  TrackedFrame frame = frame_at(bind_, 0);
  HandPose& hand = *frame.hands[index_of(Handedness::right)];
  hand = moved(hand, Pose{Vec3(0.0, -0.02, 0.0), Quat::Identity()});
  frame.floor_y = 1.07;  // under the ball: no stand is seen
  // From beside, where the hand does not hide it.
  frame.eyes[0].pose.position = Vec3(0.25, 1.16, -0.40);
  frame.eyes[0].pose.rotation = Quat(Eigen::AngleAxisd(1.5707963, Vec3::UnitY()));
  for (int i = 0; i < 60; ++i) {
    frame.time_ns += 11'111'111;
    room_->update(frame);
  }
  const draw::Image picture = room_->picture(frame.eyes[0], kWidth, kHeight);
  EXPECT_TRUE(picture.rgba == staged(frame, kSoftness_m).rgba);
  EXPECT_FALSE(picture.rgba == staged(frame, 0.0).rgba);
}

TEST(Chooser, ButtonsChooseAndMove) {
  Chooser chooser({{"sphere", "plane", "a/bunny.obj"}});
  EXPECT_TRUE(chooser.changed());
  EXPECT_FALSE(chooser.changed());
  EXPECT_EQ(chooser.show().object, "sphere");
  const auto press = [&chooser](const std::string& label) {
    for (const auto& row : chooser.show().panel.rows) {
      for (const study::PanelButton& button : row) {
        if (button.label == label) return chooser.press(button.id);
      }
    }
    ADD_FAILURE() << "no button " << label;
  };
  press("bunny");
  EXPECT_EQ(chooser.show().object, "a/bunny.obj");
  press("paper");
  EXPECT_EQ(chooser.show().method, Method::paper);
  press("with ghost");
  EXPECT_EQ(chooser.show().shown, draw::Shown::both);
  press("higher");
  press("higher");
  EXPECT_NEAR(chooser.take_wishes().raise_m, 0.04, 1e-12);
  press("leave");
  EXPECT_TRUE(chooser.take_wishes().leave);
  EXPECT_FALSE(chooser.take_wishes().leave);
}

TEST(Chooser, NoTwoButtonsHaveOneName) {
  const std::vector<std::string> objects{"sphere:0.05", "plane",   "sphere",  "dog",
                                         "dog:alive",   "a/x.obj", "b/x.obj", "b/y.obj"};
  const std::vector<std::string> names{"sphere:0.05", "plane",   "sphere",  "dog",
                                       "dog:alive",   "a/x.obj", "b/x.obj", "y"};
  EXPECT_EQ(button_names(objects), names);
}

TEST(MotionFiles, HeadersSayWhenTheAnimationBegan) {
  RecordedAs as;
  as.object = "dog:alive";
  as.animation_start_ns = -20'000'000;
  const study::MotionFiles files = motion_files("nowhere/a.jsonl", as);
  for (const RecordingHeader* header : {&files.tracked_header, &files.corrected_header}) {
    const auto placing = placing_from(header->unknown_json, "a.jsonl");
    ASSERT_TRUE(placing.ok() && *placing);
    EXPECT_EQ((*placing)->animation_start_ns, -20'000'000);
  }
}

TEST(MotionFiles, CorrectedHeaderSaysHowSoftAndRough) {
  RecordedAs as;
  as.object = "sphere";
  as.settle.softness_m = 0.004;
  as.settle.friction.coefficient = 0.5;
  const study::MotionFiles files = motion_files("nowhere/a.jsonl", as);
  const auto header = nlohmann::json::parse(files.corrected_header.unknown_json);
  EXPECT_EQ(header.value("softness", 0.0), 0.004);
  EXPECT_EQ(header.value("friction", 0.0), 0.5);
  as.method = Method::paper;
  const std::string paper = motion_files("nowhere/a.jsonl", as).corrected_header.unknown_json;
  EXPECT_FALSE(nlohmann::json::parse(paper).contains("softness")) << "which it knows nothing of";
}

TEST(MotionFiles, NamesBesideTheGivenOne) {
  EXPECT_EQ(corrected_path("a/stroke.jsonl.gz"), "a/stroke-corrected.jsonl.gz");
  EXPECT_EQ(corrected_path("stroke"), "stroke-corrected");
  EXPECT_EQ(numbered_path("stroke.jsonl", 1), "stroke.jsonl");
  EXPECT_EQ(numbered_path("stroke.jsonl", 2), "stroke-2.jsonl");
}

class MotionFilesOnDisk : public test::FolderTest {};

TEST_F(MotionFilesOnDisk, NextPairTakesNamesThatAreFree) {
  std::ofstream(path("a-2.jsonl")) << "dear to somebody";
  std::ofstream(path("a-3-corrected.jsonl")) << "this, too";
  EXPECT_EQ(next_number(path("a.jsonl"), 1), 4);
  EXPECT_EQ(next_number(path("a.jsonl"), 4), 5);
}

}  // namespace
}  // namespace nade::xr
