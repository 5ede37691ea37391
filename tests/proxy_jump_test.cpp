#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "nade/corrector.h"
#include "nade/mesh.h"
#include "support/hand_checks.h"
#include "support/meshes.h"
#include "support/pressed_hand.h"
#include "support/random.h"
#include "support/sanitized.h"

// A tracker that takes the hand elsewhere for a frame, as trackers do.

namespace nade {
namespace {

using test::kFrame_ns;
using test::least_room;

HandPose shifted(const HandPose& hand, const Vec3& way) {
  return moved(hand, {way, Quat::Identity()});
}

HandPose curled(const HandPose& hand, Digit digit) {
  HandAngles angles = measure_angles(hand);
  for (HingeAngles& hinge : angles[index_of(digit)]) hinge.flexion = 1.2;
  HandPose result = hand;
  set_digit(result, digit, pose_chain(measure_chain(hand, digit), angles[index_of(digit)]));
  return result;
}

/// 10 mm thick, its top at y = 0.
Object thin_board() {
  static const auto kBoard = MeshSurface::build(test::box_mesh({0.2F, 0.005F, 0.15F}), "board");
  return Object(**kBoard, {{{0.0, -0.005, 0.0}, Quat::Identity()}, 1.0});
}

/// What became of a hand at rest `depth_m` deep whose tracker errs in one frame.
struct Glitch {
  double deepest_m = 0.0;  ///< of the drawn skin in the object, from then on
  double fastest_m = 0.0;  ///< of the drawn hand in a frame, from the second after it on
  double away_m = 0.0;     ///< from the hand that is drawn without it, five frames after
};

template <class Error>
Glitch glitch_of(const Object& object, double depth_m, const Error& with_error) {
  constexpr int kWhen = 120;
  HandCorrector misled(test::settling());
  HandCorrector sure(test::settling());
  Glitch glitch;
  HandPose before;
  for (int i = 0; i < kWhen + 60; ++i) {
    const HandPose hand = test::on_the_way_down(i, 60, depth_m);
    const HandPose rests = sure.update(hand, object, i * kFrame_ns).pose;
    const HandPose seen = i == kWhen ? with_error(hand) : hand;
    const HandPose drawn = misled.update(seen, object, i * kFrame_ns).pose;
    if (i >= kWhen) glitch.deepest_m = std::max(glitch.deepest_m, -least_room(drawn, object, 0.1));
    if (i > kWhen + 1) glitch.fastest_m = std::max(glitch.fastest_m, largest_motion(before, drawn));
    if (i == kWhen + 5) glitch.away_m = largest_motion(rests, drawn);
    before = drawn;
  }
  return glitch;
}

template <class Error>
void expect_no_harm(const Error& with_error) {
  for (const bool flat : {true, false}) {
    for (const double depth_m : {0.005, 0.02}) {
      SCOPED_TRACE(testing::Message() << (flat ? "plane" : "ball") << ", " << depth_m << " m deep");
      const Object object = flat ? test::plane() : test::ball();
      const Glitch glitch = glitch_of(object, depth_m, with_error);
      EXPECT_LT(glitch.deepest_m, 0.001);
      EXPECT_LT(glitch.fastest_m, 0.002);
      EXPECT_LT(glitch.away_m, 0.01);
    }
  }
}

/// How far a hand at rest `depth_m` deep, whose tracker errs for some frames, is from the one drawn
/// without that, once it is back.
template <class Error>
double away_after(const Object& object, double depth_m, int frames, const Error& with_error) {
  constexpr int kFirst = 120;
  HandCorrector misled(test::settling());
  HandCorrector sure(test::settling());
  double away_m = 0.0;
  for (int i = 0; i < kFirst + frames + 60; ++i) {
    const HandPose hand = test::on_the_way_down(i, 60, depth_m);
    const HandPose rests = sure.update(hand, object, i * kFrame_ns).pose;
    const bool errs = i >= kFirst && i < kFirst + frames;
    const HandPose drawn =
        misled.update(errs ? with_error(hand) : hand, object, i * kFrame_ns).pose;
    if (i >= kFirst + frames) away_m = std::max(away_m, largest_motion(rests, drawn));
  }
  return away_m;
}

/// Up by 60 mm for a frame, and the hand was thrown 54 mm into the table; down, and it was 48 mm
/// over it and took a second to come back.
TEST(ProxyJump, AHandThatIsSeenElsewhereForAFrameStaysWhereItWas) {
  for (const Vec3& error : {Vec3(0.0, 0.06, 0.0), Vec3(0.0, -0.06, 0.0), Vec3(0.06, 0.0, 0.0),
                            Vec3(0.0, 0.03, 0.03), Vec3(-0.02, -0.04, 0.0)}) {
    if (test::kSanitized && error.y() != 0.06) continue;
    SCOPED_TRACE(error.transpose());
    expect_no_harm([&](const HandPose& hand) { return shifted(hand, error); });
  }
}

/// It was up to 78 mm off.
TEST(ProxyJump, AHandThatIsSeenTurnedForAFrameStaysWhereItWas) {
  for (const Vec3& axis : {Vec3(1.0, 0.0, 0.0), Vec3(0.0, 0.0, 1.0)}) {
    for (const double angle_rad : {-0.8, 0.8}) {
      SCOPED_TRACE(testing::Message() << angle_rad << " about " << axis.transpose());
      const Quat turn(Eigen::AngleAxisd(angle_rad, axis));
      expect_no_harm([&](const HandPose& hand) {
        return test::placed_hand(hand, hand[Joint::palm].position, turn);
      });
    }
  }
}

/// It was up to 69 mm off.
TEST(ProxyJump, AHandOneOfWhoseFingersIsSeenCurledForAFrameStaysWhereItWas) {
  for (const Digit digit : {Digit::index, Digit::little}) {
    expect_no_harm([&](const HandPose& hand) { return curled(hand, digit); });
  }
}

/// As a hidden finger is, that the tracker makes up. It stood 48 mm off the surface when it was
/// seen again, for most of a second.
TEST(ProxyJump, AHandOneOfWhoseFingersIsSeenCurledForAWhileStaysWhereItWas) {
  for (const Digit digit : {Digit::index, Digit::little}) {
    const auto hidden = [&](const HandPose& hand) { return curled(hand, digit); };
    for (const int frames : {3, 8, 18}) {
      SCOPED_TRACE(testing::Message()
                   << "digit " << index_of(digit) << ", " << frames << " frames");
      EXPECT_LT(away_after(test::ball(), 0.02, frames, hidden), 0.003);
    }
  }
}

/// It was taken for restless, and its palm drawn 5 mm down.
TEST(ProxyJump, AHandOneOfWhoseFingersIsSeenCurledForAWhileIsAsCalmAsBefore) {
  constexpr int kFirst = 180;
  const HandPose shape = test::bent_hand();
  HandCorrector misled(test::settling());
  HandCorrector sure(test::settling());
  double lower_m = 0.0;
  for (int i = 0; i < kFirst + 100; ++i) {
    const double time_s = i / 90.0;
    const HandPose hand = test::pressed_hand(-0.012 + 0.02 * std::min(1.0, time_s), 0.0,
                                             {0.05 * std::sin(time_s), 0.0, 0.0}, shape);
    const HandPose strokes = sure.update(hand, test::plane(), i * kFrame_ns).pose;
    const bool hidden = i >= kFirst && i < kFirst + 5;
    const HandPose seen = hidden ? curled(hand, Digit::index) : hand;
    const HandPose drawn = misled.update(seen, test::plane(), i * kFrame_ns).pose;
    const Joint palm = Joint::palm;
    lower_m = std::max(lower_m, strokes[palm].position.y() - drawn[palm].position.y());
  }
  EXPECT_LT(lower_m, 0.002);
}

/// As the other hand is that is taken for this one, or this one turned over. It came back to the
/// other side of a thin board, 80 mm off, and stayed there.
TEST(ProxyJump, AHandThatIsFarAwayForAWhileComesBackToWhereItWas) {
  const Quat over(Eigen::AngleAxisd(3.14, Vec3::UnitZ()));
  const auto at_the_other_hand = [](const HandPose& hand) {
    return shifted(hand, {-0.3, 0.05, 0.0});
  };
  const auto turned_over = [&](const HandPose& hand) {
    return test::placed_hand(hand, hand[Joint::palm].position, over);
  };
  for (const int frames : {1, 12}) {
    SCOPED_TRACE(testing::Message() << frames << " frames");
    EXPECT_LT(away_after(thin_board(), 0.04, frames, at_the_other_hand), 0.002);
    EXPECT_LT(away_after(thin_board(), 0.04, frames, turned_over), 0.002);
  }
}

/// Found anew after a fifth of a second, it was drawn on the other side of the board, 80 mm off.
TEST(ProxyJump, AHandThatPressesOnWhileItIsMissingComesBackToWhereItWas) {
  for (const int frames : {9, 45, 80}) {
    SCOPED_TRACE(testing::Message() << frames << " frames");
    const Object board = thin_board();
    HandCorrector missed(test::settling());
    HandCorrector sure(test::settling());
    double away_m = 0.0;
    for (int i = 0; i < 260; ++i) {
      const HandPose hand = shifted(test::on_the_way_down(i, 60, 0.04), {4e-4 * i, 0.0, 0.0});
      const HandPose strokes = sure.update(hand, board, i * kFrame_ns).pose;
      if (i >= 120 && i < 120 + frames) continue;
      const HandPose drawn = missed.update(hand, board, i * kFrame_ns).pose;
      if (i > 120) away_m = std::max(away_m, largest_motion(strokes, drawn));
    }
    EXPECT_LT(away_m, 0.002);
  }
}

/// Nothing holds it back there.
TEST(ProxyJump, AHandThatWasLiftedWhileItWasMissingIsDrawnAsItIs) {
  HandCorrector corrector(test::settling());
  for (int i = 0; i < 120; ++i) {
    corrector.update(test::on_the_way_down(i, 60, 0.02), test::plane(), i * kFrame_ns);
  }
  const HandPose found = test::pressed_hand(-0.03);
  const HandPose drawn = corrector.update(found, test::plane(), 165 * kFrame_ns).pose;
  EXPECT_EQ(largest_motion(found, drawn), 0.0);
}

/// It was drawn 57 mm from the person's.
TEST(ProxyJump, AHandThatIsFoundHigherAfterAFewFramesIsDrawnThere) {
  for (const bool flat : {true, false}) {
    SCOPED_TRACE(flat ? "plane" : "ball");
    const Object object = flat ? test::plane() : test::ball();
    HandCorrector corrector(test::settling());
    for (int i = 0; i < 120; ++i) {
      corrector.update(test::on_the_way_down(i, 60, 0.02), object, i * kFrame_ns);
    }
    const HandPose found = shifted(test::pressed_hand(0.02), {0.0, 0.09, 0.0});
    const HandPose drawn = corrector.update(found, object, 125 * kFrame_ns).pose;
    EXPECT_LT(largest_motion(found, drawn), 0.07);
  }
}

/// At 120 Hz, of a hand that strokes a ball: it was drawn 79 mm deep in it, and 79 mm off its way
/// in the mean.
TEST(ProxyJump, AHandStrokesOnThroughATrackersErrors) {
  constexpr double kRate = 120.0;
  const Object ball = test::ball();
  HandCorrector misled(test::settling());
  HandCorrector sure(test::settling());
  test::Random random;
  SCOPED_TRACE("NADE_TEST_SEED=" + std::to_string(test::seed()));
  double deepest_m = 0.0;
  double away_m = 0.0;
  int frames = 0;
  for (int i = 0; i < 20 * kRate; ++i) {
    const double time_s = i / kRate;
    const HandPose hand =
        test::pressed_hand(0.012 - 0.02 * std::sin(0.7 * time_s), 0.0,
                           {0.06 * std::sin(1.3 * time_s), 0.0, 0.04 * std::sin(2.1 * time_s)});
    const auto time_ns = std::llround(1e9 * time_s);
    const HandPose strokes = sure.update(hand, ball, time_ns).pose;
    const Vec3 error = random.uniform(0.01, 0.09) * random.direction();
    const bool errs = i > kRate && random.below(200) == 0;
    const HandPose drawn = misled.update(errs ? shifted(hand, error) : hand, ball, time_ns).pose;
    if (i < kRate) continue;
    deepest_m = std::max(deepest_m, -least_room(drawn, ball, 0.1));
    if (errs) continue;
    away_m += largest_motion(strokes, drawn);
    ++frames;
  }
  EXPECT_LT(deepest_m, 0.003);
  EXPECT_LT(away_m / frames, 0.02);
}

}  // namespace
}  // namespace nade
