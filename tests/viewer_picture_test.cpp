#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "headless.h"
#include "nade/eval/synth.h"
#include "nade/io/hand_file.h"
#include "support/cli_run.h"
#include "support/viewer_assets.h"

// The viewer's program without a display, driven by scripts as a person would, and the same
// program in a window on a virtual X server.

namespace nade::viewer {
namespace {

constexpr int kWidth = 1280;
constexpr int kHeight = 720;

ViewerSetup setup_of(const std::string& object, Method method = Method::nade) {
  ViewerSetup setup;
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    const std::string file =
        std::string(NADE_TEST_HANDS_DIR "/") + std::string(name_of(side)) + ".glb";
    setup.session.meshes[index_of(side)] = *load_hand_mesh(file, side);
  }
  setup.session.relaxed = *load_relaxed_hand(Handedness::right);
  setup.session.corrector.method = method;
  setup.object = object;
  return setup;
}

/// A viewer that does what scripts say.
class Driven {
 public:
  explicit Driven(ViewerSetup setup)
      : headless_(HeadlessViewer::create(std::move(setup), kWidth, kHeight)) {}

  HeadlessViewer& operator*() { return *headless_; }
  HeadlessViewer* operator->() { return &*headless_; }
  Viewer& viewer() { return headless_->viewer(); }

  /// Runs so many frames; the script's first frame is the next one.
  void play(const std::string& script, std::size_t frames) {
    Result<std::vector<ScriptedStep>> steps = parse_script(script, "script");
    ASSERT_TRUE(steps.ok()) << steps.error().message;
    ScriptPlayer player(*steps);
    for (std::size_t i = 0; i < frames; ++i) {
      const Result<std::vector<Event>> events = player.next(viewer().ui());
      ASSERT_TRUE(events.ok()) << events.error().message;
      // Only the last frame is looked at.
      headless_->frame(*events, i + 1 == frames ? Drawing::all : Drawing::controls);
    }
  }

 private:
  Result<HeadlessViewer> headless_;
};

/// How many pixels of the pictures differ within a viewport.
std::size_t differing(const draw::Image& a, const draw::Image& b, const Viewport& within) {
  std::size_t count = 0;
  for (int y = within.y; y < within.y + within.height; ++y) {
    for (int x = within.x; x < within.x + within.width; ++x) {
      const std::size_t at = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(a.width) +
                                  static_cast<std::size_t>(x));
      if (!std::equal(&a.rgba[at], &a.rgba[at] + 3, &b.rgba[at])) ++count;
    }
  }
  return count;
}

struct HandPixels {
  std::size_t seen = 0;    ///< the hand before the object
  std::size_t sunken = 0;  ///< the hand's near side within the object, 1 mm deep or more
};

/// Compares the depths of hand and object from the viewer's own camera.
HandPixels hand_pixels(Viewer& viewer) {
  const int width = viewer.viewport().width / 2;
  const int height = viewer.viewport().height / 2;
  const auto depths = [&](const draw::Scene& scene, draw::Faces faces) {
    return viewer.renderer().depths(scene, viewer.camera(), width, height, faces);
  };
  const draw::DepthMap hand = depths(viewer.stage().hand_only(), draw::Faces::front);
  const draw::DepthMap object = depths(viewer.stage().object_only(), draw::Faces::front);
  const draw::DepthMap behind = depths(viewer.stage().object_only(), draw::Faces::back);
  HandPixels pixels;
  for (std::size_t i = 0; i < hand.depth_m.size(); ++i) {
    if (!std::isfinite(hand.depth_m[i])) continue;
    if (hand.depth_m[i] <= object.depth_m[i]) ++pixels.seen;
    if (hand.depth_m[i] > object.depth_m[i] + 0.001F && hand.depth_m[i] < behind.depth_m[i]) {
      ++pixels.sunken;
    }
  }
  return pixels;
}

class ViewerPictureTest : public testing::Test {
 protected:
  void SetUp() override {
    const Result<draw::OffscreenContext> context = draw::OffscreenContext::create();
    if (!context) GTEST_SKIP() << context.error().message;
  }
};

const char* const kStroke =
    "0 move 640 320\n"
    "2 wheel 3\n"
    "4 glide 700 350 10\n";

TEST_F(ViewerPictureTest, HandOfTheMouseLiesOnTheObject) {
  Driven driven(setup_of("sphere", Method::nade));
  driven.play(kStroke, 24);
  const HandPixels nade = hand_pixels(driven.viewer());
  EXPECT_GT(nade.seen, 4'000U);
  driven.play("0 click method:none", 6);
  const HandPixels none = hand_pixels(driven.viewer());
  EXPECT_GT(none.sunken, 1'000U) << "without correction the hand is in the ball";
  EXPECT_LT(nade.sunken, none.sunken / 20);
}

TEST_F(ViewerPictureTest, ThePictureShowsTheHand) {
  Driven driven(setup_of("plane"));
  driven.play(kStroke, 20);
  const draw::Image with = driven->picture();
  const draw::Scene without = driven.viewer().stage().object_only();
  const Viewport& viewport = driven.viewer().viewport();
  const HandPixels hand = hand_pixels(driven.viewer());
  const draw::Image bare = driven.viewer().renderer().picture(without, driven.viewer().camera(),
                                                              viewport.width, viewport.height);
  std::size_t other = 0;
  for (int y = 0; y < viewport.height; ++y) {
    for (int x = 0; x < viewport.width; ++x) {
      const auto at = [&](const draw::Image& image, int px, int py) {
        return &image.rgba[4 * (static_cast<std::size_t>(py * image.width + px))];
      };
      if (!std::equal(at(with, x + viewport.x, y + viewport.y),
                      at(with, x + viewport.x, y + viewport.y) + 3, at(bare, x, y))) {
        ++other;
      }
    }
  }
  EXPECT_GT(other, 3 * hand.seen) << "at a quarter of the pixels, the hand and its shadow";
}

TEST_F(ViewerPictureTest, MethodsObjectsAndWhatIsShownChangeThePicture) {
  Driven driven(setup_of("plane"));
  driven.play(kStroke, 20);
  const Viewport scene = driven.viewer().viewport();
  draw::Image before = driven->picture();
  for (const char* const widget :
       {"method:none", "method:paper", "show:both", "overlay:contacts", "overlay:penetration",
        "hand:left", "view:top", "object:sphere"}) {
    driven.play(std::string("0 click ") + widget, 12);
    const draw::Image after = driven->picture();
    EXPECT_GT(differing(before, after, scene), 100U) << widget;
    before = after;
  }
  EXPECT_EQ(driven.viewer().session().loaded().spec, "sphere");
  EXPECT_EQ(driven.viewer().session().corrector().method, Method::paper);
}

TEST_F(ViewerPictureTest, WheelPressesAndKeysHoldTheHand) {
  Driven driven(setup_of("plane"));
  driven.play("0 move 640 320\n1 wheel -2\n2 hold q\n2 hold f\n2 hold w\n12 release q\n", 20);
  const MouseHandSettings& hand = driven.viewer().session().mouse_hand().settings();
  EXPECT_NEAR(hand.depth_m, 0.016, 1e-9);
  EXPECT_NEAR(hand.turn_rad, 10.0 / 60.0 * 1.5708, 1e-3);
  EXPECT_GT(hand.shape.curl, 0.3);
  EXPECT_GT(hand.tilt_rad, 0.2);
  driven.play("0 key c\n1 key x", 4);
  EXPECT_NEAR(hand.shape.curl, 1.5 * 4.0 / 60.0, 1e-9) << "as at first, but f is still held";
  EXPECT_EQ(hand.side, Handedness::left);
}

TEST_F(ViewerPictureTest, CoarseIsTheSamePictureMoreBlurred) {
  Driven driven(setup_of("plane"));
  driven.play(kStroke, 20);
  const draw::Image fine = driven->picture();
  driven.play("0 click view:coarse", 4);
  const draw::Image coarse = driven->picture();
  const Viewport scene = driven.viewer().viewport();
  EXPECT_GT(differing(fine, coarse, scene), 1'000U);
  double sum = 0.0;
  for (std::size_t i = 0; i < fine.rgba.size(); ++i) sum += std::abs(fine.rgba[i] - coarse.rgba[i]);
  EXPECT_LT(sum / static_cast<double>(fine.rgba.size()), 2.0);
}

TEST_F(ViewerPictureTest, RightDragTurnsTheViewAndLeavesTheHand) {
  Driven driven(setup_of("plane"));
  driven.play("0 move 640 320", 30);
  const Vec3 palm = driven.viewer().session().hands()[1]->tracked[Joint::palm].position;
  const Vec3 eye = driven.viewer().camera().pose.position;
  driven.play("0 move 640 320\n1 down right\n2 glide 740 320 8\n", 12);
  EXPECT_GT((driven.viewer().camera().pose.position - eye).norm(), 0.1);
  const Vec3 now = driven.viewer().session().hands()[1]->tracked[Joint::palm].position;
  EXPECT_LT((now - palm).norm(), 0.01);
}

TEST_F(ViewerPictureTest, TheSameScriptGivesTheSamePicture) {
  const auto take = [] {
    Driven driven(setup_of("sphere"));
    driven.play(kStroke, 15);
    return driven->picture();
  };
  const draw::Image first = take();
  EXPECT_EQ(first.rgba, take().rgba);
}

TEST_F(ViewerPictureTest, EveryKeyIsShownAndEveryWidgetSaysWhatItIs) {
  Driven driven(setup_of("plane"));
  driven.play("0 move 640 600", 4);
  const Viewport scene = driven.viewer().viewport();
  const draw::Image plain = driven->picture();
  driven.play("0 key ?", 4);
  EXPECT_GT(differing(plain, driven->picture(), scene), 50'000U) << "the keys";
  driven.play("0 key escape", 4);
  // Every widget that is hovered for a while grows a tooltip beside it.
  const std::vector<Widget> widgets = driven.viewer().ui().widgets();
  EXPECT_GT(widgets.size(), 35U);
  for (const std::size_t i : {std::size_t{0}, widgets.size() / 2, widgets.size() - 2}) {
    driven.play("0 move " + std::to_string(0.5F * (widgets[i].left + widgets[i].right)) + " " +
                    std::to_string(0.5F * (widgets[i].top + widgets[i].bottom)),
                3);
    const draw::Image before = driven->picture();
    driven.play("", 30);
    EXPECT_GT(differing(before, driven->picture(), {0, 0, kWidth, kHeight}), 1'500U)
        << widgets[i].name;
  }
}

void expect_tidy(const UiKit& ui) {
  const std::vector<Widget>& widgets = ui.widgets();
  for (std::size_t i = 0; i < widgets.size(); ++i) {
    const Widget& a = widgets[i];
    EXPECT_GE(a.left, 0.0F) << a.name;
    EXPECT_LE(a.right, static_cast<float>(kWidth)) << a.name;
    EXPECT_GE(a.top, 0.0F) << a.name;
    EXPECT_LE(a.bottom, static_cast<float>(kHeight)) << a.name;
    for (std::size_t j = i + 1; j < widgets.size(); ++j) {
      const Widget& b = widgets[j];
      EXPECT_NE(a.name, b.name);
      const bool apart =
          a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top;
      EXPECT_TRUE(apart) << a.name << " lies over " << b.name;
    }
  }
}

TEST_F(ViewerPictureTest, ControlsGrowWithSmallPixels) {
  ViewerSetup setup = setup_of("plane");
  setup.scale = 2.0F;
  Result<HeadlessViewer> headless = HeadlessViewer::create(std::move(setup), 2560, 1440);
  ASSERT_TRUE(headless.ok());
  headless->frame({}, Drawing::controls);
  const Widget* const button = headless->viewer().ui().find("method:none");
  ASSERT_NE(button, nullptr);
  EXPECT_GT(button->bottom - button->top, 40.0F);
  EXPECT_EQ(headless->viewer().viewport().height % 2, 0);
  EXPECT_NEAR(headless->viewer().viewport().aspect(), layout_of(1280, 720, true).scene.aspect(),
              0.01);
}

TEST_F(ViewerPictureTest, NothingOverlaps) {
  Driven driven(setup_of("plane"));
  driven.play("0 move 640 320", 2);
  expect_tidy(driven.viewer().ui());
  const Widget* const lowest = driven.viewer().ui().find("hand:follows");
  ASSERT_NE(lowest, nullptr);
  EXPECT_LE(lowest->bottom, kHeight - 4);
}

/// With a recording to play.
class ViewerClipTest : public ViewerPictureTest {
 protected:
  void SetUp() override {
    ViewerPictureTest::SetUp();
    const Result<LoadedObject> object = load_object("plane");
    SynthOptions options;
    options.duration_s = 1.0;
    Result<StrokeSynth> synth =
        StrokeSynth::create(*object, {}, *load_relaxed_hand(Handedness::right), options);
    Result<RecordingWriter> writer = RecordingWriter::create(recording(), synth->header());
    while (const std::optional<RecordedFrame> frame = synth->next()) {
      ASSERT_TRUE(writer->write(*frame).ok());
    }
    ASSERT_TRUE(writer->finish().ok());
  }
  [[nodiscard]] std::string recording() const { return scratch_.path("stroke.jsonl"); }

  test::ScratchFolder scratch_;
};

TEST_F(ViewerClipTest, PlaysStopsStepsAndScrubs) {
  ViewerSetup setup = setup_of("plane");
  setup.recording = recording();
  Driven driven(std::move(setup));
  driven.play("", 20);
  const Playback& playback = driven.viewer().session().playback();
  EXPECT_NEAR(static_cast<double>(playback.index), 28.0, 3.0);
  expect_tidy(driven.viewer().ui());
  driven.play("0 click play", 4);
  EXPECT_FALSE(playback.playing);
  const std::size_t stopped = playback.index;
  driven.play("0 click step:ahead", 4);
  EXPECT_EQ(playback.index, stopped + 1);
  driven.play("0 key left\n2 key left", 4);
  EXPECT_EQ(playback.index, stopped - 1);
  driven.play("0 click scrub 0.75", 4);
  EXPECT_NEAR(static_cast<double>(playback.index), 67.0, 3.0);
  driven.play("0 click speed\n4 click loop", 8);
  EXPECT_DOUBLE_EQ(playback.speed, 2.0);
  EXPECT_FALSE(playback.loop);
  driven.play("0 click press 0.5", 4);
  EXPECT_NEAR(driven.viewer().session().press_m().value_or(0.0), 0.03, 0.002);
  driven.play("0 click close", 6);
  EXPECT_EQ(driven.viewer().session().clip(), nullptr);
}

TEST_F(ViewerClipTest, DroppedFilesAreOpenedOrSayWhyNot) {
  std::ofstream(scratch_.path("bad.jsonl")) << "nonsense\n";
  Driven driven(setup_of("plane"));
  driven.play("0 drop " + scratch_.path("bad.jsonl"), 3);
  ASSERT_EQ(driven.viewer().desk().notices.size(), 1U);
  EXPECT_NE(driven.viewer().desk().notices[0].text.find("bad.jsonl"), std::string::npos);
  EXPECT_NE(driven.viewer().ui().find("notices:close"), nullptr);
  EXPECT_EQ(driven.viewer().session().clip(), nullptr);
  driven.play("0 drop " + recording(), 3);
  ASSERT_NE(driven.viewer().session().clip(), nullptr);
  EXPECT_TRUE(driven.viewer().session().hands()[1]);
}

/// `nade view` as it is installed.
class ViewCommandTest : public test::CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    test::write_file(path("script.txt"),
                     "0 click object:sphere\n4 move 500 320\n5 wheel 4\n6 glide 560 350 8\n"
                     "20 click method:paper\n24 move 560 350\n");
  }

  static constexpr const char* kNoVirtualDisplay = "Xvfb is not installed";
  [[nodiscard]] bool has_virtual_display() const { return shell("command -v Xvfb").status == 0; }
  /// On an X server of its own, which says its number once it can be used; xvfb-run sometimes
  /// fails to clean up after itself. Without looking for leaks: GLX's drivers leave a few bytes
  /// behind when they are unloaded.
  [[nodiscard]] test::Ran on_virtual_display(const std::string& command) const {
    return shell(
        "mkfifo display; Xvfb -displayfd 3 -screen 0 1400x900x24 -nolisten tcp 3>display "
        ">/dev/null 2>&1 & server=$!\n"
        "read -r number <display; env ASAN_OPTIONS=detect_leaks=0 DISPLAY=:$number " +
        command + "\nstatus=$?; kill $server; wait $server; exit $status");
  }
};

TEST_F(ViewCommandTest, WithoutADisplayItSaysWhatIsMissing) {
  const test::Ran ran = shell("unset DISPLAY WAYLAND_DISPLAY; \"$NADE\" view");
  expect_failure(ran, "DISPLAY is not set");
  EXPECT_NE(ran.err.find("--headless"), std::string::npos);
}

TEST_F(ViewCommandTest, AStudyThatCannotBeginLeavesNothing) {
  ASSERT_EQ(nade("study plan -o plan.json").status, 0);
  const test::Ran ran = shell(
      "unset DISPLAY WAYLAND_DISPLAY; \"$NADE\" study run plan.json --participant P01 -d "
      "some/where");
  expect_failure(ran, "DISPLAY is not set");
  EXPECT_NE(ran.err.find("--xr"), std::string::npos) << ran.err;
  expect_misuse(nade("study run plan.json --participant P01 --headless"), "expected --script FILE");
  test::write_file(path("script.txt"), "1 click study:none\n");
  expect_failure(nade("study run plan.json --participant P01 --headless --script script.txt"),
                 "no widget is called 'study:none'");
  EXPECT_EQ(files(), (std::vector<std::string>{"plan.json", "script.txt"}));
}

TEST_F(ViewCommandTest, AStudyGoesByAScript) {
  ASSERT_EQ(nade("study plan -o plan.json").status, 0);
  test::write_file(path("script.txt"), "20 click study:4\n40 click study:1\n");
  const test::Ran ran =
      nade("study run plan.json --participant P01 --headless --script script.txt --size 640x480");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_NE(test::read_file(path("plan/P01/log.jsonl")).find("\"event\":\"practice\""),
            std::string::npos);
}

TEST_F(ViewCommandTest, AScreenshotIsAPngOfItsOwn) {
  test::write_file(path("script.png"), "");
  expect_misuse(nade("view --headless --screenshot v.jpg"),
                "--screenshot: expected a name ending in .png, found 'v.jpg'");
  expect_misuse(nade("view --headless --script script.png --screenshot script.png"),
                "--screenshot: expected another file than that of --script");
}

TEST_F(ViewCommandTest, BadScriptIsNamed) {
  test::write_file(path("script.txt"), "0 click no-such-thing\n");
  expect_failure(nade("view --headless --object plane --frames 5 --script script.txt"),
                 "no widget is called 'no-such-thing'");
  test::write_file(path("script.txt"), "0 jump\n");
  expect_failure(nade("view --headless --script script.txt"), "script.txt: line 1: expected");
}

TEST_F(ViewCommandTest, ScriptThatIsLongerThanTheRunIsNamed) {
  test::write_file(path("script.txt"), "3 wheel 1\n58 click object:sphere\n");
  expect_failure(nade("view --headless --script script.txt --screenshot v.png"),
                 "script: the run ends after 60 frames, and steps are left over: expected --frames "
                 "61 or more");
  expect_failure(nade("view --frames 58 --script script.txt"), "expected --frames 61 or more");
  EXPECT_EQ(files(), std::vector<std::string>{"script.txt"});
}

TEST_F(ViewCommandTest, TakesAStrokeInAWindow) {
  if (!has_virtual_display()) GTEST_SKIP() << kNoVirtualDisplay;
  const std::string options =
      "view --object plane --size 1000x700 --frames 30 --script script.txt --screenshot ";
  const test::Ran window = on_virtual_display("\"$NADE\" " + options + "window.png");
  ASSERT_EQ(window.status, 0) << window.err;
  EXPECT_EQ(window.err, "");
  const test::Ran headless = nade("view --headless" + options.substr(4) + "memory.png");
  ASSERT_EQ(headless.status, 0) << headless.err;
  const Result<draw::Image> seen = draw::load_image(path("window.png"));
  const Result<draw::Image> drawn = draw::load_image(path("memory.png"));
  ASSERT_TRUE(seen.ok() && drawn.ok());
  ASSERT_EQ(seen->width, 1000);
  ASSERT_EQ(seen->height, 700);
  const Viewport scene = layout_of(1000, 700, true).scene;
  EXPECT_LT(differing(*seen, *drawn, scene), 2'000U) << "the window shows what memory does";
}

TEST_F(ViewCommandTest, OldOpenGLIsNamed) {
  if (!has_virtual_display()) GTEST_SKIP() << kNoVirtualDisplay;
  const test::Ran ran = on_virtual_display(
      "__GLX_VENDOR_LIBRARY_NAME=mesa MESA_GL_VERSION_OVERRIDE=3.3 \"$NADE\" view --frames 2");
  expect_failure(ran, "OpenGL 4.5");
}

}  // namespace
}  // namespace nade::viewer
