#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "nade/draw/renderer.h"
#include "room.h"

struct GLFWwindow;

namespace nade::xr {

/// What the operator is told of the moment.
struct MirrorFigures {
  std::string object;
  Method method = Method::nade;
  FrameCost cost;
  double frames_a_second = 0.0;
  std::array<HandStatus, 2> hands{HandStatus::untracked, HandStatus::untracked};
  std::array<double, 2> depth_m{};  ///< how deep the tracked hand's deepest part has sunk in
};

/// Carries what the participant's left eye sees from the frames' thread to the window's, some times
/// a second. Frames never wait for it.
class MirrorFeed {
 public:
  MirrorFeed() = default;
  MirrorFeed(const MirrorFeed&) = delete;
  MirrorFeed& operator=(const MirrorFeed&) = delete;

  /// The eye's picture, drawn and not yet given back; called in the frame, in its context.
  void take(const draw::Target& eye, const Room& room);
  /// The newest picture, bottom row first; false where there is no newer one.
  [[nodiscard]] bool give(draw::Image& picture, MirrorFigures& figures);

  /// There will be no more frames.
  void end() { ended_.store(true); }
  [[nodiscard]] bool ended() const { return ended_.load(); }
  /// The operator has closed the window.
  void close() { closed_.store(true); }
  [[nodiscard]] bool closed() const { return closed_.load(); }

 private:
  void fetch();

  unsigned buffer_ = 0;    ///< on the graphics card, where the picture waits
  void* fence_ = nullptr;  ///< passed when it has arrived there
  int width_ = 0;
  int height_ = 0;
  std::int64_t last_ns_ = 0;
  std::int64_t last_frame_ns_ = 0;
  double frames_a_second_ = 0.0;
  std::atomic<bool> ended_{false};
  std::atomic<bool> closed_{false};
  MirrorFigures taken_;
  std::mutex mutex_;  ///< of what follows
  draw::Image picture_;
  MirrorFigures figures_;
  bool fresh_ = false;
};

/// The operator's window. Of the main thread.
class MirrorWindow {
 public:
  /// The error says that there is no display.
  [[nodiscard]] static Result<MirrorWindow> open();

  /// Shows what the feed carries until it has ended; tells it when the window is closed.
  void show(MirrorFeed& feed);

 private:
  struct Closer {
    void operator()(GLFWwindow* window) const;
  };
  explicit MirrorWindow(GLFWwindow* window) : window_(window) {}

  std::unique_ptr<GLFWwindow, Closer> window_;
};

}  // namespace nade::xr
