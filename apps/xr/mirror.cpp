#include "mirror.h"

#include <epoxy/gl.h>
// After epoxy, which brings OpenGL's names.
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <string_view>

#include "nade/draw/text.h"

namespace nade::xr {
namespace {

constexpr std::int64_t kBetween_ns = 66'000'000;
constexpr double kWindowWait_s = 0.05;
constexpr int kWidth = 960;
constexpr int kHeight = 720;
constexpr int kBandHeight = 110;

std::int64_t now_ns() {
  return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
}

double deepest(const CorrectedHand& hand) {
  double depth_m = 0.0;
  for (const auto& contact : hand.contacts) {
    if (contact) depth_m = std::max(depth_m, contact->depth_m);
  }
  return depth_m;
}

std::string hand_words(const MirrorFigures& figures, std::size_t side) {
  const std::string_view name = side == 0 ? "left" : "right";
  if (figures.hands[side] == HandStatus::untracked) return fmt::format("{} hand not tracked", name);
  return fmt::format("{} hand {}, tracked {:.0f} mm deep", name, name_of(figures.hands[side]),
                     1e3 * figures.depth_m[side]);
}

/// A band of text, bottom row first, as textures are.
draw::Image band_of(const MirrorFigures& figures) {
  draw::Image band = draw::Image::blank(kWidth, kBandHeight);
  for (std::size_t i = 3; i < band.rgba.size(); i += 4) band.rgba[i] = 255;
  const draw::Color ink(0.75F, 0.75F, 0.75F);
  const std::array<std::string, 3> lines{
      fmt::format("{}, method {}", figures.object.empty() ? "no object" : figures.object,
                  name_of(figures.method)),
      fmt::format(
          "{:.0f} frames a second; correction {:.0f} µs, drawing {:.2f} ms of processor time",
          figures.frames_a_second, 1e6 * figures.cost.correct_s,
          1e3 * (figures.cost.pose_s + figures.cost.submit_s)),
      hand_words(figures, 0) + "; " + hand_words(figures, 1)};
  for (std::size_t i = 0; i < lines.size(); ++i) {
    draw::draw_text(band, 14.0F, 10.0F + 32.0F * static_cast<float>(i), lines[i], 22.0F, ink);
  }
  return band;
}

/// A texture with its framebuffer, filled anew for every picture.
struct Sheet {
  GLuint texture = 0;
  GLuint framebuffer = 0;
  int width = 0;
  int height = 0;

  void fill(const draw::Image& image) {
    if (image.width != width || image.height != height) {
      glDeleteTextures(1, &texture);
      glCreateTextures(GL_TEXTURE_2D, 1, &texture);
      glTextureStorage2D(texture, 1, GL_RGBA8, image.width, image.height);
      if (framebuffer == 0) glCreateFramebuffers(1, &framebuffer);
      glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, texture, 0);
      width = image.width;
      height = image.height;
    }
    glTextureSubImage2D(texture, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE,
                        image.rgba.data());
  }
};

}  // namespace

void MirrorFeed::take(const draw::Target& eye, const Room& room) {
  const std::int64_t now = now_ns();
  const double apart_s = 1e-9 * static_cast<double>(now - last_frame_ns_);
  last_frame_ns_ = now;
  if (apart_s > 0.0 && apart_s < 1.0) frames_a_second_ += 0.1 * (1.0 / apart_s - frames_a_second_);
  fetch();
  if (fence_ != nullptr || now - last_ns_ < kBetween_ns) return;
  last_ns_ = now;
  if (width_ != eye.width || height_ != eye.height) {
    if (buffer_ != 0) glDeleteBuffers(1, &buffer_);
    glCreateBuffers(1, &buffer_);
    width_ = eye.width;
    height_ = eye.height;
    glNamedBufferStorage(buffer_, static_cast<GLsizeiptr>(4) * width_ * height_, nullptr,
                         GL_MAP_READ_BIT);
  }
  glBindFramebuffer(GL_READ_FRAMEBUFFER, eye.framebuffer);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer_);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(eye.x, eye.y, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  fence_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  taken_.object = room.show().object;
  taken_.method = room.show().method;
  taken_.cost = room.cost();
  taken_.frames_a_second = frames_a_second_;
  for (std::size_t side = 0; side < 2; ++side) {
    const auto& hand = room.hands()[side];
    taken_.hands[side] = hand ? hand->corrected.status : HandStatus::untracked;
    taken_.depth_m[side] = hand ? deepest(hand->corrected) : 0.0;
  }
}

void MirrorFeed::fetch() {
  if (fence_ == nullptr) return;
  const auto fence = static_cast<GLsync>(fence_);
  const GLenum passed = glClientWaitSync(fence, 0, 0);
  if (passed == GL_TIMEOUT_EXPIRED) return;
  glDeleteSync(fence);
  fence_ = nullptr;
  std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return;
  const auto size = static_cast<std::size_t>(4) * static_cast<std::size_t>(width_) *
                    static_cast<std::size_t>(height_);
  const void* const pixels =
      glMapNamedBufferRange(buffer_, 0, static_cast<GLsizeiptr>(size), GL_MAP_READ_BIT);
  if (pixels == nullptr) return;
  picture_.width = width_;
  picture_.height = height_;
  picture_.rgba.resize(size);
  std::memcpy(picture_.rgba.data(), pixels, size);
  glUnmapNamedBuffer(buffer_);
  figures_ = taken_;
  fresh_ = true;
}

bool MirrorFeed::give(draw::Image& picture, MirrorFigures& figures) {
  const std::scoped_lock lock(mutex_);
  if (!fresh_) return false;
  fresh_ = false;
  std::swap(picture, picture_);
  figures = figures_;
  return true;
}

void MirrorWindow::Closer::operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }

Result<MirrorWindow> MirrorWindow::open() {
  if (!glfwInit()) {
    return Error{ErrorCode::not_found,
                 "--mirror opens a window, and there is no display to open it on: start it "
                 "from a desktop session, or leave --mirror out"};
  }
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  MirrorWindow window(glfwCreateWindow(kWidth, kHeight + kBandHeight,
                                       "nade xr: what the participant sees", nullptr, nullptr));
  if (!window.window_) {
    return Error{ErrorCode::not_found,
                 "--mirror opens a window, and the display offers no OpenGL 4.5"};
  }
  return window;
}

void MirrorWindow::show(MirrorFeed& feed) {
  glfwMakeContextCurrent(window_.get());
  glfwSwapInterval(0);
  Sheet picture;
  Sheet band;
  draw::Image image;
  MirrorFigures figures;
  while (!feed.ended()) {
    glfwWaitEventsTimeout(kWindowWait_s);
    if (glfwWindowShouldClose(window_.get())) feed.close();
    if (!feed.give(image, figures)) continue;
    picture.fill(image);
    draw::Image text = band_of(figures);
    band.fill(text);
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(window_.get(), &width, &height);
    glClearNamedFramebufferfv(0, GL_COLOR, 0, std::array<float, 4>{}.data());
    // The largest that keeps the eye's proportions, above the band.
    const int room = std::max(height - kBandHeight, 1);
    const double scale = std::min(static_cast<double>(width) / picture.width,
                                  static_cast<double>(room) / picture.height);
    const int wide = static_cast<int>(scale * picture.width);
    const int high = static_cast<int>(scale * picture.height);
    const int left = (width - wide) / 2;
    glBlitNamedFramebuffer(picture.framebuffer, 0, 0, 0, picture.width, picture.height, left,
                           height - high, left + wide, height, GL_COLOR_BUFFER_BIT, GL_LINEAR);
    // The text has its top row first.
    glBlitNamedFramebuffer(band.framebuffer, 0, 0, 0, kWidth, kBandHeight, 0, kBandHeight, kWidth,
                           0, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glfwSwapBuffers(window_.get());
  }
}

}  // namespace nade::xr
