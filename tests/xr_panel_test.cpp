#include <gtest/gtest.h>

#include "panel_touch.h"
#include "support/sample_hand.h"

namespace nade::xr {
namespace {

study::PanelView question() {
  study::PanelView view;
  view.heading = "Trial 3 of 6";
  view.lines = {"I felt as if I was touching the object."};
  view.rows.resize(2);
  for (int i = 1; i <= 7; ++i) view.rows[0].push_back({100 + i, std::to_string(i)});
  view.rows[1] = {{3, "back", false, false}, {2, "confirm"}};
  return view;
}

/// The sample hand, moved so that its index finger's skin is at a point of the panel.
HandPose finger_at(const Pose& panel, const Vec3& point) {
  HandPose hand = test::sample_hand();
  hand.radius[index_of(Joint::index_tip)] = 0.008;
  const Vec3 tip = panel.apply(point + Vec3(0.0, 0.0, 0.008));
  return moved(hand, {tip - hand[Joint::index_tip].position, Quat::Identity()});
}

Pose somewhere() {
  return {Vec3(0.1, 1.2, -0.5), Quat(Eigen::AngleAxisd(0.4, Vec3(0.3, 0.9, -0.2).normalized()))};
}

class Finger {
 public:
  explicit Finger(const PanelPicture& picture) : picture_(picture) {}
  std::optional<int> go(const Vec3& point) {
    return touch_.update(finger_at(panel_, point), std::nullopt, panel_, picture_, false).pressed;
  }
  void lose() { static_cast<void>(touch_.update({}, {}, panel_, picture_, false)); }

 private:
  const PanelPicture& picture_;
  Pose panel_ = somewhere();
  PanelTouch touch_;
};

const ButtonPlace& button(const PanelPicture& picture, int id) {
  for (const ButtonPlace& each : picture.buttons) {
    if (each.id == id) return each;
  }
  ADD_FAILURE() << "no button " << id;
  return picture.buttons.front();
}

TEST(Panel, EveryButtonHasItsPlace) {
  const PanelPicture picture = paint(question());
  ASSERT_EQ(picture.buttons.size(), 9U);
  for (const ButtonPlace& each : picture.buttons) {
    const Vec3 middle = middle_of(each);
    const auto found = picture.button_at(middle.x(), middle.y());
    EXPECT_EQ(found, each.enabled ? std::optional(each.id) : std::nullopt);
    EXPECT_LE(each.y + each.height, kPanelHeight_px);
  }
}

TEST(Panel, LongTextIsSetSmallerUntilItFits) {
  study::PanelView view = question();
  view.lines.assign(12, "A sentence of an instruction that is quite long and has to be broken.");
  const PanelPicture picture = paint(view);
  EXPECT_LE(picture.buttons.back().y + picture.buttons.back().height, kPanelHeight_px);
}

TEST(PanelTouch, FingerThroughAButtonPressesItOnce) {
  const PanelPicture picture = paint(question());
  const Vec3 five = middle_of(button(picture, 105));
  Finger finger(picture);
  EXPECT_FALSE(finger.go(five + Vec3(0.0, 0.0, 0.05)));
  EXPECT_FALSE(finger.go(five + Vec3(0.0, 0.0, 0.01)));
  EXPECT_EQ(finger.go(five - Vec3(0.0, 0.0, 0.002)), 105);
  EXPECT_FALSE(finger.go(five - Vec3(0.0, 0.0, 0.02)));
  // Trembling about the panel does not press again.
  EXPECT_FALSE(finger.go(five + Vec3(0.0, 0.0, 0.006)));
  EXPECT_FALSE(finger.go(five - Vec3(0.0, 0.0, 0.006)));
  EXPECT_FALSE(finger.go(five + Vec3(0.0, 0.0, 0.03)));
  EXPECT_EQ(finger.go(five - Vec3(0.0, 0.0, 0.004)), 105);
}

TEST(PanelTouch, ButtonIsTheOneThatIsGoneThrough) {
  const PanelPicture picture = paint(question());
  const Vec3 from = middle_of(button(picture, 101)) + Vec3(0.0, 0.0, 0.04);
  const Vec3 to = middle_of(button(picture, 107)) - Vec3(0.0, 0.0, 0.04);
  Finger finger(picture);
  EXPECT_FALSE(finger.go(from));
  EXPECT_EQ(finger.go(to), 104);  // half-way
}

TEST(PanelTouch, FromBehindAndBesideNothingIsPressed) {
  const PanelPicture picture = paint(question());
  const Vec3 five = middle_of(button(picture, 105));
  Finger finger(picture);
  EXPECT_FALSE(finger.go(five - Vec3(0.0, 0.0, 0.05)));
  EXPECT_FALSE(finger.go(five + Vec3(0.0, 0.0, 0.05)));
  EXPECT_FALSE(finger.go(five + Vec3(0.5, 0.0, 0.05)));
  EXPECT_FALSE(finger.go(five + Vec3(0.5, 0.0, -0.05)));
  EXPECT_FALSE(finger.go(middle_of(button(picture, 3)) + Vec3(0.0, 0.0, 0.05)));
  EXPECT_FALSE(finger.go(middle_of(button(picture, 3)) - Vec3(0.0, 0.0, 0.01)));
}

TEST(PanelTouch, HandThatWasLostHasToComeFromTheFront) {
  const PanelPicture picture = paint(question());
  const Vec3 five = middle_of(button(picture, 105));
  Finger finger(picture);
  EXPECT_FALSE(finger.go(five + Vec3(0.0, 0.0, 0.05)));
  finger.lose();
  EXPECT_FALSE(finger.go(five - Vec3(0.0, 0.0, 0.01)));
}

TEST(PanelTouch, PinchFromAfarPressesWhatIsPointedAt) {
  const PanelPicture picture = paint(question());
  const Pose panel = {Vec3(0.0, 1.5, -1.5), Quat::Identity()};
  const Pose head = {Vec3(0.0, 1.6, 0.0), Quat::Identity()};
  const Vec3 shoulder(0.16, 1.4, 0.0);
  const Vec3 target = panel.apply(middle_of(button(picture, 2)));
  const auto hand_with = [&](double apart_m) {
    HandPose hand = test::sample_hand();
    const Vec3 knuckle = shoulder + 0.3 * (target - shoulder);
    hand = moved(hand, {knuckle - hand[Joint::index_proximal].position, Quat::Identity()});
    hand[Joint::thumb_tip].position = hand[Joint::index_tip].position + Vec3(0.0, -apart_m, 0.0);
    return hand;
  };
  PanelTouch touch;
  const Touch open = touch.update(hand_with(0.05), head, panel, picture, true);
  EXPECT_FALSE(open.pressed);
  ASSERT_TRUE(open.cursor);
  EXPECT_LT((*open.cursor - target).norm(), 0.005);
  EXPECT_EQ(touch.update(hand_with(0.01), head, panel, picture, true).pressed, 2);
  EXPECT_FALSE(touch.update(hand_with(0.01), head, panel, picture, true).pressed);
  EXPECT_FALSE(touch.update(hand_with(0.02), head, panel, picture, true).pressed);
  EXPECT_FALSE(touch.update(hand_with(0.01), head, panel, picture, true).pressed);
}

}  // namespace
}  // namespace nade::xr
