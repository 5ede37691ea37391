#include "viewer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <utility>

namespace nade::viewer {
namespace {

constexpr double kPressPerNotch_m = 0.002;
constexpr double kHighest_m = -0.06;
constexpr double kDeepest_m = 0.04;
constexpr double kNudgePerPixel_m = 0.0005;  // in first person, where the eye goes with the hand

/// The layout in the controls' own coordinates.
Layout scaled(const Input& input, const UiKit& ui, bool panels) {
  return layout_of(static_cast<int>(static_cast<float>(input.width) / ui.scale()),
                   static_cast<int>(static_cast<float>(input.height) / ui.scale()), panels);
}

/// Never beyond the window, however it is rounded.
Viewport in_pixels(const Viewport& laid_out, const Input& input, float scale) {
  const auto pixels = [scale](int length) {
    return static_cast<int>(scale * static_cast<float>(length));
  };
  Viewport viewport{pixels(laid_out.x), pixels(laid_out.y), 1, 1};
  viewport.width = std::clamp(pixels(laid_out.width), 1, std::max(1, input.width - viewport.x));
  viewport.height = std::clamp(pixels(laid_out.height), 1, std::max(1, input.height - viewport.y));
  return viewport;
}

void clear(unsigned framebuffer) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glDisable(GL_SCISSOR_TEST);
  glClearColor(0.13F, 0.13F, 0.135F, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

}  // namespace

Viewer::Viewer(ViewerSetup setup, draw::Renderer renderer)
    : session_(std::move(setup.session)),
      desk_{.session = session_,
            .camera = {},
            .shown = setup.shown,
            .overlays = setup.overlays,
            .notices = {}},
      renderer_(std::move(renderer)),
      study_(std::move(setup.study)) {
  if (setup.recording) {
    press_at_first_m_ = setup.press_m;
  } else if (setup.press_m) {
    session_.mouse_hand().settings().depth_m = *setup.press_m;
  }
}

Result<std::unique_ptr<Viewer>> Viewer::create(ViewerSetup setup) {
  Result<draw::Renderer> renderer = draw::Renderer::create();
  if (!renderer) return renderer.error();
  const std::optional<std::string> object = setup.object;
  const float scale = setup.scale;
  const std::optional<Placement> placement = setup.placement;
  const std::optional<std::string> recording = setup.recording;
  std::unique_ptr<Viewer> viewer(new Viewer(std::move(setup), std::move(renderer).value()));
  Result<draw::Stage> stage = draw::Stage::create(viewer->renderer_, viewer->session_.meshes());
  if (!stage) return stage.error();
  viewer->stage_.emplace(std::move(stage).value());
  const bool in_japanese =
      viewer->study_ && viewer->study_->language() == study::Language::japanese;
  Result<std::unique_ptr<UiKit>> ui =
      UiKit::create(scale, in_japanese ? UiKit::Letters::japanese : UiKit::Letters::latin);
  if (!ui) return ui.error();
  viewer->ui_ = std::move(ui).value();
  const Status shown = viewer->session_.show_object(object.value_or("dog"), placement);
  if (!shown) return shown.error();
  viewer->session_.keep_object(object || placement ? Session::Keep::yes : Session::Keep::no);
  if (recording) {
    const Status opened = viewer->session_.open_clip(*recording);
    if (!opened) return opened.error();
  }
  viewer->desk_.look(draw::View::three_quarter);
  return viewer;
}

void Viewer::frame(const Input& input, unsigned framebuffer, Drawing drawing) {
  if (study_) return frame_of_study(input, framebuffer, drawing);
  const Layout layout = scaled(input, *ui_, desk_.panels);
  viewport_ = in_pixels(layout.scene, input, ui_->scale());
  ui_->begin(input);
  if (desk_.panels) {
    draw_controls(*ui_, desk_, layout);
    draw_figures(*ui_, desk_, layout);
    draw_foot(*ui_, desk_, layout);
  }
  draw_notices(*ui_, desk_, layout);
  draw_help(*ui_, desk_, layout);
  take_keys(desk_, input);
  take_pointer(input);
  for (const std::string& path : input.dropped) desk_.open(path);

  const std::size_t begun_before = session_.clips_begun();
  session_.advance(input.step_s, aim(input));
  if (session_.clips_begun() != begun_before) {
    if (press_at_first_m_) desk_.tell(session_.press(*press_at_first_m_));
    press_at_first_m_.reset();
    desk_.look(desk_.camera.view());
  }
  for (const std::string& notice : session_.take_notices()) desk_.tell(notice);
  dress_object();

  std::optional<HandPose> followed;
  for (const auto& hand : session_.hands()) {
    if (hand) followed = hand->tracked;
  }
  camera_ = desk_.camera.camera(viewport_, followed, input.step_s);
  if (drawing == Drawing::all) draw_scene(input.height, framebuffer);
  ui_->end(framebuffer);
}

void Viewer::frame_of_study(const Input& input, unsigned framebuffer, Drawing drawing) {
  viewport_ = {0, 0, input.width, input.height};
  ui_->begin(input);
  study_->draw(*ui_, input);
  draw_notices(*ui_, desk_, scaled(input, *ui_, false));
  study_->take_keys(input);
  take_pointer(input);
  study_->prepare(desk_);
  const bool shown = study_->shows_object();
  if (shown) session_.advance(input.step_s, aim(input));
  study_->go_on(session_, camera_.pose, input);
  for (const std::string& notice : session_.take_notices()) desk_.tell(notice);
  dress_object();
  camera_ = desk_.camera.camera(viewport_, std::nullopt, input.step_s);
  if (drawing == Drawing::all) {
    if (shown) {
      draw_scene(input.height, framebuffer);
    } else {
      clear(framebuffer);
    }
  }
  ui_->end(framebuffer);
}

void Viewer::take_pointer(const Input& input) {
  const bool over_scene =
      input.inside && !ui_->takes_pointer() && viewport_.contains(input.x, input.y);
  if (dragging_ && !input.down(*dragging_)) dragging_.reset();
  if (!dragging_ && over_scene) {
    for (const Button button : {Button::right, Button::middle, Button::left}) {
      if (input.down(button)) dragging_ = button;
    }
  }
  const bool with_mouse = session_.clip() == nullptr;
  if (dragging_) {
    const bool pans = *dragging_ == Button::middle || input.is_held(Key::shift);
    // The left button is the hand's, but a recording's hand needs no mouse.
    const bool turns = *dragging_ == Button::right || !with_mouse;
    if (pans) {
      desk_.camera.pan(input.moved_x, input.moved_y, viewport_.height);
    } else if (turns) {
      desk_.camera.orbit(input.moved_x, input.moved_y);
    }
  }
  if (!over_scene || input.wheel == 0.0) return;
  if (!with_mouse || input.is_held(Key::control)) {
    desk_.camera.zoom(input.wheel);
  } else {
    double& depth_m = session_.mouse_hand().settings().depth_m;
    depth_m = std::clamp(depth_m + kPressPerNotch_m * input.wheel, kHighest_m, kDeepest_m);
  }
}

Aim Viewer::aim(const Input& input) const {
  Aim aim;
  aim.viewer_ahead = camera_.pose.rotation * -Vec3::UnitZ();
  aim.viewer_up = camera_.pose.rotation * Vec3::UnitY();
  const bool turning = dragging_ && *dragging_ != Button::left;
  if (!input.inside || turning || ui_->takes_pointer() || !viewport_.contains(input.x, input.y)) {
    return aim;
  }
  if (desk_.camera.view() == draw::View::first_person) {
    const Vec3 right = camera_.pose.rotation * Vec3::UnitX();
    aim.nudge_world = kNudgePerPixel_m *
                      (input.moved_x * right - input.moved_y * (aim.viewer_ahead + aim.viewer_up));
    return aim;
  }
  aim.ray = ray_through(camera_, viewport_, input.x, input.y);
  return aim;
}

void Viewer::dress_object() {
  if (dressed_ != session_.shared_object()) {
    const Status dressed = stage_->set_object(session_.loaded(), session_.placement());
    if (dressed.ok()) {
      for (const std::string& warning : stage_->warnings()) desk_.tell(warning);
    } else {
      desk_.tell(dressed);
    }
    // Held on to also where it could not be shown, for the session works with it.
    dressed_ = session_.shared_object();
  }
  stage_->set_placement(session_.placement());
}

void Viewer::draw_scene(int window_height, unsigned framebuffer) {
  draw::StageFrame frame;
  frame.hands = session_.hands();
  frame.shown = desk_.shown;
  frame.overlays = desk_.overlays;
  frame.softness_m = session_.softness_m();
  clear(framebuffer);
  draw::Target target;
  target.framebuffer = framebuffer;
  target.x = viewport_.x;
  target.y = window_height - viewport_.y - viewport_.height;
  target.width = viewport_.width;
  target.height = viewport_.height;
  frame.pixel_scale = ui_->scale() * (desk_.coarse ? 0.5F : 1.0F);
  const draw::Scene& scene = stage_->arrange(frame);
  if (desk_.coarse) {
    draw_coarsely(scene, target);
  } else {
    renderer_.draw(scene, camera_, target);
  }
}

void Viewer::draw_coarsely(const draw::Scene& scene, const draw::Target& target) {
  const int width = std::max(1, target.width / 2);
  const int height = std::max(1, target.height / 2);
  if (!coarse_ || coarse_->width() != width || coarse_->height() != height) {
    coarse_ = std::make_unique<Canvas>(width, height);
  }
  renderer_.draw(scene, camera_, {coarse_->framebuffer(), 0, 0, width, height});
  glBindFramebuffer(GL_READ_FRAMEBUFFER, coarse_->framebuffer());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer);
  glBlitFramebuffer(0, 0, width, height, target.x, target.y, target.x + target.width,
                    target.y + target.height, GL_COLOR_BUFFER_BIT, GL_LINEAR);
}

}  // namespace nade::viewer
