#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "chooser.h"
#include "frame_costs.h"
#include "motion_files.h"
#include "nade/draw/gl_context.h"
#include "nade/io/hand_file.h"
#include "room.h"
#include "support/allocation_counter.h"
#include "xr/remote_hands.h"

namespace nade::xr {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;

/// A person of 1.6 m to the eyes whose right hand strokes a ball before them.
TrackedFrame frame_at(const HandPose& bind, int index) {
  const test::RemoteState person = test::looking_down();
  TrackedFrame frame;
  frame.time_ns = 11'111'111LL * (index + 1);
  frame.head = person.head;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    frame.eyes[eye].pose = person.head * person.eyes[eye];
    frame.eyes[eye].view = person.views[eye];
  }
  const Vec3 palm(0.04 * std::sin(0.05 * index), 1.18 + 0.005, -0.40);
  // Palm down, fingers ahead.
  const Pose level{palm, Quat::Identity()};
  frame.hands[index_of(bind.side)] = moved(bind, level * bind[Joint::palm].inverse());
  frame.draw = true;
  frame.focused = true;
  return frame;
}

class RoomTest : public testing::Test {
 protected:
  void SetUp() override {
    Result<draw::OffscreenContext> context = draw::OffscreenContext::create();
    if (!context) GTEST_SKIP() << context.error().message;
    context_.emplace(std::move(context).value());
    RoomSetup setup;
    for (const Handedness side : {Handedness::left, Handedness::right}) {
      const std::string file = std::string(name_of(side)) + ".glb";
      Result<HandMesh> mesh = load_hand_mesh(std::string(NADE_TEST_HANDS_DIR) + "/" + file, side);
      if (!mesh) GTEST_SKIP() << mesh.error().message;
      setup.hands[index_of(side)] = std::move(mesh).value();
    }
    setup.objects = {"sphere", "plane"};
    bind_ = setup.hands[index_of(Handedness::right)].bind;
    Result<std::unique_ptr<Room>> room = Room::create(std::move(setup));
    ASSERT_TRUE(room.ok());
    room_ = std::move(room).value();
    room_->set(chooser_.show());
  }
  void TearDown() override { room_.reset(); }

  std::optional<draw::OffscreenContext> context_;
  HandPose bind_;
  Chooser chooser_{{{"sphere", "plane"}}};
  std::unique_ptr<Room> room_;
};

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

TEST_F(RoomTest, FramesDoNotAllocate) {
  unsigned framebuffer = 0;
  unsigned texture = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &texture);
  glTextureStorage2D(texture, 1, GL_SRGB8_ALPHA8, kWidth, kHeight);
  glCreateFramebuffers(1, &framebuffer);
  glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, texture, 0);
  const draw::Target target{framebuffer, 0, 0, kWidth, kHeight};
  Show show = chooser_.show();
  show.shown = draw::Shown::both;
  room_->set(show);
  FrameCosts costs;
  const auto one = [&](int index) {
    const TrackedFrame frame = frame_at(bind_, index);
    room_->update(frame);
    room_->draw({draw::Sight{frame.eyes[0], target}, draw::Sight{frame.eyes[1], target}});
    costs.add(room_->cost());
  };
  for (int i = 0; i < 40; ++i) one(i);
  EXPECT_EQ(test::allocations_of([&] {
              for (int i = 40; i < 120; ++i) one(i);
            }),
            0U);
  std::printf("%s\n", as_text(costs).c_str());
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

TEST(MotionFiles, NamesBesideTheGivenOne) {
  EXPECT_EQ(corrected_path("a/stroke.jsonl.gz"), "a/stroke-corrected.jsonl.gz");
  EXPECT_EQ(corrected_path("stroke"), "stroke-corrected");
  EXPECT_EQ(numbered_path("stroke.jsonl", 1), "stroke.jsonl");
  EXPECT_EQ(numbered_path("stroke.jsonl", 2), "stroke-2.jsonl");
}

}  // namespace
}  // namespace nade::xr
