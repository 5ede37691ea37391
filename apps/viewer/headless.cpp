#include "headless.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <utility>

namespace nade::viewer {
namespace {

constexpr std::size_t kFramesAtLeast = 60;

/// A picture in memory to draw into.
class Canvas {
 public:
  Canvas(int width, int height) {
    glCreateTextures(GL_TEXTURE_2D, 1, &color_);
    glTextureStorage2D(color_, 1, GL_RGBA8, width, height);
    glCreateRenderbuffers(1, &depth_);
    glNamedRenderbufferStorage(depth_, GL_DEPTH24_STENCIL8, width, height);
    glCreateFramebuffers(1, &framebuffer_);
    glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, color_, 0);
    glNamedFramebufferRenderbuffer(framebuffer_, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                                   depth_);
  }
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;
  ~Canvas() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteRenderbuffers(1, &depth_);
    glDeleteTextures(1, &color_);
  }
  [[nodiscard]] unsigned framebuffer() const { return framebuffer_; }

 private:
  unsigned color_ = 0;
  unsigned depth_ = 0;
  unsigned framebuffer_ = 0;
};

}  // namespace

struct HeadlessViewer::Impl {
  draw::OffscreenContext context;
  std::unique_ptr<Canvas> canvas;
  std::unique_ptr<Viewer> viewer;
  Input input;
};

HeadlessViewer::HeadlessViewer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
HeadlessViewer::HeadlessViewer(HeadlessViewer&&) noexcept = default;
HeadlessViewer& HeadlessViewer::operator=(HeadlessViewer&&) noexcept = default;
HeadlessViewer::~HeadlessViewer() = default;

Result<HeadlessViewer> HeadlessViewer::create(ViewerSetup setup, int width, int height) {
  Result<draw::OffscreenContext> context = draw::OffscreenContext::create();
  if (!context) return context.error();
  setup.session.timing = Timing::none;
  Result<std::unique_ptr<Viewer>> viewer = Viewer::create(std::move(setup));
  if (!viewer) return viewer.error();
  auto impl = std::make_unique<Impl>(Impl{std::move(context).value(),
                                          std::make_unique<Canvas>(width, height),
                                          std::move(viewer).value(),
                                          {}});
  impl->input.width = width;
  impl->input.height = height;
  return HeadlessViewer(std::move(impl));
}

void HeadlessViewer::frame(const std::vector<Event>& events) {
  impl_->input.start_frame(kFixedStep_s);
  for (const Event& event : events) impl_->input.take(event);
  // How far a recording has been read must not show in the pictures.
  if (const Clip* const clip = impl_->viewer->session().clip()) clip->wait();
  impl_->viewer->frame(impl_->input, impl_->canvas->framebuffer());
}

draw::Image HeadlessViewer::picture() const {
  return read_back(impl_->canvas->framebuffer(), impl_->input.width, impl_->input.height);
}

Viewer& HeadlessViewer::viewer() { return *impl_->viewer; }

Status run_headless(ViewerSetup setup, const Run& run) {
  Result<HeadlessViewer> headless = HeadlessViewer::create(std::move(setup), run.width, run.height);
  if (!headless) return headless.error();
  ScriptPlayer script(run.script);
  const std::size_t frames = run.frames.value_or(kFramesAtLeast);
  for (std::size_t i = 0; i < frames; ++i) {
    const Result<std::vector<Event>> events = script.next(headless->viewer().ui());
    if (!events) return events.error();
    headless->frame(*events);
  }
  return run.screenshot ? draw::save_png(*run.screenshot, headless->picture()) : ok_status();
}

draw::Image read_back(unsigned framebuffer, int width, int height) {
  draw::Image image = draw::Image::blank(width, height);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glReadBuffer(framebuffer == 0 ? GL_BACK : GL_COLOR_ATTACHMENT0);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  const auto row = static_cast<std::ptrdiff_t>(4 * width);
  for (std::ptrdiff_t top = 0, bottom = height - 1; top < bottom; ++top, --bottom) {
    std::swap_ranges(image.rgba.begin() + top * row, image.rgba.begin() + (top + 1) * row,
                     image.rgba.begin() + bottom * row);
  }
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
  return image;
}

}  // namespace nade::viewer
