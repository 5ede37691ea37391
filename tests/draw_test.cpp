// Pictures, told from their pixels and depths. Without an OpenGL context the tests of the renderer
// are skipped, and say so.

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <optional>

#include "nade/draw/camera.h"
#include "nade/draw/gl_context.h"
#include "nade/draw/renderer.h"
#include "nade/draw/text.h"
#include "support/stage_fixture.h"
#include "support/stored_picture.h"

namespace nade::draw {
namespace {

using Vec3f = Eigen::Vector3f;

constexpr double kRadius = 0.05;
constexpr float kRadiusF = 0.05F;

TEST(Context, NoneIsSaid) {
  const Status checked = check_current_context();
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().message,
            "drawing needs OpenGL 4.5, and no context is current on this thread");
  const Result<Renderer> renderer = Renderer::create();
  ASSERT_FALSE(renderer);
  EXPECT_EQ(renderer.error().message, checked.error().message);
}

DrawnMesh ball(const Vec3f& center, float radius) {
  constexpr std::uint32_t kAround = 128;
  constexpr std::uint32_t kDown = 64;
  constexpr float kPi = std::numbers::pi_v<float>;
  DrawnMesh mesh;
  for (std::uint32_t i = 0; i <= kDown; ++i) {
    for (std::uint32_t j = 0; j < kAround; ++j) {
      const float polar = kPi * static_cast<float>(i) / kDown;
      const float turn = 2.0F * kPi * static_cast<float>(j) / kAround;
      const Vec3f normal(std::sin(polar) * std::sin(turn), std::cos(polar),
                         std::sin(polar) * std::cos(turn));
      mesh.normals.push_back(normal);
      mesh.positions.emplace_back(center + radius * normal);
    }
  }
  for (std::uint32_t i = 0; i < kDown; ++i) {
    for (std::uint32_t j = 0; j < kAround; ++j) {
      const std::uint32_t next = (j + 1) % kAround;
      const std::uint32_t a = i * kAround;
      mesh.triangles.push_back({a + j, a + kAround + j, a + next});
      mesh.triangles.push_back({a + next, a + kAround + j, a + kAround + next});
    }
  }
  return mesh;
}

DrawnMesh standing_ball() { return ball({0.0F, kRadiusF, 0.0F}, kRadiusF); }

/// A square in the plane of the picture, seen from +Z.
DrawnMesh upright_square() {
  DrawnMesh mesh;
  mesh.positions = {
      {-0.05F, -0.05F, 0.0F}, {0.05F, -0.05F, 0.0F}, {0.05F, 0.05F, 0.0F}, {-0.05F, 0.05F, 0.0F}};
  mesh.texcoords = {{0.0F, 1.0F}, {1.0F, 1.0F}, {1.0F, 0.0F}, {0.0F, 0.0F}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

Camera before_the_ball() { return looking_at({0.0, 0.10, 0.40}, {0.0, 0.04, 0.0}, 0.5, kAspect); }

/// Where a point of the world falls in a picture; pixels.
Eigen::Vector2i pixel_of(const Camera& camera, const Vec3& point) {
  const Vec3 seen = camera.pose.inverse().apply(point);
  const double x = seen.x() / -seen.z();
  const double y = seen.y() / -seen.z();
  const double left = std::tan(camera.view.left);
  const double up = std::tan(camera.view.up);
  return {static_cast<int>(kWidth * (x - left) / (std::tan(camera.view.right) - left)),
          static_cast<int>(kHeight * (up - y) / (up - std::tan(camera.view.down)))};
}

Eigen::Vector3i color_at(const Image& image, const Eigen::Vector2i& pixel) {
  const auto at = static_cast<std::size_t>(4 * (pixel.y() * image.width + pixel.x()));
  return {image.rgba[at], image.rgba[at + 1], image.rgba[at + 2]};
}

int brightness(const Image& image, const Eigen::Vector2i& pixel) {
  return color_at(image, pixel).sum();
}

class RendererTest : public testing::Test {
 protected:
  void SetUp() override {
    Result<OffscreenContext> context = OffscreenContext::create();
    if (!context) GTEST_SKIP() << context.error().message;
    context_.emplace(std::move(*context));
    Result<Renderer> renderer = Renderer::create();
    ASSERT_TRUE(renderer) << renderer.error().message;
    renderer_.emplace(std::move(*renderer));
  }
  void TearDown() override {
    if (context_) {
      EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    }
    renderer_.reset();
    context_.reset();
  }

  Renderer& renderer() { return *renderer_; }
  Image picture(const Scene& scene, const Camera& camera) {
    return renderer().picture(scene, camera, kWidth, kHeight);
  }
  /// The ball on the floor, or `lift` above it.
  Scene ball_scene(double lift) {
    Scene scene;
    Placement placement;
    placement.pose.position = {0.0, lift, 0.0};
    scene.instances.push_back({renderer().add(standing_ball()), placement});
    scene.focus_radius_m = 0.1;
    return scene;
  }

  std::optional<OffscreenContext> context_;
  std::optional<Renderer> renderer_;
};

TEST_F(RendererTest, SameSceneGivesTheSamePicture) {
  const Scene scene = ball_scene(0.0);
  const Camera camera = before_the_ball();
  const Image first = picture(scene, camera);
  static_cast<void>(renderer().picture(Scene(), camera, 64, 48));
  EXPECT_EQ(picture(scene, camera).rgba, first.rgba);
  Result<Renderer> second = Renderer::create();
  ASSERT_TRUE(second);
  Scene again = scene;
  again.instances[0].mesh = second->add(standing_ball());
  EXPECT_EQ(second->picture(again, camera, kWidth, kHeight).rgba, first.rgba);
}

TEST_F(RendererTest, EveryPixelIsOpaque) {
  Scene scene = ball_scene(0.0);
  scene.instances.push_back(scene.instances[0]);
  scene.instances[1].look = Look::ghost;
  scene.instances[1].placement.pose.position = {0.03, 0.0, 0.03};
  scene.labels.push_back({{0.0, 0.1, 0.0}, "ball"});
  const Image image = picture(scene, before_the_ball());
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) ASSERT_EQ(image.rgba[i], 255);
}

TEST_F(RendererTest, DepthsOfABall) {
  const Scene scene = ball_scene(0.0);
  const double distance = 0.4;
  const Camera camera = looking_at({0.0, kRadius, distance}, {0.0, kRadius, 0.0}, 0.5, kAspect);
  const DepthMap front = renderer().depths(scene, camera, kWidth, kHeight, Faces::front);
  const DepthMap back = renderer().depths(scene, camera, kWidth, kHeight, Faces::back);
  const auto middle = static_cast<std::size_t>(kWidth * (kHeight / 2) + kWidth / 2);
  EXPECT_NEAR(front.depth_m[middle], distance - kRadius, 1e-4);
  EXPECT_NEAR(back.depth_m[middle], distance + kRadius, 1e-4);
  EXPECT_TRUE(std::isinf(front.depth_m[0]));
  // A ball's outline is a circle whose tangent is r / sqrt(d^2 - r^2).
  const auto covered = std::count_if(front.depth_m.begin(), front.depth_m.end(),
                                     [](float depth) { return std::isfinite(depth); });
  const double outline =
      kRadius / std::sqrt(distance * distance - kRadius * kRadius) / std::tan(0.25) * kHeight / 2;
  EXPECT_NEAR(static_cast<double>(covered), std::numbers::pi * outline * outline,
              0.01 * std::numbers::pi * outline * outline);
}

TEST_F(RendererTest, FirstRowIsTheTop) {
  Scene scene = ball_scene(0.0);
  const Camera camera = looking_at({0.0, 0.0, 0.4}, {0.0, 0.0, 0.0}, 0.5, kAspect);
  const DepthMap depths = renderer().depths(scene, camera, kWidth, kHeight, Faces::front);
  EXPECT_TRUE(std::isfinite(depths.depth_m[static_cast<std::size_t>(kWidth * 80 + kWidth / 2)]));
  EXPECT_TRUE(std::isinf(depths.depth_m[static_cast<std::size_t>(kWidth * 160 + kWidth / 2)]));
  EXPECT_LT(picture(scene, camera).rgba[4 * (kWidth * 80 + kWidth / 2)], 200);
}

TEST_F(RendererTest, ShadowReachesWhatCastsIt) {
  const Camera camera = before_the_ball();
  const Image touching = picture(ball_scene(0.0), camera);
  const Image lifted = picture(ball_scene(0.01), camera);
  // Just before the point where the ball stands, and far from it.
  const int near = brightness(touching, pixel_of(camera, {0.0, 0.0, 0.012}));
  const int open = brightness(touching, pixel_of(camera, {-0.11, 0.0, 0.05}));
  EXPECT_LT(near, 0.7 * open);
  // 10 mm above, light gets under it.
  EXPECT_GT(brightness(lifted, pixel_of(camera, {0.0, 0.0, 0.012})), near + 30);
}

TEST_F(RendererTest, HoveringTwoMillimetresLooksDifferentFromTouching) {
  const Camera camera = looking_at({0.05, 0.06, 0.15}, {0.0, 0.004, 0.0}, 0.25, kAspect);
  Scene scene;
  // As large as a fingertip.
  scene.instances.push_back({renderer().add(ball({0.0F, 0.008F, 0.0F}, 0.008F)), {}});
  scene.focus_radius_m = 0.1;
  const Image touching = picture(scene, camera);
  const DepthMap first = renderer().depths(scene, camera, kWidth, kHeight, Faces::front);
  scene.instances[0].placement.pose.position = {0.0, 0.002, 0.0};
  const Image hovering = picture(scene, camera);
  const DepthMap second = renderer().depths(scene, camera, kWidth, kHeight, Faces::front);
  int floor_pixels = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto at = static_cast<std::size_t>(kWidth * y + x);
      if (std::isfinite(first.depth_m[at]) || std::isfinite(second.depth_m[at])) continue;
      if (std::abs(brightness(touching, {x, y}) - brightness(hovering, {x, y})) > 30) {
        ++floor_pixels;
      }
    }
  }
  EXPECT_GT(floor_pixels, 200);
}

TEST_F(RendererTest, GhostHidesNothingAndCastsNoShadow) {
  const Camera camera = before_the_ball();
  const Image empty = picture(Scene(), camera);
  Scene scene = ball_scene(0.0);
  scene.instances[0].look = Look::ghost;
  scene.instances[0].opacity = 0.5F;
  const Image ghost = picture(scene, camera);
  EXPECT_EQ(color_at(ghost, pixel_of(camera, {0.07, 0.0, 0.0})),
            color_at(empty, pixel_of(camera, {0.07, 0.0, 0.0})));
  // A red ball behind it is seen as red.
  DrawnMesh red = ball({0.0F, kRadiusF, -0.12F}, kRadiusF);
  red.material.base_color = {0.7F, 0.02F, 0.02F};
  scene.instances.push_back({renderer().add(red), {}});
  const Eigen::Vector3i seen = color_at(picture(scene, camera), pixel_of(camera, {0.0, 0.05, 0.0}));
  EXPECT_GT(seen.x(), seen.z() + 15);
}

TEST_F(RendererTest, LineShowsThroughFaintly) {
  const Camera camera = looking_at({0.0, kRadius, 0.4}, {0.0, kRadius, 0.0}, 0.5, kAspect);
  Scene scene = ball_scene(0.0);
  const Image without = picture(scene, camera);
  const Color green(0.0F, 0.6F, 0.0F);
  scene.lines.push_back({{-0.1, kRadius, -0.06}, {0.1, kRadius, -0.06}, green, 4.0F});
  const Image with = picture(scene, camera);
  const auto change = [&](const Vec3& point) {
    const Eigen::Vector2i pixel = pixel_of(camera, point);
    return (color_at(with, pixel) - color_at(without, pixel)).cwiseAbs().maxCoeff();
  };
  const int behind = change({0.0, kRadius, -0.06});
  const int open = change({-0.085, kRadius, -0.06});
  EXPECT_GT(behind, 15);
  EXPECT_GT(open, 2 * behind);
}

TEST_F(RendererTest, TextureAndItsSides) {
  DrawnMesh square = upright_square();
  auto texture = std::make_shared<Image>(Image::blank(32, 32));
  for (std::size_t i = 0; i < 32 * 32; ++i) {
    const bool right = i % 32 >= 16;
    const bool low = i / 32 >= 16;
    // Red and blue, under them green and white.
    texture->rgba[4 * i] = right == low ? 230 : 20;
    texture->rgba[4 * i + 1] = low ? 230 : 20;
    texture->rgba[4 * i + 2] = right ? 230 : 20;
  }
  square.texture = texture;
  square.material.base_color = Color::Ones();
  Scene scene;
  scene.floor = false;
  scene.instances.push_back({renderer().add(square), {}});
  const Camera camera = looking_at({0.0, 0.0, 0.4}, Vec3::Zero(), 0.4, kAspect);
  const Image image = picture(scene, camera);
  const auto at = [&](double x, double y) { return color_at(image, pixel_of(camera, {x, y, 0})); };
  EXPECT_GT(at(-0.04, 0.04).x(), 2 * at(-0.04, 0.04).y());
  EXPECT_GT(at(0.04, 0.04).z(), 2 * at(0.04, 0.04).x());
  EXPECT_GT(at(-0.04, -0.04).y(), 2 * at(-0.04, -0.04).x());
  EXPECT_GT(at(0.04, -0.04).minCoeff(), 100);
}

TEST_F(RendererTest, MissingNormalsAreComputed) {
  const Camera camera = before_the_ball();
  Scene scene = ball_scene(0.0);
  const Image with = picture(scene, camera);
  DrawnMesh bare = standing_ball();
  bare.normals.clear();
  scene.instances[0].mesh = renderer().add(bare);
  const Image without = picture(scene, camera);
  std::size_t differ = 0;
  for (std::size_t i = 0; i < with.rgba.size(); ++i) {
    if (std::abs(with.rgba[i] - without.rgba[i]) > 4) ++differ;
  }
  EXPECT_LT(differ, with.rgba.size() / 200);
}

TEST_F(RendererTest, ShapeMovesAndColoursComeAndGo) {
  const Camera camera = before_the_ball();
  const Scene scene = ball_scene(0.0);
  const MeshId mesh = scene.instances[0].mesh;
  const Image first = picture(scene, camera);
  const DrawnMesh moved = ball({0.0F, 0.08F, 0.0F}, kRadiusF);
  renderer().set_shape(mesh, moved.positions, moved.normals);
  const DepthMap depths = renderer().depths(scene, camera, kWidth, kHeight, Faces::front);
  const Eigen::Vector2i top = pixel_of(camera, {0.0, 0.12, 0.0});
  EXPECT_TRUE(std::isfinite(depths.depth_m[static_cast<std::size_t>(kWidth * top.y() + top.x())]));

  const DrawnMesh back = standing_ball();
  renderer().set_shape(mesh, back.positions, back.normals);
  const std::vector<Color> red(back.positions.size(), Color(1.0F, 0.0F, 0.0F));
  renderer().set_colors(mesh, red);
  const Eigen::Vector3i seen = color_at(picture(scene, camera), pixel_of(camera, {0, 0.05, 0}));
  EXPECT_GT(seen.x(), 3 * seen.y());
  renderer().set_colors(mesh, {});
  EXPECT_EQ(picture(scene, camera).rgba, first.rgba);
}

TEST_F(RendererTest, DrawsIntoPartOfAFramebufferThatEncodesToo) {
  const Camera camera = before_the_ball();
  const Scene scene = ball_scene(0.0);
  const Image expected = picture(scene, camera);
  GLuint texture = 0;
  GLuint framebuffer = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &texture);
  glTextureStorage2D(texture, 1, GL_SRGB8_ALPHA8, kWidth + 20, kHeight + 10);
  glCreateFramebuffers(1, &framebuffer);
  glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, texture, 0);
  // As a program leaves it that draws its own things.
  glEnable(GL_FRAMEBUFFER_SRGB);
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, 3, 3);
  glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
  renderer().draw(scene, camera, {framebuffer, 20, 10, kWidth, kHeight});
  std::vector<std::uint8_t> rgba(expected.rgba.size());
  glReadPixels(20, 10, kWidth, kHeight, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  glDeleteFramebuffers(1, &framebuffer);
  glDeleteTextures(1, &texture);
  const std::size_t row = 4 * kWidth;
  for (std::size_t y = 0; y < kHeight; ++y) {
    const auto flipped = static_cast<std::ptrdiff_t>(row * (kHeight - 1 - y));
    ASSERT_TRUE(std::equal(rgba.begin() + flipped,
                           rgba.begin() + flipped + static_cast<std::ptrdiff_t>(row),
                           expected.rgba.begin() + static_cast<std::ptrdiff_t>(row * y)))
        << "row " << y;
  }
}

TEST_F(RendererTest, EmptyScenesAndMeshesAreDrawn) {
  Scene scene;
  scene.instances.push_back({renderer().add(DrawnMesh()), {}});
  const Camera camera = before_the_ball();
  EXPECT_EQ(picture(scene, camera).rgba, picture(Scene(), camera).rgba);
  renderer().remove(scene.instances[0].mesh);
}

TEST_F(RendererTest, FreesWhatItHeld) {
  const auto count = [] {
    int held = 0;
    for (GLuint name = 1; name < 4000; ++name) {
      held += glIsBuffer(name) + glIsTexture(name) + glIsFramebuffer(name) + glIsProgram(name) +
              glIsVertexArray(name) + glIsRenderbuffer(name);
    }
    return held;
  };
  renderer_.reset();
  EXPECT_EQ(count(), 0);
  Result<Renderer> made = Renderer::create();
  ASSERT_TRUE(made);
  renderer_.emplace(std::move(*made));
  const Scene scene = ball_scene(0.0);
  static_cast<void>(picture(scene, before_the_ball()));
  renderer().remove(scene.instances[0].mesh);
  const int before = count();
  for (int i = 0; i < 20; ++i) renderer().remove(renderer().add(standing_ball()));
  EXPECT_EQ(count(), before);
  renderer_.reset();
  EXPECT_EQ(count(), 0);
}

/// One of everything.
Scene reference_scene(Renderer& renderer) {
  Scene scene;
  DrawnMesh skin = standing_ball();
  skin.material = {{0.62F, 0.36F, 0.27F}, 0.5F, 0.0F, 0.0F, 0.55F};
  DrawnMesh coat = ball({0.09F, 0.035F, -0.02F}, 0.035F);
  coat.material = {{0.45F, 0.24F, 0.09F}, 0.9F, 0.0F, 0.7F, 0.0F};
  DrawnMesh metal = ball({-0.07F, 0.02F, 0.04F}, 0.02F);
  metal.material = {{0.9F, 0.75F, 0.5F}, 0.25F, 1.0F, 0.0F, 0.0F};
  for (const DrawnMesh& mesh : {skin, coat, metal}) {
    scene.instances.push_back({renderer.add(mesh), {}});
  }
  Instance ghost{scene.instances[0].mesh, {}};
  ghost.look = Look::ghost;
  ghost.opacity = 0.5F;
  ghost.placement.pose.position = {0.02, 0.015, 0.05};
  ghost.tint = {0.3F, 0.5F, 0.9F};
  scene.instances.push_back(ghost);
  scene.lines.push_back({{-0.08, 0.09, 0.0}, {0.08, 0.02, 0.0}, {0.8F, 0.3F, 0.0F}, 2.0F});
  scene.arrows.push_back({{0.0, 0.1, 0.0}, {0.0, 0.14, 0.0}, {0.0F, 0.2F, 0.7F}, 0.002F});
  scene.dots.push_back({{0.0, 0.1, 0.0}, {0.8F, 0.7F, 0.0F}, 0.004F});
  scene.labels.push_back({{0.0, 0.13, 0.0}, "n", {0.0F, 0.2F, 0.7F}, 16.0F});
  scene.focus_radius_m = 0.15;
  return scene;
}

TEST_F(RendererTest, IsTheStoredPicture) {
  const Camera camera = looking_at({0.12, 0.16, 0.36}, {0.0, 0.05, 0.0}, 0.5, 1.5);
  test::expect_stored(renderer().picture(reference_scene(renderer()), camera, 144, 96),
                      "one_of_everything");
}

TEST_F(RendererTest, SoftGradientsDoNotFallIntoBands) {
  constexpr int kRow = 8;
  const Image image = picture(Scene(), looking_at({0.0, 0.3, 0.5}, {0.0, 0.3, 0.0}, 0.5, kAspect));
  // A band is a run of one shade; a grain breaks it up.
  int longest = 0;
  for (int x = 1, run = 1; x < kWidth; ++x) {
    run = color_at(image, {x, kRow}) == color_at(image, {x - 1, kRow}) ? run + 1 : 1;
    longest = std::max(longest, run);
  }
  EXPECT_LT(longest, 12);
}

}  // namespace
}  // namespace nade::draw
