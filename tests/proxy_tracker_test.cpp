#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "nade/corrector.h"
#include "nade/eval/noise.h"
#include "nade/skeleton.h"
#include "support/hand_checks.h"
#include "support/pressed_hand.h"

// The object draws a restless hand more strongly than a calm one.

namespace nade {
namespace {

using test::gripping_hand;
using test::kFrame_ns;
using test::plane;
using test::pressed_hand;
using test::settling;

/// How far a restless hand shifts by itself from frame to frame, as trackers' hands do.
constexpr double kTremor_m = 0.0003;

HandPose trembling(const HandPose& hand, Random& random) {
  const Vec3 shift(random.normal(), random.normal(), random.normal());
  return moved(hand, Pose{kTremor_m * shift, Quat::Identity()});
}

/// The drawn hand after three seconds, come down from 100 mm in the first.
HandPose drawn_at_rest(const HandPose& tracked, bool trembles) {
  HandCorrector corrector(settling());
  Random random(7);
  HandPose drawn;
  for (int i = 0; i < 270; ++i) {
    const double lift_m = 0.1 * std::max(0.0, 1.0 - i / 90.0);
    const HandPose hand = moved(tracked, Pose{Vec3(0.0, lift_m, 0.0), Quat::Identity()});
    drawn =
        corrector.update(trembles ? trembling(hand, random) : hand, plane(), i * kFrame_ns).pose;
  }
  return drawn;
}

/// Samples too rare to tell unrest by are no unrest.
TEST(ProxyTracker, AHandThatIsSeenRarelyIsNoMoreRestless) {
  const auto drawn_tip_m = [](int every) {
    HandCorrector corrector(settling());
    HandPose pose;
    for (int i = 0; i < 180; i += every) {
      const Vec3 along(0.05 * std::sin(0.01 * i), 0.0, 0.05 * std::cos(0.01 * i));
      pose = corrector.update(pressed_hand(0.02, 0.6, along), plane(), i * kFrame_ns).pose;
    }
    return pose[Joint::middle_tip].position.y();
  };
  EXPECT_NEAR(drawn_tip_m(6), drawn_tip_m(1), 0.001) << "15 a second";
}

/// Hand and object go along with a car; or the world's origin is moved under both, as engines do
/// and as a turn of the player does. It was drawn as a restless one, 18 mm off.
TEST(ProxyTracker, AHandThatIsMovedWithTheObjectIsNoMoreRestless) {
  const HandPose shape = test::bent_hand();
  const auto moves = std::to_array<std::pair<const char*, Pose (*)(double)>>({
      {"car",
       [](double time_s) {
         const double bumps_m = 0.02 * std::sin(12.6 * time_s) + 0.004 * std::sin(69.1 * time_s);
         return Pose{Vec3(20.0 * time_s, bumps_m, 0.0), Quat::Identity()};
       }},
      {"origin",
       [](double time_s) {
         return Pose{std::floor(2.0 * time_s) * Vec3(100.0, 0.0, -50.0), Quat::Identity()};
       }},
      {"turns",
       [](double time_s) {
         const double angle_rad = 0.5 * std::floor(2.0 * time_s);
         return Pose{Vec3::Zero(), Quat(Eigen::AngleAxisd(angle_rad, Vec3::UnitY()))};
       }},
  });
  for (const auto& [name, moved_by] : moves) {
    SCOPED_TRACE(name);
    HandCorrector at_rest(settling());
    HandCorrector along(settling());
    double away_m = 0.0;
    for (int i = 0; i < 270; ++i) {
      const double time_s = i / 90.0;
      const HandPose hand = pressed_hand(-0.012 + 0.02 * std::min(1.0, time_s), 0.0,
                                         {0.05 * std::sin(time_s), 0.0, 0.0}, shape);
      const HandPose rests = at_rest.update(hand, plane(), i * kFrame_ns).pose;
      const Pose move = moved_by(time_s);
      const Object object(test::kPlane, {move, 1.0});
      const HandPose drawn = along.update(moved(hand, move), object, i * kFrame_ns).pose;
      away_m = std::max(away_m, largest_motion(moved(rests, move), drawn));
    }
    EXPECT_LT(away_m, 1e-4);
  }
}

/// Drawn as strongly as an open hand, a fist on a table was opened by 48 degrees.
TEST(ProxyTracker, AFistStaysAFist) {
  const HandPose tracked = pressed_hand(0.02, 0.0, Vec3::Zero(), gripping_hand());
  const double calm_rad = curl_of(measure_angles(drawn_at_rest(tracked, false)));
  EXPECT_NEAR(curl_of(measure_angles(drawn_at_rest(tracked, true))), calm_rad, 0.05);
}

/// A finger that holds the palm up was opened by it.
TEST(ProxyTracker, OneCurledFingerStaysCurled) {
  HandAngles angles = test::relaxed_angles();
  for (std::size_t hinge = 1; hinge < kHingeCount; ++hinge) {
    angles[index_of(Digit::index)][hinge].flexion = 1.2;
  }
  const HandPose hand = test::generic_size_hand(Handedness::right, angles);
  const HandPose drawn = drawn_at_rest(pressed_hand(0.02, 0.0, Vec3::Zero(), hand), true);
  EXPECT_GT(curl_of(measure_angles(drawn)[index_of(Digit::index)]), 2.0);
}

/// Frames that are all the same for minutes, as of a tracker that is stuck: what was smoothed over
/// them sank until it was divided by nothing.
TEST(ProxyTracker, AHandThatKeepsStillForMinutesStaysWhereItIs) {
  HandCorrector corrector(settling());
  Random random(7);
  HandPose rested;
  for (int i = 0; i < 15000; ++i) {
    const HandPose tracked = pressed_hand(std::min(0.02, -0.1 + 0.001 * i));
    const HandPose& drawn =
        corrector.update(i < 200 ? trembling(tracked, random) : tracked, plane(), i * kFrame_ns)
            .pose;
    if (i == 1000) rested = drawn;
    if (i > 1000) {
      ASSERT_LT(largest_motion(rested, drawn), 0.001) << "frame " << i;
    }
  }
}

/// A smooth stroke whose poses come twice, in one instant or one after the other, is as calm.
TEST(ProxyTracker, PosesThatRepeatAreNoTremor) {
  const auto drawn_height_m = [](int times, std::int64_t apart_ns) {
    HandCorrector corrector(settling());
    double height_m = 0.0;
    for (int i = 0; i < 270; ++i) {
      const double lift_m = 0.1 * std::max(0.0, 1.0 - i / 90.0);
      const Vec3 along(0.0, lift_m, 0.1 * std::sin(0.03 * i));
      const HandPose tracked = pressed_hand(0.02, 0.6, along);
      for (int k = 0; k < times; ++k) {
        const std::int64_t time_ns = i * (apart_ns > 0 ? 2 : 1) * kFrame_ns + k * apart_ns;
        height_m = corrector.update(tracked, plane(), time_ns).pose[Joint::index_tip].position.y();
      }
    }
    return height_m;
  };
  const double once_m = drawn_height_m(1, 0);
  EXPECT_NEAR(drawn_height_m(2, 0), once_m, 0.005);
  EXPECT_NEAR(drawn_height_m(2, kFrame_ns), once_m, 0.008);
}

/// A stroke of a hand with bent fingers at 120 Hz, once with the times of its frames as they are
/// and once with others.
struct TimedStroke {
  double apart_m = 0.0;          ///< that the two are drawn, at the most
  double square_m2 = 0.0;        ///< of the drawn joints' second differences
  double other_square_m2 = 0.0;  ///< the same with the other times
};

template <class Clock>
TimedStroke stroke_timed_by(const Clock& read) {
  const HandPose shape = test::bent_hand();
  HandCorrector exact(settling());
  HandCorrector other(settling());
  TimedStroke stroke;
  std::array<HandPose, 3> last;
  std::array<HandPose, 3> last_other;
  const auto add_square = [](const HandPose& drawn, int frame, auto& poses, double& square_m2) {
    poses = {poses[1], poses[2], drawn};
    for (std::size_t j = 0; j < kJointCount && frame > 150; ++j) {
      const auto joint = [&](std::size_t i) { return poses[i].joints[j].position; };
      square_m2 += (joint(0) + joint(2) - 2.0 * joint(1)).squaredNorm();
    }
  };
  for (int i = 0; i < 480; ++i) {
    const double time_s = i / 120.0;
    const HandPose hand = pressed_hand(-0.05 + 0.06 * std::min(1.0, time_s), 0.0,
                                       {0.06 * std::sin(1.5 * time_s), 0.0, 0.0}, shape);
    const HandPose drawn = exact.update(hand, test::ball(), std::llround(1e9 * time_s)).pose;
    const HandPose other_drawn = other.update(hand, test::ball(), read(time_s)).pose;
    stroke.apart_m = std::max(stroke.apart_m, largest_motion(drawn, other_drawn));
    add_square(drawn, i, last, stroke.square_m2);
    add_square(other_drawn, i, last_other, stroke.other_square_m2);
  }
  return stroke;
}

/// It was taken for restless and drawn up to 23 mm off.
TEST(ProxyTracker, AHandThatIsTimedInWholeMillisecondsIsNotRestless) {
  const TimedStroke stroke = stroke_timed_by(
      [](double time_s) { return 1'000'000 * static_cast<std::int64_t>(1e3 * time_s); });
  EXPECT_LT(stroke.apart_m, 0.001);
}

/// Now and then they go back: the hand was found anew there. And where they do not, it coasted too
/// far and too short.
TEST(ProxyTracker, AHandWhoseTimesAreOffGoesAsSmoothly) {
  Random random(11);
  const TimedStroke stroke = stroke_timed_by(
      [&](double time_s) { return std::llround(1e9 * (time_s + 0.002 * random.normal())); });
  EXPECT_LT(stroke.apart_m, 0.004);
  EXPECT_LT(stroke.other_square_m2, 1.5 * stroke.square_m2);
}

}  // namespace
}  // namespace nade
