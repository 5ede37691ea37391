#include "nade/corrector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "nade/io/mesh_file.h"
#include "nade/mesh.h"
#include "support/allocation_counter.h"
#include "support/hand_checks.h"
#include "support/meshes.h"
#include "support/pressed_hand.h"
#include "support/sample_hand.h"

namespace nade {
namespace {

using test::all_finite;
using test::ball;
using test::generic_size_hand;
using test::kFrame_ns;
using test::plane;
using test::pressed_hand;
using test::rad;
using test::same_bits;

CorrectorOptions by(Method method) {
  CorrectorOptions options;
  options.method = method;
  return options;
}
CorrectorOptions by_paper() { return by(Method::paper); }

/// What holds whatever the method.
class CorrectorOfAnyMethod : public testing::TestWithParam<Method> {
 protected:
  CorrectorOptions options_ = by(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Corrector, CorrectorOfAnyMethod,
                         testing::Values(Method::paper, Method::nade),
                         [](const auto& tested) { return std::string(name_of(tested.param)); });

double palm_skin() { return generic_skin_depths()[Part::palm]; }

double signed_distance(const Object& object, const Vec3& point) {
  SurfaceHint hint;
  return object.closest_point(point, std::numeric_limits<double>::infinity(), hint)
      ->signed_distance;
}

TEST_P(CorrectorOfAnyMethod, AnUntouchedHandComesBackBitEqual) {
  for (const double above_m : {0.2, 0.3}) {
    HandCorrector corrector(options_);
    for (int i = 0; i < 10; ++i) {
      const HandPose hand = pressed_hand(-above_m, 0.1, {0.01 * i, 0.0, 0.0});
      const CorrectedHand& result = corrector.update(hand, ball(), i * kFrame_ns);
      EXPECT_EQ(result.status, HandStatus::free);
      EXPECT_TRUE(same_bits(result.pose, hand));
    }
  }
}

TEST(Corrector, SaysWhyAHandCannotBeUsed) {
  for (const Method method : {Method::none, Method::paper, Method::nade}) {
    HandCorrector corrector(by(method));
    HandPose hand = pressed_hand(0.02);
    EXPECT_FALSE(corrector.update(hand, plane(), 0).fault);
    for (Pose& joint : hand.joints) joint.position = hand[Joint::wrist].position;
    const CorrectedHand& point = corrector.update(hand, plane(), kFrame_ns);
    EXPECT_EQ(point.status, HandStatus::untracked);
    EXPECT_EQ(point.fault, HandFault::no_length);
    EXPECT_TRUE(same_bits(point.pose, hand));
    hand = pressed_hand(0.02);
    hand[Joint::palm].rotation.coeffs() *= 0.3;
    EXPECT_EQ(corrector.update(hand, plane(), 2 * kFrame_ns).fault, HandFault::rotation_not_unit);
  }
}

TEST(Corrector, RotationsOfFloatsAreTaken) {
  for (const Method method : {Method::paper, Method::nade}) {
    HandCorrector exact(by(method));
    HandCorrector rough(by(method));
    const HandPose hand = pressed_hand(0.02);
    HandPose longer = hand;
    for (Pose& joint : longer.joints) joint.rotation.coeffs() *= 1.0006;
    const CorrectedHand& expected = exact.update(hand, plane(), 0);
    const CorrectedHand& result = rough.update(longer, plane(), 0);
    EXPECT_EQ(result.status, HandStatus::corrected);
    for (std::size_t i = 0; i < kJointCount; ++i) {
      EXPECT_LT((result.pose.joints[i].position - expected.pose.joints[i].position).norm(), 1e-9);
      EXPECT_NEAR(result.pose.joints[i].rotation.norm(), 1.0, 1e-9);
    }
  }
}

TEST(Corrector, MethodNonePassesTheHandThrough) {
  HandCorrector corrector(by(Method::none));
  const HandPose hand = pressed_hand(0.03);
  EXPECT_TRUE(same_bits(corrector.update(hand, plane(), 0).pose, hand));
}

TEST(Corrector, PressedSkinLiesOnTheSurface) {
  for (const Object& object : {plane(), ball()}) {
    for (double tilt : {0.0, rad(10.0), rad(-10.0)}) {
      for (double depth_m = 0.016; depth_m < 0.040; depth_m += 0.004) {
        HandCorrector corrector(by_paper());
        const CorrectedHand& result = corrector.update(pressed_hand(depth_m, tilt), object, 0);
        ASSERT_TRUE(result.contacts[0].has_value());
        const Vec3 skin = result.pose[Joint::palm].position - palm_skin() * result.pose.back();
        EXPECT_LT(std::abs(signed_distance(object, skin)), 1e-4);
        for (std::size_t i = 1; i < kPartCount; ++i) {
          const auto& contact = result.contacts[i];
          if (!contact || contact->turn < 1.0) continue;
          const Vec3 tip = result.pose[joint_of(part_at(i))].position;
          const DigitChain chain = measure_chain(result.pose, digit_at(i - 1));
          const bool reachable = (contact->target - chain.base).norm() < 0.99 * chain.length();
          if (!reachable || i == index_of(Part::thumb)) continue;
          EXPECT_NEAR(signed_distance(object, tip), contact->skin_depth_m, 1e-4)
              << name_of(part_at(i)) << " at depth " << depth_m << " tilt " << tilt;
        }
      }
    }
  }
}

TEST(Corrector, ThumbSkinLiesOnThePlaneWhereItCanReach) {
  HandCorrector corrector(by_paper());
  const CorrectedHand& result = corrector.update(pressed_hand(0.02), plane(), 0);
  const auto& contact = result.contacts[index_of(Part::thumb)];
  ASSERT_TRUE(contact.has_value());
  EXPECT_NEAR(result.pose[Joint::thumb_tip].position.y(), contact->skin_depth_m, 1e-4);
}

TEST(Corrector, TheCorrectionStartsFromNothingAtFirstTouch) {
  for (const Object& object : {plane(), ball()}) {
    for (double tilt : {0.0, rad(15.0), rad(-15.0)}) {
      HandCorrector corrector(by_paper());
      bool touched = false;
      for (int i = 0; i < 4000 && !touched; ++i) {
        const HandPose hand = pressed_hand(-0.1 + i * 5e-5, tilt);
        const CorrectedHand& result = corrector.update(hand, object, i * kFrame_ns);
        touched = result.status == HandStatus::corrected;
        if (touched) {
          EXPECT_LT(largest_motion(result.pose, hand), 1e-4);
        }
      }
      EXPECT_TRUE(touched);
    }
  }
}

TEST(Corrector, TheCorrectionIsContinuousInDepth) {
  CorrectorOptions options = by_paper();
  options.release_s = 0.0;
  constexpr double kStep_m = 2e-5;
  for (double tilt : {0.0, rad(15.0)}) {
    HandCorrector corrector(options);
    HandPose before = pressed_hand(-0.06, tilt);
    for (int i = 0; i < 4500; ++i) {
      const HandPose hand = pressed_hand(-0.06 + i * kStep_m, tilt);
      const CorrectedHand& result = corrector.update(hand, plane(), i * kFrame_ns);
      ASSERT_LT(largest_motion(result.pose, before), 30.0 * kStep_m)
          << "depth " << -0.06 + i * kStep_m;
      before = result.pose;
    }
  }
}

TEST(Corrector, PaperLiteralJumpsOnEntryAsThePaperPrintsIt) {
  HandCorrector corrector(paper_literal());
  double largest_m = 0.0;
  HandPose before = pressed_hand(-0.06);
  for (int i = 0; i < 900; ++i) {
    const CorrectedHand& result =
        corrector.update(pressed_hand(-0.06 + i * 1e-4), plane(), i * kFrame_ns);
    largest_m = std::max(largest_m, largest_motion(result.pose, before));
    before = result.pose;
  }
  EXPECT_GT(largest_m, 0.004);
}

TEST(Corrector, MovedTogetherHandAndObjectGiveTheSameAnswer) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 50; ++i) {
    const Pose motion{Vec3(normal(random), normal(random), normal(random)),
                      Quat(Eigen::AngleAxisd(
                          normal(random), Vec3(normal(random), normal(random), 1.0).normalized()))};
    const Object object(test::kBall, {motion * ball().placement().pose, 1.0});
    HandCorrector here(by_paper());
    HandCorrector there(by_paper());
    for (int frame = 0; frame < 5; ++frame) {
      const HandPose hand = pressed_hand(0.004 * frame, rad(12.0), {0.005 * frame, 0.0, 0.0});
      const HandPose expected = moved(here.update(hand, ball(), frame * kFrame_ns).pose, motion);
      const HandPose found = there.update(moved(hand, motion), object, frame * kFrame_ns).pose;
      EXPECT_LT(largest_motion(found, expected), 1e-5);
    }
  }
}

TEST(Corrector, LeftAndRightAreMirrored) {
  for (double depth_m : {0.005, 0.02, 0.035}) {
    HandCorrector left(by_paper());
    HandCorrector right(by_paper());
    const HandPose hand = pressed_hand(depth_m, rad(8.0), {0.02, 0.0, 0.0});
    const HandPose expected = mirrored(right.update(hand, ball(), 0).pose);
    EXPECT_LT(largest_motion(left.update(mirrored(hand), ball(), 0).pose, expected), 1e-6);
  }
}

TEST(Corrector, ALargerHandHasThickerSkin) {
  for (double scale : {0.8, 1.25}) {
    HandPose hand = generic_size_hand();
    for (Pose& joint : hand.joints) joint.position *= scale;
    hand = test::placed_hand(hand, {0.0, scale * palm_skin() - 0.02, 0.0});
    HandCorrector corrector(by_paper());
    const CorrectedHand& result = corrector.update(hand, plane(), 0);
    EXPECT_NEAR(result.pose[Joint::palm].position.y(), scale * palm_skin(), 1e-6);
  }
}

/// A tracker that errs by a tenth does not change the hand that is drawn.
TEST(Corrector, AKnownLengthOfTheHandCountsMoreThanTheTrackers) {
  HandPose hand = generic_size_hand();
  for (Pose& joint : hand.joints) joint.position *= 1.1;
  hand = test::placed_hand(hand, {0.0, palm_skin() - 0.02, 0.0});
  CorrectorOptions options = by_paper();
  options.hand_length_m = kGenericHandLength;
  HandCorrector corrector(options);
  const CorrectedHand& result = corrector.update(hand, plane(), 0);
  EXPECT_NEAR(result.pose[Joint::palm].position.y(), palm_skin(), 1e-6);
}

TEST(Corrector, ByThePapersMethodAnotherObjectIsMetAnew) {
  CorrectorOptions options;
  options.method = Method::paper;
  HandCorrector corrector(options);
  const PlaneSurface one;
  const PlaneSurface other;
  const HandPose tracked = pressed_hand(0.02);
  const HandPose leaning =
      moved(tracked, {{0.0, -0.03, 0.0}, Quat(Eigen::AngleAxisd(-0.9, Vec3::UnitZ()))});
  (void)corrector.update(leaning, Object(one), 0);
  const CorrectedHand& result = corrector.update(tracked, Object(other), kFrame_ns);
  const auto& palm = result.contacts[index_of(Part::palm)];
  ASSERT_TRUE(palm);
  EXPECT_NEAR(palm->ray_direction.y(), 1.0, 1e-9);
}

TEST(Corrector, BelievableRadiiAreUsedAndOthersAreNot) {
  HandPose hand = pressed_hand(0.03);
  EXPECT_FALSE(believable_radii(hand).has_value());
  hand.radius.fill(0.01);
  EXPECT_FALSE(believable_radii(hand).has_value());
  hand.radius[index_of(Joint::wrist)] = 0.02;
  hand.radius[index_of(Joint::index_tip)] = 0.0055;
  ASSERT_TRUE(believable_radii(hand).has_value());
  HandCorrector corrector(by_paper());
  const CorrectedHand& result = corrector.update(hand, plane(), 0);
  EXPECT_NEAR(result.pose[Joint::index_tip].position.y(), 0.0055, 1e-5);
  EXPECT_NEAR(result.pose[Joint::palm].position.y(), palm_skin(), 1e-6);
}

TEST(Corrector, WhatIsLeftAtAnEdgeIsReleasedAndNotDropped) {
  // The object vanishes under the pressed hand: the plainest edge there is.
  HandCorrector corrector(by_paper());
  const Object gone(test::kPlane, {{{0.0, -5.0, 0.0}, Quat::Identity()}, 1.0});
  const HandPose hand = pressed_hand(0.03);
  HandPose before = corrector.update(hand, plane(), 0).pose;
  std::int64_t time_ns = 0;
  double largest_m = 0.0;
  HandStatus status = HandStatus::corrected;
  while (status != HandStatus::free && time_ns < 1'000'000'000) {
    time_ns += kFrame_ns;
    const CorrectedHand& result = corrector.update(hand, gone, time_ns);
    status = result.status;
    largest_m = std::max(largest_m, largest_motion(result.pose, before));
    before = result.pose;
  }
  EXPECT_LT(largest_m, 0.008);
  EXPECT_GE(time_ns, 150'000'000);
  EXPECT_LE(time_ns, 300'000'000);
  EXPECT_TRUE(same_bits(before, hand));
}

TEST_P(CorrectorOfAnyMethod, APoseThatCannotBeUsedComesBackAsItIs) {
  HandCorrector corrector(options_);
  (void)corrector.update(pressed_hand(0.02), plane(), 0);
  HandPose broken = pressed_hand(0.02);
  broken[Joint::ring_distal].position.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(corrector.update(broken, plane(), kFrame_ns).status, HandStatus::untracked);
  EXPECT_EQ(corrector.update(pressed_hand(0.02), plane(), 2 * kFrame_ns).status,
            HandStatus::corrected);
}

TEST_P(CorrectorOfAnyMethod, TimeThatGoesBackStartsAnew) {
  HandCorrector corrector(options_);
  (void)corrector.update(pressed_hand(0.03), plane(), 1'000'000'000);
  const HandPose hand = pressed_hand(-0.2);
  const CorrectedHand& result = corrector.update(hand, plane(), 0);
  EXPECT_EQ(result.status, HandStatus::free);
  EXPECT_TRUE(same_bits(result.pose, hand));
}

/// As where a runtime foretells a frame's display time anew: by a frame or two.
TEST_P(CorrectorOfAnyMethod, TimeThatGoesBackByTwoFramesDoesNotMoveTheHand) {
  HandCorrector corrector(options_);
  std::int64_t time_ns = 0;
  HandPose drawn;
  for (int i = 0; i < 60; ++i, time_ns += kFrame_ns) {
    drawn = corrector.update(pressed_hand(0.03), plane(), time_ns).pose;
  }
  time_ns -= 3 * kFrame_ns;
  for (int i = 0; i < 5; ++i, time_ns += kFrame_ns) {
    const CorrectedHand& result = corrector.update(pressed_hand(0.03), plane(), time_ns);
    EXPECT_LT(largest_motion(result.pose, drawn), 0.001) << i;
    drawn = result.pose;
  }
}

/// As where a program draws two eyes, or a paused one draws again.
TEST_P(CorrectorOfAnyMethod, AskedTwiceItGivesTheSameAnswerAndChangesNothing) {
  HandCorrector once(options_);
  HandCorrector twice(options_);
  for (int i = 0; i < 60; ++i) {
    const HandPose hand = test::on_the_way_down(i, 20, 0.03, 0.1);
    const HandPose expected = once.update(hand, ball(), i * kFrame_ns).pose;
    EXPECT_TRUE(same_bits(twice.update(hand, ball(), i * kFrame_ns).pose, expected)) << i;
    EXPECT_TRUE(same_bits(twice.update(hand, ball(), i * kFrame_ns).pose, expected)) << i;
  }
}

TEST_P(CorrectorOfAnyMethod, APreviewCarriesTheLatestCorrectionOver) {
  HandCorrector corrector(options_);
  const HandPose above = pressed_hand(-0.2);
  EXPECT_TRUE(same_bits(corrector.preview(above), above));
  HandPose drawn;
  for (int i = 0; i < 40; ++i) {
    drawn = corrector.update(test::on_the_way_down(i, 20, 0.03, 0.1), plane(), i * kFrame_ns).pose;
  }
  const HandPose last = test::on_the_way_down(39, 20, 0.03, 0.1);
  EXPECT_LT(largest_motion(corrector.preview(last), drawn), 1e-12);
  const Vec3 along(0.004, 0.0, 0.001);
  HandPose newer = last;
  for (Pose& joint : newer.joints) joint.position += along;
  HandPose moved = drawn;
  for (Pose& joint : moved.joints) joint.position += along;
  EXPECT_LT(largest_motion(corrector.preview(newer), moved), 1e-12);
  EXPECT_TRUE(same_bits(corrector.update(last, plane(), 39 * kFrame_ns).pose, drawn));
  HandPose other = newer;
  other.side = Handedness::left;
  EXPECT_TRUE(same_bits(corrector.preview(other), other));
  HandPose broken = newer;
  broken[Joint::ring_tip].position.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(corrector.preview(broken)[Joint::ring_tip].position.x()));
}

/// A finger that goes on bending does so in the preview.
TEST_P(CorrectorOfAnyMethod, APreviewBendsAsTheHandBends) {
  HandCorrector corrector(options_);
  HandPose drawn;
  for (int i = 0; i < 40; ++i) {
    drawn = corrector.update(test::on_the_way_down(i, 20, 0.02), plane(), i * kFrame_ns).pose;
  }
  HandPose newer = test::on_the_way_down(39, 20, 0.02);
  const Pose base = newer[Joint::index_proximal];
  const Quat turn(Eigen::AngleAxisd(0.1, base.rotation * Vec3::UnitX()));
  for (std::size_t i = index_of(Joint::index_proximal); i <= index_of(Joint::index_tip); ++i) {
    Pose& joint = newer.joints[i];
    joint.position = base.position + turn * (joint.position - base.position);
    joint.rotation = turn * joint.rotation;
  }
  const HandPose preview = corrector.preview(newer);
  const HandAngles before = measure_angles(drawn);
  const HandAngles after = measure_angles(preview);
  EXPECT_NEAR(after[1][0].flexion - before[1][0].flexion, -0.1, 0.01);
  EXPECT_NEAR(after[2][0].flexion, before[2][0].flexion, 1e-9);
  EXPECT_LT((preview[Joint::middle_tip].position - drawn[Joint::middle_tip].position).norm(),
            1e-12);
}

TEST(Corrector, OptionsAreCheckedByAFunction) {
  EXPECT_TRUE(check_options(CorrectorOptions()).ok());
  EXPECT_TRUE(check_options(paper_literal()).ok());
  CorrectorOptions options;
  options.hand_length_m = 80.0;
  EXPECT_EQ(check_options(options).error().message,
            "hand_length_m: expected 0.000000 to 0.500000, found 80.000000");
  options = {};
  options.settle.softness_m = std::nan("");
  EXPECT_FALSE(check_options(options).ok());
  options = {};
  options.settle.softness_depth_m = 0.0;
  EXPECT_EQ(check_options(options).error().message,
            "softness_depth_m: expected above 0, found 0.000000");
  options = {};
  options.flesh[0] = std::make_shared<HandFlesh>(generic_flesh(Handedness::right));
  EXPECT_EQ(check_options(options).error().message, "flesh: expected a hand's on its own side");
}

TEST_P(CorrectorOfAnyMethod, DegenerateHandsGiveFinitePoses) {
  HandPose point = pressed_hand(0.02);
  for (Pose& joint : point.joints) joint.position = Vec3(0.0, -0.01, 0.0);
  HandPose folded = pressed_hand(0.02);
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    folded[joints_of(digit_at(d)).tip] = folded[hinge_joint(digit_at(d), 0)];
  }
  HandPose stump = pressed_hand(0.02);
  for (std::size_t i = 1; i <= kHingeCount; ++i) {
    stump[hinge_joint(Digit::index, i)].position = stump[hinge_joint(Digit::index, 0)].position;
  }
  HandPose away = test::placed_hand(generic_size_hand(), {0.0, -3.0, 0.0});
  for (const HandPose& hand : {point, folded, stump, away}) {
    HandCorrector corrector(options_);
    EXPECT_TRUE(all_finite(corrector.update(hand, plane(), 0).pose));
    EXPECT_TRUE(all_finite(corrector.update(hand, ball(), kFrame_ns).pose));
  }
}

TEST(Corrector, AMeshSphereGivesTheExactSpheresCorrections) {
  const auto mesh = MeshSurface::build(test::uv_sphere(0.15F, 200, 201), "sphere");
  ASSERT_TRUE(mesh.ok());
  const Object object(**mesh, ball().placement());
  HandCorrector exact(by_paper());
  HandCorrector meshed(by_paper());
  for (int i = 0; i < 60; ++i) {
    const HandPose hand = pressed_hand(0.03 * i / 60.0, rad(8.0), {0.0005 * i, 0.0, 0.0});
    const HandPose expected = exact.update(hand, ball(), i * kFrame_ns).pose;
    const HandPose found = meshed.update(hand, object, i * kFrame_ns).pose;
    EXPECT_LT(largest_motion(found, expected), 5e-4) << "frame " << i;
    for (std::size_t k = 0; k < kJointCount; ++k) {
      EXPECT_LT(found.joints[k].rotation.angularDistance(expected.joints[k].rotation), rad(0.5))
          << "frame " << i << ", " << name_of(joint_at(k));
    }
  }
}

/// The dog, and a hand that comes down on its back, strokes along it 25 mm deep and leaves.
struct DogStroke {
  std::unique_ptr<MeshSurface> dog;
  std::vector<HandPose> hands;
};

std::optional<DogStroke> stroke_the_dog() {
  const auto file = load_mesh(NADE_TEST_DOG);
  if (!file.ok()) return std::nullopt;
  const auto back = std::find_if(file->places.begin(), file->places.end(),
                                 [](const MeshPlace& place) { return place.name == "back"; });
  auto dog = MeshSurface::build(file->soup, "dog");
  if (back == file->places.end() || !dog.ok()) return std::nullopt;
  DogStroke stroke{std::move(dog.value()), {}};
  constexpr int kFrames = 150;
  for (int i = 0; i < kFrames; ++i) {
    const double depth_m = std::min({0.025, 0.002 * i - 0.03, 0.002 * (kFrames - i) - 0.03});
    const HandPose hand = pressed_hand(depth_m, rad(6.0), {0.0, 0.0, 0.05 - 0.0007 * i});
    stroke.hands.push_back(moved(hand, back->pose));
  }
  return stroke;
}

TEST_P(CorrectorOfAnyMethod, AFrameOnTheDogAllocatesNothing) {
  const auto stroke = stroke_the_dog();
  if (!stroke) GTEST_SKIP() << NADE_TEST_DOG << ": not here";
  const Object object(*stroke->dog);
  HandCorrector corrector(options_);
  std::size_t corrected = 0;
  const auto count = test::allocations_of([&] {
    for (std::size_t i = 0; i < stroke->hands.size(); ++i) {
      const auto time_ns = static_cast<std::int64_t>(i) * kFrame_ns;
      const CorrectedHand& hand = corrector.update(stroke->hands[i], object, time_ns);
      if (hand.status == HandStatus::corrected) ++corrected;
    }
  });
  EXPECT_EQ(count, 0u);
  EXPECT_GT(corrected, stroke->hands.size() / 2);
}

TEST_P(CorrectorOfAnyMethod, EveryRunOnTheDogGivesTheSameBits) {
  const auto first = stroke_the_dog();
  const auto second = stroke_the_dog();
  if (!first || !second) GTEST_SKIP() << NADE_TEST_DOG << ": not here";
  const Object object(*first->dog);
  const Object built_again(*second->dog);
  HandCorrector here(options_);
  HandCorrector there(options_);
  for (std::size_t i = 0; i < first->hands.size(); ++i) {
    const auto time_ns = static_cast<std::int64_t>(i) * kFrame_ns;
    const CorrectedHand& a = here.update(first->hands[i], object, time_ns);
    const CorrectedHand& b = there.update(second->hands[i], built_again, time_ns);
    ASSERT_EQ(a.status, b.status) << "frame " << i;
    ASSERT_TRUE(same_bits(a.pose, b.pose)) << "frame " << i;
  }
}

TEST_P(CorrectorOfAnyMethod, AFrameAllocatesNothing) {
  const auto mesh = MeshSurface::build(test::uv_sphere(0.15F, 60, 61), "sphere");
  ASSERT_TRUE(mesh.ok());
  const Object object(**mesh, ball().placement());
  HandCorrector corrector(options_);
  const HandPose hand = pressed_hand(0.02, rad(8.0));
  const auto count = test::allocations_of([&] {
    for (int i = 0; i < 20; ++i) (void)corrector.update(hand, object, i * kFrame_ns);
  });
  EXPECT_EQ(count, 0u);
}

TEST_P(CorrectorOfAnyMethod, EveryRunGivesTheSameBits) {
  const auto run = [this] {
    HandCorrector corrector(options_);
    HandPose last;
    for (int i = 0; i < 60; ++i) {
      const HandPose hand = pressed_hand(0.001 * i - 0.01, rad(10.0), {0.001 * i, 0.0, 0.0});
      last = corrector.update(hand, ball(), i * kFrame_ns).pose;
    }
    return last;
  };
  EXPECT_TRUE(same_bits(run(), run()));
}

TEST(Corrector, NoJointLeavesItsRangeOfMotion) {
  for (double tilt : {rad(-20.0), 0.0, rad(20.0)}) {
    HandCorrector corrector(by_paper());
    for (int i = 0; i < 100; ++i) {
      const HandPose hand = pressed_hand(0.0008 * i - 0.02, tilt);
      const HandAngles tracked = measure_angles(hand);
      const HandAngles drawn = measure_angles(corrector.update(hand, ball(), i * kFrame_ns).pose);
      for (std::size_t d = 0; d < kDigitCount; ++d) {
        for (std::size_t k = 0; k < kHingeCount; ++k) {
          const HingeRange range = range_of_motion(digit_at(d), k);
          const double low = std::min(range.flexion_min, tracked[d][k].flexion);
          const double high = std::max(range.flexion_max, tracked[d][k].flexion);
          EXPECT_GE(drawn[d][k].flexion, low - 1e-6);
          EXPECT_LE(drawn[d][k].flexion, high + 1e-6);
        }
      }
    }
  }
}

TEST(Corrector, AbsurdPlacesLeaveThePapersHandAsItIs) {
  for (const double scale : {1e6, 1e12, 1e30}) {
    const Object planet(test::kBall, {{Vec3(0.0, -0.15 * scale, 1.0), Quat::Identity()}, scale});
    HandCorrector corrector(by_paper());
    for (int i = 0; i < 20; ++i) {
      const HandPose hand = pressed_hand(0.01 * i, 0.1 * i, {0.5 * scale * (i % 3), 0.0, 0.0});
      const CorrectedHand& drawn = corrector.update(hand, planet, i * kFrame_ns);
      ASSERT_TRUE(all_finite(drawn.pose) || !is_usable(hand));
      if (!is_usable(hand)) continue;
      EXPECT_LT(largest_motion(hand, drawn.pose), 10.1) << scale;
    }
  }
}

}  // namespace
}  // namespace nade
