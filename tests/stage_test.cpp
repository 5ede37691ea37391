// Hand and object as they are drawn, told from pictures and depths: sizes, sides, materials, and
// that no skin is seen in the object where none is in it.

#include "nade/draw/stage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "nade/draw/camera.h"
#include "nade/draw/gl_context.h"
#include "nade/eval/synth.h"
#include "nade/io/hand_file.h"
#include "support/files.h"
#include "support/gltf_file.h"
#include "support/scratch_folder.h"
#include "support/stored_picture.h"

namespace nade::draw {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr double kAspect = static_cast<double>(kWidth) / kHeight;

HandMesh load_hand(Handedness side) {
  const std::string path =
      std::string(NADE_TEST_HANDS_DIR) + "/" + std::string(name_of(side)) + ".glb";
  Result<HandMesh> mesh = load_hand_mesh(path, side);
  EXPECT_TRUE(mesh.ok()) << path;
  return mesh.ok() ? std::move(*mesh) : HandMesh{};
}

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

std::size_t count_covered(const DepthMap& map) {
  return static_cast<std::size_t>(std::count_if(map.depth_m.begin(), map.depth_m.end(),
                                                [](float d) { return std::isfinite(d); }));
}

/// Red over green and blue: about a half where grey.
double red_share(const Image& image, int x, int y) {
  const auto at = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                       static_cast<std::size_t>(x));
  return image.rgba[at] / (1.0 + image.rgba[at + 1] + image.rgba[at + 2]);
}

class StageTest : public testing::Test {
 protected:
  void SetUp() override {
    Result<OffscreenContext> context = OffscreenContext::create();
    if (!context) GTEST_SKIP() << context.error().message;
    context_.emplace(std::move(context).value());
    Result<Renderer> renderer = Renderer::create();
    ASSERT_TRUE(renderer.ok()) << renderer.error().message;
    renderer_.emplace(std::move(renderer).value());
    hands_ = {load_hand(Handedness::left), load_hand(Handedness::right)};
    Result<Stage> stage = Stage::create(*renderer_, hands_);
    ASSERT_TRUE(stage.ok()) << stage.error().message;
    stage_.emplace(std::move(stage).value());
  }
  void TearDown() override {
    stage_.reset();
    renderer_.reset();
    context_.reset();
  }

  void show(const std::string& spec, const Placement& placement = {}) {
    Result<LoadedObject> object = load_object(spec);
    ASSERT_TRUE(object.ok()) << object.error().message;
    object_.emplace(std::move(object).value());
    placement_ = placement;
    const Status set = stage_->set_object(*object_, placement);
    ASSERT_TRUE(set.ok()) << set.error().message;
  }

  [[nodiscard]] const HandMesh& mesh(Handedness side) const { return hands_[index_of(side)]; }
  [[nodiscard]] Object object() const { return object_->placed(placement_); }

  static StageFrame frame_of(const HandPose& hand) {
    StageFrame frame;
    frame.hands[index_of(hand.side)] = StagedHand{hand, hand, {}, {}};
    return frame;
  }

  DepthMap hand_depths(const HandPose& hand, const Camera& camera) {
    static_cast<void>(stage_->arrange(frame_of(hand)));
    return renderer_->depths(stage_->hand_only(), camera, kWidth, kHeight, Faces::front);
  }

  /// Pixels where the hand's nearest skin lies in the object: behind its front, before its back,
  /// by more than half a millimetre.
  std::size_t penetrating_pixels(const HandPose& hand, const Camera& camera) {
    constexpr float kTolerance = 0.0005F;
    const DepthMap skin = hand_depths(hand, camera);
    const Scene scene = stage_->object_only();
    const DepthMap front = renderer_->depths(scene, camera, kWidth, kHeight, Faces::front);
    const DepthMap back = renderer_->depths(scene, camera, kWidth, kHeight, Faces::back);
    std::size_t count = 0;
    for (std::size_t i = 0; i < skin.depth_m.size(); ++i) {
      const float d = skin.depth_m[i];
      if (std::isfinite(d) && d > front.depth_m[i] + kTolerance &&
          d < back.depth_m[i] - kTolerance) {
        ++count;
      }
    }
    return count;
  }

  Image picture(const StageFrame& frame, const Camera& camera) {
    return renderer_->picture(stage_->arrange(frame), camera, kWidth, kHeight);
  }

  std::optional<OffscreenContext> context_;
  std::optional<Renderer> renderer_;
  HandMeshes hands_;
  std::optional<Stage> stage_;
  std::optional<LoadedObject> object_;
  Placement placement_;
};

Camera above(double height_m = 0.6) {
  return looking_at({0.0, height_m, 0.02}, {0.0, 0.0, 0.0}, 0.6, kAspect);
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
  EXPECT_GT(settled.outside, settled.frames / 2);
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

/// A user's own objects: a board 20 cm wide, facing +Y.
class StageFiles : public StageTest {
 protected:
  void SetUp() override {
    StageTest::SetUp();
    Image texture = Image::blank(4, 4);
    for (std::size_t i = 0; i < 16; ++i) {
      // The left half red, the right half blue.
      const bool left = i % 4 < 2;
      texture.rgba[4 * i] = left ? 255 : 0;
      texture.rgba[4 * i + 1] = 0;
      texture.rgba[4 * i + 2] = left ? 0 : 255;
      texture.rgba[4 * i + 3] = 255;
    }
    ASSERT_TRUE(save_png(path("board.png"), texture).ok());
  }
  [[nodiscard]] std::string path(const std::string& name) const { return scratch_.path(name); }

  void write_obj(const std::string& name, const std::string& material) {
    std::ofstream(path(name + ".mtl")) << "newmtl board\n" << material;
    std::ofstream(path(name + ".obj")) << "mtllib " << name << ".mtl\n"
                                       << "v -0.1 0 -0.1\nv 0.1 0 -0.1\nv 0.1 0 0.1\n"
                                          "v -0.1 0 0.1\n"
                                          "vt 0 1\nvt 1 1\nvt 1 0\nvt 0 0\n"
                                          "usemtl board\nf 1/1 4/4 3/3\nf 1/1 3/3 2/2\n";
  }

  /// As a .gltf file whose picture is where `image` says.
  void write_gltf(const std::string& name, const nlohmann::json& image) {
    const std::vector<float> numbers{-0.1F, 0,    -0.1F, 0.1F, 0, -0.1F, 0.1F, 0, 0.1F, -0.1F,
                                     0,     0.1F, 0,     0,    1, 0,     1,    1, 0,    1};
    const std::vector<std::uint16_t> indices{0, 3, 2, 0, 2, 1};
    std::ofstream bin(path(name + ".bin"), std::ios::binary);
    bin.write(reinterpret_cast<const char*>(numbers.data()), 80);
    bin.write(reinterpret_cast<const char*>(indices.data()), 12);
    nlohmann::json gltf;
    gltf["asset"]["version"] = "2.0";
    gltf["buffers"] = {{{"uri", name + ".bin"}, {"byteLength", 92}}};
    gltf["bufferViews"] = {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 48}},
                           {{"buffer", 0}, {"byteOffset", 48}, {"byteLength", 32}},
                           {{"buffer", 0}, {"byteOffset", 80}, {"byteLength", 12}}};
    gltf["accessors"] = {
        {{"bufferView", 0},
         {"componentType", 5126},
         {"count", 4},
         {"type", "VEC3"},
         {"min", {-0.1, 0, -0.1}},
         {"max", {0.1, 0, 0.1}}},
        {{"bufferView", 1}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}},
        {{"bufferView", 2}, {"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}}};
    gltf["images"].push_back(image);
    gltf["textures"] = {{{"source", 0}}};
    gltf["materials"] = {{{"pbrMetallicRoughness",
                           {{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0.0}}}}};
    gltf["meshes"] = {{{"primitives",
                        {{{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}},
                          {"indices", 2},
                          {"material", 0}}}}}};
    gltf["nodes"] = {{{"mesh", 0}}};
    gltf["scenes"] = {{{"nodes", {0}}}};
    gltf["scene"] = 0;
    std::ofstream(path(name + ".gltf")) << gltf.dump();
  }

  /// A picture of the object alone from above, +X to the right.
  Image board_picture(const std::string& file) {
    show(path(file));
    return renderer_->picture(stage_->arrange_object(), above(0.5), kWidth, kHeight);
  }

  static void expect_red_left_blue_right(const Image& image) {
    EXPECT_GT(red_share(image, kWidth / 2 - 40, kHeight / 2), 0.7);
    EXPECT_LT(red_share(image, kWidth / 2 + 40, kHeight / 2), 0.4);
  }

  test::ScratchFolder scratch_;
};

std::string base64(const std::string& bytes) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool there = i + k < bytes.size();
      group = group << 8U | (there ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? letters[group >> (18U - 6U * k) & 63U] : '=';
    }
  }
  return text;
}

TEST_F(StageFiles, TextureBesideAGltfFile) {
  write_gltf("outside", {{"uri", "board.png"}});
  expect_red_left_blue_right(board_picture("outside.gltf"));
  EXPECT_TRUE(stage_->warnings().empty());
}

TEST_F(StageFiles, TextureInAGltfFile) {
  const std::string board = test::read_file(path("board.png"));
  write_gltf("inside", {{"uri", "data:image/png;base64," + base64(board)}});
  expect_red_left_blue_right(board_picture("inside.gltf"));
  EXPECT_TRUE(stage_->warnings().empty());
}

TEST_F(StageFiles, TextureOfAnObjFile) {
  write_obj("textured", "Kd 0 0 0\nmap_Kd board.png\n");
  expect_red_left_blue_right(board_picture("textured.obj"));
}

TEST_F(StageFiles, ColorOfAnObjFile) {
  write_obj("plain", "Kd 0.8 0.1 0.1\n");
  const Image image = board_picture("plain.obj");
  EXPECT_GT(red_share(image, kWidth / 2 + 40, kHeight / 2), 0.65);
}

TEST_F(StageFiles, MissingTextureIsSaidAndTheObjectDrawn) {
  write_obj("lost", "Kd 0.8 0.1 0.1\nmap_Kd nowhere.png\n");
  const Image image = board_picture("lost.obj");
  ASSERT_EQ(stage_->warnings().size(), 1u);
  EXPECT_NE(stage_->warnings().front().find("nowhere.png"), std::string::npos);
  EXPECT_GT(red_share(image, kWidth / 2, kHeight / 2), 0.65);
}

TEST_F(StageFiles, MissingTextureOfAGltfFileIsSaidAndTheObjectDrawn) {
  write_gltf("lost", {{"uri", "nowhere.png"}});
  show(path("lost.gltf"));
  ASSERT_EQ(stage_->warnings().size(), 1u);
  EXPECT_NE(stage_->warnings().front().find("nowhere.png: "), std::string::npos);
  const DepthMap map =
      renderer_->depths(stage_->object_only(), above(0.5), kWidth, kHeight, Faces::front);
  EXPECT_GT(count_covered(map), 3000u);
}

/// A skin stands where its joints are, also before anything moves.
TEST_F(StageFiles, SkinnedFileIsDrawnWhereItIsFelt) {
  test::GltfFile file("nade_drawn_skin");
  file.gltf["nodes"] = {{{"mesh", 0}, {"skin", 0}}, {{"translation", {0, 0.3, 0}}}};
  file.gltf["scenes"][0]["nodes"] = {0, 1};
  file.gltf["skins"] = {{{"joints", {1}}}};
  nlohmann::json& attributes = file.gltf["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = file.add_bytes(std::vector<std::uint8_t>(12, 0), 5121, "VEC4", 3);
  attributes["WEIGHTS_0"] = file.add({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  attributes["NORMAL"] = file.add({0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3");
  show(file.write());
  const auto felt = object().first_hit({{0.1, 2.0, -0.1}, -Vec3::UnitY(), 3.0});
  ASSERT_TRUE(felt.has_value());
  EXPECT_NEAR(felt->distance, 1.7, 1e-6);
  const DepthMap drawn =
      renderer_->depths(stage_->object_only(), above(2.0), kWidth, kHeight, Faces::front);
  EXPECT_NEAR(*std::min_element(drawn.depth_m.begin(), drawn.depth_m.end()), 1.7, 1e-3);
}

TEST_F(StageFiles, MeshesWithoutMaterialsAreDrawn) {
  std::ofstream(path("board.off"))
      << "OFF\n4 2 0\n-0.1 0 -0.1\n0.1 0 -0.1\n0.1 0 0.1\n-0.1 0 0.1\n3 0 3 2\n3 0 2 1\n";
  show(path("board.off"));
  const DepthMap map =
      renderer_->depths(stage_->object_only(), above(0.5), kWidth, kHeight, Faces::front);
  EXPECT_GT(count_covered(map), 3000u);
}

}  // namespace
}  // namespace nade::draw
