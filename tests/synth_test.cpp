#include "nade/eval/synth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "nade/eval/press.h"
#include "nade/skeleton.h"

namespace nade {
namespace {

constexpr std::array<Stroke, 5> kStrokes{Stroke::line, Stroke::circle, Stroke::zigzag, Stroke::curl,
                                         Stroke::press};

/// A recording, and what it was made from.
struct Synthesised {
  std::vector<RecordedFrame> frames;
  RecordingHeader header;
  double begin_s = 0.0;
  double end_s = 0.0;

  [[nodiscard]] const HandPose& hand(std::size_t i) const {
    const auto& hands = frames[i].hands;
    return (hands[0] ? hands[0] : hands[1])->pose;
  }
  [[nodiscard]] double time_s(std::size_t i) const {
    return static_cast<double>(frames[i].time_ns) * 1e-9;
  }
  [[nodiscard]] bool strokes(std::size_t i) const {
    return time_s(i) >= begin_s && time_s(i) <= end_s;
  }
};

class Synth : public testing::Test {
 protected:
  void SetUp() override {
    const auto relaxed = load_relaxed_hand(Handedness::right);
    if (!relaxed.ok()) GTEST_SKIP() << relaxed.error().message;
    relaxed_ = *relaxed;
  }

  /// Nothing where the object (the dog, not built) is not there.
  static std::optional<LoadedObject> find(const std::string& spec) {
    auto object = load_object(spec);
    if (!object.ok()) return std::nullopt;
    return std::move(object).value();
  }

  Synthesised make(const LoadedObject& object, const SynthOptions& options,
                   const Placement& placement = {}) const {
    Synthesised made;
    auto synth = StrokeSynth::create(object, placement, relaxed_, options);
    EXPECT_TRUE(synth.ok()) << synth.error().message;
    made.header = synth->header();
    made.begin_s = synth->stroke_begin_s();
    made.end_s = synth->stroke_end_s();
    while (auto frame = synth->next()) made.frames.push_back(*frame);
    return made;
  }

  std::string refusal(const SynthOptions& options) const {
    const auto synth = StrokeSynth::create(*find("plane"), {}, relaxed_, options);
    EXPECT_FALSE(synth.ok());
    if (synth.ok()) return {};
    EXPECT_EQ(synth.error().code, ErrorCode::out_of_range);
    return synth.error().message;
  }

  HandPose relaxed_;
};

double depth_of(const Object& object, const HandPose& hand) {
  SurfaceHint hint;
  const auto nearest = object.closest_point(*palm_skin(hand), 1.0, hint);
  return nearest ? -nearest->signed_distance : NAN;
}

double mean_palm_speed(const Synthesised& made) {
  double way = 0.0;
  for (std::size_t i = 1; i < made.frames.size(); ++i) {
    if (!made.strokes(i) || !made.strokes(i - 1)) continue;
    way += (made.hand(i)[Joint::palm].position - made.hand(i - 1)[Joint::palm].position).norm();
  }
  return way / (made.end_s - made.begin_s);
}

/// The largest acceleration of any joint, metres per second squared.
double fastest_acceleration(const Synthesised& made, double rate_hz) {
  double fastest = 0.0;
  for (std::size_t i = 2; i < made.frames.size(); ++i) {
    for (std::size_t j = 0; j < kJointCount; ++j) {
      const Vec3 second = made.hand(i).joints[j].position -
                          2.0 * made.hand(i - 1).joints[j].position +
                          made.hand(i - 2).joints[j].position;
      fastest = std::max(fastest, second.norm() * rate_hz * rate_hz);
    }
  }
  return fastest;
}

double bone_length_error(const HandPose& hand, const HandPose& truth) {
  double worst = 0.0;
  for (std::size_t d = 0; d < kDigitCount; ++d) {
    const DigitJoints joints = joints_of(digit_at(d));
    for (std::size_t j = index_of(joints.metacarpal); j < index_of(joints.tip); ++j) {
      const auto length = [&](const HandPose& pose) {
        return (pose.joints[j + 1].position - pose.joints[j].position).norm();
      };
      worst = std::max(worst, std::abs(length(hand) - length(truth)));
    }
  }
  return worst;
}

TEST_F(Synth, PalmSkinLiesAtTheSetDepthWhileStroking) {
  for (const auto& [spec, tolerance_m] : {std::pair{"plane", 1e-3}, std::pair{"sphere", 1e-3},
                                          std::pair{"sphere:0.06", 1e-3}, std::pair{"dog", 3e-3}}) {
    const auto object = find(spec);
    if (!object) continue;
    for (const Stroke stroke : {Stroke::line, Stroke::circle, Stroke::zigzag, Stroke::curl}) {
      for (const double tilt_deg : {0.0, 20.0}) {
        SynthOptions options;
        options.stroke = stroke;
        options.tilt_rad = tilt_deg * kDegree;
        const Synthesised made = make(*object, options);
        double worst = 0.0;
        for (std::size_t i = 0; i < made.frames.size(); ++i) {
          if (!made.strokes(i)) continue;
          const double depth = depth_of(object->placed(), made.hand(i));
          worst = std::max(worst, std::abs(depth - options.depth_m));
        }
        EXPECT_LT(worst, tolerance_m) << spec << " " << name_of(stroke) << " " << tilt_deg;
      }
    }
  }
}

TEST_F(Synth, PressGoesFromTheSkinToTheDepthAndBack) {
  SynthOptions options;
  options.stroke = Stroke::press;
  const auto object = find("sphere");
  const Synthesised made = make(*object, options);
  double shallowest = 1.0;
  double deepest = -1.0;
  for (std::size_t i = 0; i < made.frames.size(); ++i) {
    if (!made.strokes(i)) continue;
    const double depth = depth_of(object->placed(), made.hand(i));
    shallowest = std::min(shallowest, depth);
    deepest = std::max(deepest, depth);
  }
  EXPECT_NEAR(deepest, options.depth_m, 1e-3);
  EXPECT_NEAR(shallowest, 0.0, 1e-3);
}

TEST_F(Synth, HandComesFromAboveAndLeaves) {
  for (const Stroke stroke : kStrokes) {
    SynthOptions options;
    options.stroke = stroke;
    const auto object = find("sphere");
    const Synthesised made = make(*object, options);
    EXPECT_NEAR(depth_of(object->placed(), made.hand(0)), -0.05, 2e-3) << name_of(stroke);
    EXPECT_LT(depth_of(object->placed(), made.hand(made.frames.size() - 1)), -0.04);
  }
}

TEST_F(Synth, BackLiesAlongTheNormalTiltedAsAsked) {
  const auto object = find("sphere");
  for (const double tilt_deg : {-15.0, 0.0, 20.0}) {
    SynthOptions options;
    options.tilt_rad = tilt_deg * kDegree;
    const Synthesised made = make(*object, options);
    for (std::size_t i = 0; i < made.frames.size(); i += 10) {
      const HandPose& hand = made.hand(i);
      SurfaceHint hint;
      const Vec3 normal = object->placed().closest_point(*palm_skin(hand), 1.0, hint)->normal;
      const double angle = std::acos(std::min(1.0, hand.back().dot(normal)));
      EXPECT_NEAR(angle, std::abs(tilt_deg) * kDegree, 0.5 * kDegree);
      if (tilt_deg == 0.0) continue;
      // Above 0 the fingers (-Z) point out of the surface.
      const double rise = -(hand[Joint::palm].rotation * Vec3::UnitZ()).dot(normal);
      EXPECT_GT(rise * tilt_deg, 0.0);
    }
  }
}

TEST_F(Synth, SpeedIsAsAsked) {
  for (const char* spec : {"plane", "sphere", "dog"}) {
    const auto object = find(spec);
    if (!object) continue;
    for (const Stroke stroke : {Stroke::line, Stroke::circle, Stroke::zigzag}) {
      for (const double speed : {0.03, 0.1, 0.25}) {
        SynthOptions options;
        options.stroke = stroke;
        options.speed_m_per_s = speed;
        const Synthesised made = make(*object, options);
        EXPECT_NEAR(mean_palm_speed(made) / speed, 1.0, 0.05) << spec << " " << name_of(stroke);
      }
    }
  }
}

TEST_F(Synth, MotionHasNoJumps) {
  for (const char* spec : {"plane", "sphere:0.06", "dog"}) {
    const auto object = find(spec);
    if (!object) continue;
    for (const MeshPlace& place : object->places) {
      for (const Stroke stroke : kStrokes) {
        SynthOptions options;
        options.stroke = stroke;
        options.place = place.name;
        const Synthesised made = make(*object, options);
        // A hand's own accelerations at this pace stay below that of free fall.
        EXPECT_LT(fastest_acceleration(made, options.rate_hz), 9.8)
            << spec << " " << place.name << " " << name_of(stroke);
      }
    }
  }
}

TEST_F(Synth, BonesKeepTheirLengths) {
  for (const NoiseModel noise : {NoiseModel::none, NoiseModel::quest, NoiseModel::leap}) {
    SynthOptions options;
    options.stroke = Stroke::curl;
    options.noise = noise;
    const Synthesised made = make(*find("plane"), options);
    for (std::size_t i = 0; i < made.frames.size(); i += 7) {
      ASSERT_TRUE(is_usable(made.hand(i)));
      EXPECT_LT(bone_length_error(made.hand(i), relaxed_), 1e-6);
    }
  }
}

TEST_F(Synth, HandScaleScalesBonesAndRadii) {
  SynthOptions options;
  options.hand_scale = 0.8;
  const Synthesised made = make(*find("plane"), options);
  EXPECT_NEAR(hand_length(made.hand(0)), 0.8 * hand_length(relaxed_), 1e-9);
  EXPECT_NEAR(made.hand(0).radius[5], 0.8 * relaxed_.radius[5], 1e-12);
  EXPECT_NEAR(depth_of(find("plane")->placed(), made.hand(200)), 0.02, 1e-4);
}

TEST_F(Synth, CurlBendsTheFingersBy45Degrees) {
  SynthOptions options;
  options.stroke = Stroke::curl;
  const Synthesised made = make(*find("plane"), options);
  const auto curl = [](const HandPose& hand) { return curl_of(measure_angles(hand)); };
  const double open = curl(made.hand(0));
  double most = open;
  for (std::size_t i = 0; i < made.frames.size(); ++i) most = std::max(most, curl(made.hand(i)));
  EXPECT_NEAR((most - open) / kDegree, 45.0, 1.0);
  EXPECT_NEAR(curl(made.hand(made.frames.size() - 1)), open, 1e-6);
}

TEST_F(Synth, LeftHandMirrorsTheRightOnThePlane) {
  for (const Stroke stroke : kStrokes) {
    SynthOptions options;
    options.stroke = stroke;
    options.noise = NoiseModel::quest;
    const Synthesised right = make(*find("plane"), options);
    options.side = Handedness::left;
    const Synthesised left = make(*find("plane"), options);
    ASSERT_EQ(left.frames.size(), right.frames.size());
    for (std::size_t i = 0; i < left.frames.size(); i += 5) {
      const HandPose seen = mirrored(right.hand(i));
      ASSERT_EQ(left.hand(i).side, Handedness::left);
      for (std::size_t j = 0; j < kJointCount; ++j) {
        EXPECT_LT((left.hand(i).joints[j].position - seen.joints[j].position).norm(), 1e-6)
            << name_of(stroke) << " frame " << i << " joint " << j;
      }
    }
  }
}

TEST_F(Synth, FramesAndTimesAreThoseOfTheRate) {
  SynthOptions options;
  options.duration_s = 2.0;
  options.rate_hz = 30.0;
  const Synthesised made = make(*find("plane"), options);
  ASSERT_EQ(made.frames.size(), 60u);
  EXPECT_EQ(made.frames[0].time_ns, 0);
  EXPECT_EQ(made.frames[1].time_ns, 33'333'333);
  EXPECT_EQ(made.frames[59].time_ns, 1'966'666'667);
}

TEST_F(Synth, SameSeedSameNumbers) {
  SynthOptions options;
  options.noise = NoiseModel::quest;
  const Synthesised first = make(*find("sphere"), options);
  const Synthesised second = make(*find("sphere"), options);
  options.seed = 2;
  const Synthesised other = make(*find("sphere"), options);
  EXPECT_EQ(first.header.unknown_json, second.header.unknown_json);
  for (std::size_t i = 0; i < first.frames.size(); i += 3) {
    for (std::size_t j = 0; j < kJointCount; ++j) {
      EXPECT_EQ(first.hand(i).joints[j].position, second.hand(i).joints[j].position);
      EXPECT_NE(first.hand(i).joints[j].position, other.hand(i).joints[j].position);
    }
  }
}

TEST_F(Synth, EveryPlaceOfTheDogTakesEveryStroke) {
  const auto dog = find("dog");
  if (!dog) GTEST_SKIP() << "no dog.glb";
  for (const char* place : {"back", "flank", "head", "ear", "leg"}) {
    for (const Stroke stroke : kStrokes) {
      SynthOptions options;
      options.place = place;
      options.stroke = stroke;
      const Synthesised made = make(*dog, options);
      double deepest = -1.0;
      for (std::size_t i = 0; i < made.frames.size(); ++i) {
        ASSERT_TRUE(is_usable(made.hand(i))) << place << " " << name_of(stroke);
        deepest = std::max(deepest, depth_of(dog->placed(), made.hand(i)));
      }
      EXPECT_GT(deepest, 0.003) << place << " " << name_of(stroke);
    }
  }
}

TEST_F(Synth, ThinPartsAreFollowedAtADepthTheyHave) {
  const auto dog = find("dog");
  if (!dog) GTEST_SKIP() << "no dog.glb";
  SynthOptions options;
  options.place = "ear";
  options.depth_m = 0.004;
  const Synthesised made = make(*dog, options);
  for (std::size_t i = 0; i < made.frames.size(); ++i) {
    if (!made.strokes(i)) continue;
    EXPECT_NEAR(depth_of(dog->placed(), made.hand(i)), options.depth_m, 1.5e-3) << "frame " << i;
  }
}

TEST_F(Synth, FollowsAnObjectThatIsMovedTurnedAndScaled) {
  Placement placement;
  placement.pose.position = Vec3(0.5, 1.0, -0.3);
  placement.pose.rotation = Quat(Eigen::AngleAxisd(1.0, Vec3(1.0, 2.0, 0.5).normalized()));
  placement.scale = 1.3;
  const auto object = find("sphere");
  const Synthesised made = make(*object, {}, placement);
  EXPECT_NEAR(depth_of(object->placed(placement), made.hand(270)), 0.02, 1e-3);
  const auto placing = placing_from(made.header.unknown_json, "synth");
  ASSERT_TRUE(placing.ok() && placing->has_value());
  EXPECT_EQ((**placing).object, "sphere");
  EXPECT_EQ((**placing).placement.scale, 1.3);
}

TEST_F(Synth, BadOptionsAreRefusedInASentence) {
  const auto with = [](auto change) {
    SynthOptions options;
    change(options);
    return options;
  };
  EXPECT_EQ(refusal(with([](SynthOptions& o) { o.speed_m_per_s = 0.0; })),
            "--speed 0: expected metres per second above 0, up to 2");
  EXPECT_EQ(refusal(with([](SynthOptions& o) { o.depth_m = -0.01; })),
            "--depth -0.01: expected 0 to 0.1 metres");
  EXPECT_EQ(refusal(with([](SynthOptions& o) { o.duration_s = NAN; })),
            "--duration nan: expected 0.5 to 86400 seconds");
  EXPECT_NE(refusal(with([](SynthOptions& o) { o.tilt_rad = 3.0; })).find("--tilt"),
            std::string::npos);
  EXPECT_NE(refusal(with([](SynthOptions& o) { o.rate_hz = 0.0; })).find("--rate"),
            std::string::npos);
  EXPECT_NE(refusal(with([](SynthOptions& o) { o.hand_scale = 0.0; })).find("--hand-scale"),
            std::string::npos);
  EXPECT_EQ(refusal(with([](SynthOptions& o) { o.place = "wing"; })),
            "object plane: no place 'wing': expected one of top");
}

TEST_F(Synth, StrokeNamesGoBothWays) {
  for (const Stroke stroke : kStrokes) EXPECT_EQ(stroke_from_name(name_of(stroke)), stroke);
  EXPECT_FALSE(stroke_from_name("pat").has_value());
}

}  // namespace
}  // namespace nade
