#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "chooser.h"
#include "nade/draw/gl_context.h"
#include "nade/io/hand_file.h"
#include "room.h"
#include "xr/remote_hands.h"

namespace nade::xr {

constexpr int kWidth = 160;
constexpr int kHeight = 120;

/// A person of 1.6 m to the eyes who strokes a ball before them with the hand of that pose.
inline TrackedFrame frame_at(const HandPose& bind, int index) {
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
    furnish(setup);
    left_bind_ = setup.hands[index_of(Handedness::left)].bind;
    bind_ = setup.hands[index_of(Handedness::right)].bind;
    Result<std::unique_ptr<Room>> room = Room::create(std::move(setup));
    ASSERT_TRUE(room.ok());
    room_ = std::move(room).value();
    room_->set(chooser_.show());
  }
  void TearDown() override { room_.reset(); }
  /// What a test wants otherwise.
  virtual void furnish(RoomSetup& /*setup*/) {}

  std::optional<draw::OffscreenContext> context_;
  HandPose left_bind_;
  HandPose bind_;  ///< the right hand's
  Chooser chooser_{{{"sphere", "plane"}}};
  std::unique_ptr<Room> room_;
};

}  // namespace nade::xr
