// What a frame costs the headset's thread. Mesa's drivers leave out the drawing here, which without
// a graphics card would be done on this very thread.
#include <epoxy/gl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "frame_costs.h"
#include "support/allocation_counter.h"
#include "support/sanitized.h"
#include "xr/room_fixture.h"

namespace nade::xr {
namespace {

// The driver that leaves it out forgets memory, which the sanitizers would hold against us.
[[maybe_unused]] const bool kNothingIsDrawn =
    !test::kSanitized && ::setenv("GALLIUM_NOOP", "1", 1) == 0;

/// Whether a child process that does this lives to its end.
template <class Work>
bool survives(Work work) {
  const pid_t child = ::fork();
  if (child == 0) {
    work();
    ::_exit(0);
  }
  int status = 0;
  return child < 0 || (::waitpid(child, &status, 0) == child && WIFEXITED(status));
}

/// Both hands on the ball, and the tracked ones as ghosts.
class FrameTest : public RoomTest {
 protected:
  void SetUp() override {
    const auto draw_some = [this] {
      prepare();
      if (room_) pass(60);
      room_.reset();
      context_.reset();
    };
    static const bool kDriverLives = test::kSanitized || survives(draw_some);
    if (!kDriverLives) GTEST_SKIP() << "this Mesa's driver that draws nothing (25's) crashes";
    prepare();
  }
  void prepare() {
    RoomTest::SetUp();
    if (!room_) return;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
    glTextureStorage2D(texture_, 1, GL_SRGB8_ALPHA8, kWidth, kHeight);
    glCreateFramebuffers(1, &framebuffer_);
    glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, texture_, 0);
    Show show = chooser_.show();
    show.shown = draw::Shown::both;
    room_->set(show);
  }
  void pass(int frames) {
    const draw::Target target{framebuffer_, 0, 0, kWidth, kHeight};
    for (const int end = next_ + frames; next_ < end; ++next_) {
      TrackedFrame frame = frame_at(bind_, next_);
      const std::size_t left = index_of(Handedness::left);
      frame.hands[left] = frame_at(left_bind_, next_ + 30).hands[left];
      room_->update(frame);
      room_->draw({draw::Sight{frame.eyes[0], target}, draw::Sight{frame.eyes[1], target}});
      costs_.add(room_->cost());
    }
  }

  FrameCosts costs_;

 private:
  unsigned texture_ = 0;
  unsigned framebuffer_ = 0;
  int next_ = 0;
};

TEST_F(FrameTest, DoesNotAllocate) {
  // Under sanitizers they are drawn, in software.
  const int frames = test::kSanitized ? 10 : 40;
  pass(frames);
  EXPECT_EQ(test::allocations_of([&] { pass(2 * frames); }), 0U);
}

/// The same on a ball that gives way, and on a dog that moves.
class NaturalFrameTest : public FrameTest {
 protected:
  void furnish(RoomSetup& setup) override {
    setup.objects = {"sphere", "dog:alive"};
    setup.corrector.settle.softness_m = 0.005;
  }
};

TEST_F(NaturalFrameTest, DoesNotAllocate) {
  Show show = room_->show();
  for (const char* const object : {"sphere", "dog:alive"}) {
    show.object = object;
    room_->set(show);
    pass(60);
    EXPECT_EQ(test::allocations_of([&] { pass(60); }), 0U) << object;
  }
}

TEST_F(FrameTest, TakesUnderTwoMillisecondsOfTheProcessor) {
  if (test::kSanitized) GTEST_SKIP() << "not a question under sanitizers";
  pass(500);
  std::printf("%s\n", as_text(costs_).c_str());
  EXPECT_GT(costs_.frames(), 300U);
  EXPECT_LT(costs_.report().together.median_ms, 2.0);
}

}  // namespace
}  // namespace nade::xr
