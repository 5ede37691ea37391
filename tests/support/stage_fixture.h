#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "nade/draw/camera.h"
#include "nade/draw/gl_context.h"
#include "nade/draw/stage.h"
#include "nade/io/hand_file.h"

namespace nade::draw {

inline constexpr int kWidth = 320;
inline constexpr int kHeight = 240;
inline constexpr double kAspect = static_cast<double>(kWidth) / kHeight;

inline HandMesh load_hand(Handedness side) {
  const std::string path =
      std::string(NADE_TEST_HANDS_DIR) + "/" + std::string(name_of(side)) + ".glb";
  Result<HandMesh> mesh = load_hand_mesh(path, side);
  EXPECT_TRUE(mesh.ok()) << path;
  return mesh.ok() ? std::move(*mesh) : HandMesh{};
}

inline std::size_t count_covered(const DepthMap& map) {
  return static_cast<std::size_t>(std::count_if(map.depth_m.begin(), map.depth_m.end(),
                                                [](float d) { return std::isfinite(d); }));
}

/// Red over green and blue: about a half where grey.
inline double red_share(const Image& image, int x, int y) {
  const auto at = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                       static_cast<std::size_t>(x));
  return image.rgba[at] / (1.0 + image.rgba[at + 1] + image.rgba[at + 2]);
}

/// A stage with both hands, and an object on it; skipped where nothing can be drawn.
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

  static StageFrame frame_of(const HandPose& hand, Method method = Method::none) {
    StageFrame frame;
    frame.hands[index_of(hand.side)] = StagedHand{hand, hand, {}, {}, method};
    return frame;
  }

  DepthMap hand_depths(const HandPose& hand, const Camera& camera, Method method = Method::none) {
    static_cast<void>(stage_->arrange(frame_of(hand, method)));
    return renderer_->depths(stage_->hand_only(), camera, kWidth, kHeight, Faces::front);
  }

  /// Pixels where the hand's nearest skin lies in the object: behind its front, before its back,
  /// by more than half a millimetre.
  std::size_t penetrating_pixels(const HandPose& hand, const Camera& camera,
                                 Method method = Method::none) {
    constexpr float kTolerance = 0.0005F;
    const DepthMap skin = hand_depths(hand, camera, method);
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

inline Camera above(double height_m = 0.6) {
  return looking_at({0.0, height_m, 0.02}, {0.0, 0.0, 0.0}, 0.6, kAspect);
}

}  // namespace nade::draw
