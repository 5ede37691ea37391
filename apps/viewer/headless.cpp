#include "headless.h"

#include <utility>

#include "canvas.h"

namespace nade::viewer {
namespace {

constexpr std::size_t kFramesAtLeast = 60;

}  // namespace

struct HeadlessViewer::Impl {
  draw::OffscreenContext context;
  std::optional<Canvas> canvas;
  std::unique_ptr<Viewer> viewer;
  Input input;

  Impl(draw::OffscreenContext current, std::unique_ptr<Viewer> made)
      : context(std::move(current)), viewer(std::move(made)) {}
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
  auto impl = std::make_unique<Impl>(std::move(context).value(), std::move(viewer).value());
  impl->canvas.emplace(width, height);
  impl->input.width = width;
  impl->input.height = height;
  return HeadlessViewer(std::move(impl));
}

void HeadlessViewer::frame(const std::vector<Event>& events, Drawing drawing) {
  impl_->input.start_frame(kFixedStep_s);
  for (const Event& event : events) impl_->input.take(event);
  // How far a recording has been read must not show in the pictures.
  if (const Clip* const clip = impl_->viewer->session().clip()) clip->wait();
  impl_->viewer->frame(impl_->input, impl_->canvas->framebuffer(), drawing);
}

draw::Image HeadlessViewer::picture() const {
  return read_back(impl_->canvas->framebuffer(), impl_->input.width, impl_->input.height);
}

Viewer& HeadlessViewer::viewer() { return *impl_->viewer; }

Status run_headless(ViewerSetup setup, const Run& run) {
  const std::size_t frames = run.frames.value_or(kFramesAtLeast);
  if (const Status fits = check_length(run.script, frames); !fits) return fits;
  Result<HeadlessViewer> headless = HeadlessViewer::create(std::move(setup), run.width, run.height);
  if (!headless) return headless.error();
  ScriptPlayer script(run.script);
  for (std::size_t i = 0; i < frames; ++i) {
    const Result<std::vector<Event>> events = script.next(headless->viewer().ui());
    if (!events) return events.error();
    headless->frame(*events);
    if (headless->viewer().wants_to_close()) break;
  }
  return run.screenshot ? draw::save_png(*run.screenshot, headless->picture()) : ok_status();
}

}  // namespace nade::viewer
