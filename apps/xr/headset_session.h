#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "graphics_binding.h"
#include "headset.h"
#include "nade/draw/renderer.h"
#include "tracked_frame.h"

namespace nade::xr {

/// How a session goes on.
enum class Fate : std::uint8_t {
  goes_on,
  ended,          ///< the person or the runtime ended it
  session_lost,   ///< another session of the same instance may be begun
  instance_lost,  ///< the runtime has gone
  failed,         ///< a call failed for good: `complaint` says which
};

/// A swapchain: the pictures that one eye is shown.
class EyePictures {
 public:
  /// The error names what the runtime refused.
  [[nodiscard]] static Result<EyePictures> create(const XrApi& api, XrSession session,
                                                  const EyeSize& size);
  EyePictures(EyePictures&&) noexcept = default;
  EyePictures& operator=(EyePictures&&) noexcept = default;
  ~EyePictures() = default;

  [[nodiscard]] XrSwapchain swapchain() const { return swapchain_.get(); }
  [[nodiscard]] const EyeSize& size() const { return size_; }
  [[nodiscard]] unsigned framebuffer(std::uint32_t image) const {
    return framebuffers_[image].name;
  }

 private:
  struct Framebuffer {
    unsigned name = 0;
    Framebuffer() = default;
    Framebuffer(Framebuffer&& other) noexcept : name(std::exchange(other.name, 0U)) {}
    Framebuffer& operator=(Framebuffer&& other) noexcept {
      std::swap(name, other.name);
      return *this;
    }
    ~Framebuffer() {
      if (name != 0) glDeleteFramebuffers(1, &name);
    }
  };
  EyePictures() = default;

  XrHandle<XrSwapchain> swapchain_;
  EyeSize size_;
  std::vector<Framebuffer> framebuffers_;  ///< one an image; gone before the swapchain is
};

/// One run of ours on a headset, from its creation to its end or loss. Called from the thread whose
/// OpenGL context the binding made.
class HeadsetSession {
 public:
  /// The error names what the runtime refused. `headset` and `binding` must outlive the session.
  [[nodiscard]] static Result<std::unique_ptr<HeadsetSession>> create(
      const Headset& headset, const GraphicsBinding& binding);
  HeadsetSession(const HeadsetSession&) = delete;
  HeadsetSession& operator=(const HeadsetSession&) = delete;
  ~HeadsetSession() = default;

  /// Takes what the runtime has to say: begins, ends. To be called before every frame.
  Fate poll();
  /// Whether there are frames to be made now.
  [[nodiscard]] bool running() const { return running_; }
  /// Asks the runtime to end the session; it then says so in `poll`.
  void request_exit();

  /// Waits for the next frame, begins it, and locates eyes, head and hands at the moment it will be
  /// shown. Without a value where none could be begun: see `fate`. A frame that was begun has to be
  /// ended. The first call allocates.
  const TrackedFrame* begin_frame();
  /// The picture to draw one eye's view into; no value where it is not to be had.
  [[nodiscard]] std::optional<draw::Target> acquire(std::size_t eye);
  void release(std::size_t eye);
  /// Shows what was drawn of both eyes since `begin_frame`; nothing where it was not both.
  void end_frame();

  [[nodiscard]] Fate fate() const { return fate_; }
  [[nodiscard]] const std::string& complaint() const { return complaint_; }
  /// Height of the floor in the space that everything is located in.
  [[nodiscard]] double floor_y() const { return floor_y_; }
  [[nodiscard]] const std::array<EyeSize, 2>& eyes() const { return headset_->eyes(); }

 private:
  explicit HeadsetSession(const Headset& headset) : headset_(&headset) {}
  [[nodiscard]] Status create_session(const GraphicsBinding& binding);
  [[nodiscard]] Status create_spaces();
  [[nodiscard]] Status create_hands();
  bool check(XrResult result, const char* what);
  void take_state(XrSessionState state);
  void locate(XrTime time);
  void locate_hand(std::size_t side, XrTime time);

  const Headset* headset_;
  XrHandle<XrSession> session_;
  XrHandle<XrSpace> base_;
  XrHandle<XrSpace> head_;
  double floor_y_ = 0.0;
  std::array<XrHandle<XrHandTrackerEXT>, 2> hands_;
  std::vector<EyePictures> pictures_;
  XrSessionState state_ = XR_SESSION_STATE_UNKNOWN;
  bool running_ = false;
  Fate fate_ = Fate::goes_on;
  std::string complaint_;
  XrFrameState frame_state_{};
  std::array<XrView, 2> views_{};
  bool views_valid_ = false;
  std::array<bool, 2> drawn_{};
  std::array<XrHandJointLocationEXT, XR_HAND_JOINT_COUNT_EXT> joints_{};
  TrackedFrame frame_;
};

}  // namespace nade::xr
