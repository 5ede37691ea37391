// Hand and object as they are drawn, told from pictures and depths: sizes, sides, and that no
// skin is seen in the object where none is in it.

#include "nade/draw/stage.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nade/draw/camera.h"
#include "nade/eval/synth.h"
#include "support/stage_fixture.h"
#include "support/stored_picture.h"

namespace nade::draw {
namespace {

/// The generic hand in its bind pose, flat on y = 0, fingers along -Z, `lift` above it with its
/// palm; `scale` times its size.
HandPose flat_hand(const HandMesh& mesh, double scale, double lift) {
  HandPose hand = mesh.bind;
  const Pose to_world{Vec3::Zero(), mesh.bind[Joint::palm].rotation.conjugate()};
  const Vec3 palm = mesh.bind[Joint::palm].position;
  for (Pose& joint : hand.joints) {
    joint.position = scale * (joint.position - palm);
    joint = to_world * joint;
    joint.position.y() += lift;
  }
  hand.side = mesh.side;
  return hand;
}

/// Distance of the deepest skin from the object's surface, positive inside.
double deepest_skin(const HandMesh& mesh, const HandPose& hand, const Object& object) {
  std::vector<Eigen::Vector3f> skin(mesh.vertices.size());
  pose_skin(mesh, hand, hand_scale(mesh, hand), skin, {});
  double deepest = -1.0;
  for (const auto& vertex : skin) {
    SurfaceHint hint;
    const auto near = object.closest_point(vertex.cast<double>(), 0.5, hint);
    if (near) deepest = std::max(deepest, -near->signed_distance);
  }
  return deepest;
}

/// The hand raised until no skin is in the object.
HandPose raised(const HandMesh& mesh, HandPose hand, const Object& object) {
  for (int i = 0; i < 200; ++i) {
    const double depth = deepest_skin(mesh, hand, object);
    if (depth < 0.0) break;
    hand = moved(hand, {Vec3(0.0, depth + 1e-5, 0.0), Quat::Identity()});
  }
  return hand;
}

TEST_F(StageTest, SilhouetteIsTheMeasuredSkin) {
  const HandPose hand = flat_hand(mesh(Handedness::right), 1.0, 0.05);
  const Camera camera = above();
  const DepthMap map = hand_depths(hand, camera);
  std::vector<Eigen::Vector3f> skin(mesh(Handedness::right).vertices.size());
  pose_skin(mesh(Handedness::right), hand, 1.0, skin, {});
  const Pose to_eye = camera.pose.inverse();
  Eigen::AlignedBox2d expected;
  for (const auto& vertex : skin) {
    const Vec3 p = to_eye.apply(vertex.cast<double>());
    expected.extend(
        Eigen::Vector2d(0.5 * kWidth * (1.0 - p.x() / p.z() / std::tan(camera.view.right)),
                        0.5 * kHeight * (1.0 + p.y() / p.z() / std::tan(camera.view.up))));
  }
  Eigen::AlignedBox2d drawn;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (!std::isfinite(map.depth_m[static_cast<std::size_t>(y * kWidth + x)])) continue;
      drawn.extend(Eigen::Vector2d(x, y));
      drawn.extend(Eigen::Vector2d(x + 1, y + 1));
    }
  }
  ASSERT_FALSE(drawn.isEmpty());
  EXPECT_LT((drawn.min() - expected.min()).cwiseAbs().maxCoeff(), 1.5);
  EXPECT_LT((drawn.max() - expected.max()).cwiseAbs().maxCoeff(), 1.5);
}

TEST_F(StageTest, HandsOfAnySizeAreDrawnAtTheirSize) {
  const Camera camera = above(0.8);
  const auto area = [&](double scale) {
    // As far from the camera, whatever its size.
    return static_cast<double>(
        count_covered(hand_depths(flat_hand(mesh(Handedness::right), scale, 0.0), camera)));
  };
  const double own = area(1.0);
  ASSERT_GT(own, 1000.0);
  EXPECT_NEAR(area(0.8) / own, 0.64, 0.03);
  EXPECT_NEAR(area(1.25) / own, 1.5625, 0.07);
}

TEST_F(StageTest, LeftHandIsTheRightOnesMirrorImage) {
  const Camera camera = above();
  const DepthMap right = hand_depths(flat_hand(mesh(Handedness::right), 1.0, 0.0), camera);
  const DepthMap left = hand_depths(mirrored(flat_hand(mesh(Handedness::right), 1.0, 0.0)), camera);
  std::size_t different = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto at = static_cast<std::size_t>(y * kWidth + x);
      const auto mirror = static_cast<std::size_t>(y * kWidth + kWidth - 1 - x);
      if (std::isfinite(left.depth_m[at]) != std::isfinite(right.depth_m[mirror])) ++different;
    }
  }
  ASSERT_GT(count_covered(left), 1000u);
  EXPECT_LT(different, count_covered(left) / 20);
}

TEST_F(StageTest, BothHandsAreDrawn) {
  const Camera camera = above();
  StageFrame frame;
  std::size_t apart = 0;
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    const Pose aside{Vec3(side == Handedness::left ? -0.12 : 0.12, 0.0, 0.0), Quat::Identity()};
    const HandPose hand = moved(flat_hand(mesh(side), 1.0, 0.0), aside);
    apart += count_covered(hand_depths(hand, camera));
    frame.hands[index_of(side)] = StagedHand{hand, hand, {}, {}};
  }
  static_cast<void>(stage_->arrange(frame));
  const DepthMap both =
      renderer_->depths(stage_->hand_only(), camera, kWidth, kHeight, Faces::front);
  EXPECT_NEAR(static_cast<double>(count_covered(both)), static_cast<double>(apart),
              0.01 * static_cast<double>(apart));
}

struct Press {
  const char* object;
  Vec3 over;        ///< where the palm is pressed in
  Vec3 eye_offset;  ///< from there
  friend std::ostream& operator<<(std::ostream& out, const Press& press) {
    return out << press.object;
  }
};

class StagePress : public StageTest, public testing::WithParamInterface<Press> {};

TEST_P(StagePress, PenetratingPixelsAreZeroWhereNoSkinIsInside) {
  const Press& press = GetParam();
  show(press.object);
  const HandMesh& skin = mesh(Handedness::right);
  const HandPose pressed = moved(flat_hand(skin, 1.0, 0.0), {press.over, Quat::Identity()});
  const Camera camera = looking_at(press.over + press.eye_offset, press.over, 0.6, kAspect);
  ASSERT_GT(deepest_skin(skin, pressed, object()), 0.01);
  EXPECT_GT(penetrating_pixels(pressed, camera), 100u);
  const HandPose free = raised(skin, pressed, object());
  ASSERT_LT(deepest_skin(skin, free, object()), 0.0);
  EXPECT_EQ(penetrating_pixels(free, camera), 0u);
}

INSTANTIATE_TEST_SUITE_P(Objects, StagePress,
                         testing::Values(Press{"plane", {0.0, 0.0, 0.0}, {-0.3, 0.25, -0.2}},
                                         Press{"sphere", {0.0, -0.01, 0.0}, {-0.3, 0.2, -0.2}},
                                         Press{"dog", {0.05, 0.40, 0.0}, {-0.2, 0.3, 0.4}}));

/// Where flesh gives way the hand of the new method is flat; the others are drawn as they are.
TEST_F(StageTest, SunkSkinIsDrawnFlat) {
  const HandMesh& skin = mesh(Handedness::right);
  for (const char* const spec : {"plane", "sphere"}) {
    show(spec);
    const double skin_m = generic_skin_depths()[Part::palm];
    HandCorrector corrector;
    HandPose drawn;
    for (int i = 0; i < 90; ++i) {
      const double depth = 0.07 * std::min(1.0, i / 60.0) - 0.05;
      const HandPose tracked = flat_hand(skin, 1.0, skin_m - depth);
      drawn = corrector.update(tracked, object(), i * 11'111'111).pose;
    }
    ASSERT_GT(deepest_skin(skin, drawn, object()), 0.004);
    const Vec3 palm = drawn[Joint::palm].position;
    const Camera camera = looking_at(palm + Vec3(-0.35, 0.02, 0.05), palm, 0.6, kAspect);
    EXPECT_GT(penetrating_pixels(drawn, camera, Method::none), 50U) << spec;
    EXPECT_EQ(penetrating_pixels(drawn, camera, Method::paper),
              penetrating_pixels(drawn, camera, Method::none));
    EXPECT_EQ(penetrating_pixels(drawn, camera, Method::nade), 0U) << spec;
  }
}

struct Stroked {
  const char* object;
  Vec3 eye_offset;  ///< from the palm
  friend std::ostream& operator<<(std::ostream& out, const Stroked& stroked) {
    return out << stroked.object;
  }
};

class StageStroke : public StageTest, public testing::WithParamInterface<Stroked> {
 protected:
  /// What pictures and skin say of a stroke as a method corrects it.
  struct Tally {
    int frames = 0;         ///< with the tracked skin more than 10 mm deep
    int outside = 0;        ///< of these, no skin deeper than a tenth of a millimetre
    std::size_t seen = 0;   ///< penetrating pixels of those, all together
    std::size_t total = 0;  ///< penetrating pixels of all frames
  };

  Tally stroke(Method method) {
    const auto relaxed = load_relaxed_hand(Handedness::right);
    EXPECT_TRUE(relaxed.ok());
    SynthOptions options;
    options.duration_s = 3.0;
    options.rate_hz = 60.0;
    auto synth = StrokeSynth::create(*object_, placement_, *relaxed, options);
    EXPECT_TRUE(synth.ok());
    CorrectorOptions how;
    how.method = method;
    HandCorrector corrector(how);
    const HandMesh& skin = mesh(Handedness::right);
    Tally tally;
    for (int i = 0; auto frame = synth->next(); ++i) {
      const HandPose& tracked = frame->hands[index_of(Handedness::right)]->pose;
      const HandPose drawn = corrector.update(tracked, object(), frame->time_ns).pose;
      if (i % 12 != 0 || deepest_skin(skin, tracked, object()) < 0.01) continue;
      const Vec3 palm = drawn[Joint::palm].position;
      const std::size_t pixels =
          penetrating_pixels(drawn, looking_at(palm + GetParam().eye_offset, palm, 0.6, kAspect));
      ++tally.frames;
      tally.total += pixels;
      if (deepest_skin(skin, drawn, object()) > 0.0001) continue;
      ++tally.outside;
      tally.seen += pixels;
    }
    return tally;
  }
};

TEST_P(StageStroke, NoSkinIsSeenInsideWhereTheMetricFindsNone) {
  show(GetParam().object);
  const Tally settled = stroke(Method::nade);
  ASSERT_GT(settled.frames, 4);
  EXPECT_EQ(settled.seen, 0u);
  EXPECT_GT(stroke(Method::none).total, 100u * static_cast<std::size_t>(settled.frames));
}

INSTANTIATE_TEST_SUITE_P(Objects, StageStroke,
                         testing::Values(Stroked{"plane", {-0.3, 0.25, -0.2}},
                                         Stroked{"sphere", {-0.3, 0.2, -0.2}},
                                         Stroked{"dog", {0.04, 0.32, -0.3}}));

class StagePicture : public StageTest, public testing::WithParamInterface<Press> {};

TEST_P(StagePicture, IsTheStoredPicture) {
  const Press& press = GetParam();
  show(press.object);
  const HandMesh& skin = mesh(Handedness::right);
  StageFrame frame;
  StagedHand& hand = frame.hands[index_of(Handedness::right)].emplace();
  hand.tracked = moved(flat_hand(skin, 1.0, 0.0), {press.over, Quat::Identity()});
  hand.corrected = raised(skin, hand.tracked, object());
  frame.shown = Shown::both;
  PartContact& palm = hand.contacts[index_of(Part::palm)].emplace();
  palm.ray_origin = hand.tracked[Joint::palm].position;
  palm.target = hand.corrected[Joint::palm].position;
  palm.surface_point = 0.5 * (palm.ray_origin + palm.target);
  frame.overlays.rays = frame.overlays.contacts = frame.overlays.normals = true;
  const Camera camera = looking_at(press.over + press.eye_offset, press.over, 0.6, 4.0 / 3.0);
  test::expect_stored(renderer_->picture(stage_->arrange(frame), camera, 128, 96),
                      std::string("hand_on_") + press.object);
}

INSTANTIATE_TEST_SUITE_P(Objects, StagePicture,
                         testing::Values(Press{"plane", {0.0, 0.0, 0.0}, {-0.3, 0.25, -0.2}},
                                         Press{"sphere", {0.0, -0.01, 0.0}, {-0.3, 0.2, -0.2}},
                                         Press{"dog", {0.0, 0.39, 0.0}, {-0.25, 0.3, -0.5}}));

TEST_F(StageTest, DrawnObjectsAreTheirSurfaces) {
  for (const std::string spec : {"plane", "sphere", "sphere:0.05", "dog"}) {
    show(spec);
    const Stage::Bounds bounds = stage_->object_bounds();
    const Camera camera =
        framed(View::three_quarter, bounds.center, bounds.radius_m).camera(kAspect);
    const DepthMap map =
        renderer_->depths(stage_->object_only(), camera, kWidth, kHeight, Faces::front);
    std::size_t hits = 0;
    for (int y = 0; y < kHeight; y += 7) {
      for (int x = 0; x < kWidth; x += 7) {
        const float depth = map.depth_m[static_cast<std::size_t>(y * kWidth + x)];
        if (!std::isfinite(depth)) continue;
        const double across = std::tan(camera.view.right) * (2.0 * (x + 0.5) / kWidth - 1.0);
        const double up = std::tan(camera.view.up) * (1.0 - 2.0 * (y + 0.5) / kHeight);
        const Vec3 point = camera.pose.apply(depth * Vec3(across, up, -1.0));
        if (spec == "plane" && point.y() < -1e-3) continue;  // the table's side
        SurfaceHint hint;
        const auto near = object().closest_point(point, 1.0, hint);
        ASSERT_TRUE(near.has_value());
        EXPECT_LT(std::abs(near->signed_distance), 1.2e-3) << spec << " at " << point.transpose();
        ++hits;
      }
    }
    EXPECT_GT(hits, 50u) << spec;
  }
}

TEST_F(StageTest, PenetrationShowsRedOnTheSkin) {
  show("plane");
  StageFrame frame = frame_of(flat_hand(mesh(Handedness::right), 1.0, -0.02));
  frame.overlays.see_through = true;
  const auto red_pixels = [&] {
    const Image image = picture(frame, above());
    int count = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) count += red_share(image, x, y) > 0.85 ? 1 : 0;
    }
    return count;
  };
  const int without = red_pixels();
  frame.overlays.penetration = true;
  EXPECT_GT(red_pixels(), without + 500);
  frame.overlays.penetration = false;
  EXPECT_EQ(red_pixels(), without);
}

TEST_F(StageTest, GhostIsSeenAndCastsNothingIntoDepth) {
  show("plane");
  StageFrame frame = frame_of(flat_hand(mesh(Handedness::right), 1.0, 0.06));
  const Image alone = picture(frame, above());
  frame.hands[1]->tracked = flat_hand(mesh(Handedness::right), 1.0, 0.03);
  frame.shown = Shown::corrected;
  EXPECT_EQ(picture(frame, above()).rgba, alone.rgba);
  frame.shown = Shown::both;
  EXPECT_NE(picture(frame, above()).rgba, alone.rgba);
}

TEST_F(StageTest, SamePictureTwice) {
  show("dog");
  const StageFrame frame = frame_of(moved(flat_hand(mesh(Handedness::right), 1.0, 0.0),
                                          {Vec3(0.05, 0.43, 0.0), Quat::Identity()}));
  const Camera camera = looking_at({-0.3, 0.7, 0.6}, {0.0, 0.4, 0.0}, 0.6, kAspect);
  const Image first = picture(frame, camera);
  EXPECT_EQ(picture(frame, camera).rgba, first.rgba);
}

TEST_F(StageTest, ObjectsAreReplaced) {
  show("dog");
  show("sphere");
  EXPECT_NEAR(stage_->object_bounds().center.y(), -0.15, 1e-3);
  EXPECT_EQ(stage_->arrange_object().instances.size(), 1u);
  EXPECT_NEAR(stage_->arrange_object().floor_y, -0.3, 1e-3);
  stage_->set_placement({{Vec3(0.0, 1.0, 0.0), Quat::Identity()}, 2.0});
  EXPECT_NEAR(stage_->arrange_object().floor_y, 0.4, 1e-3);
}

}  // namespace
}  // namespace nade::draw
