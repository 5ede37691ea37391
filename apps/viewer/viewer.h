#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "canvas.h"
#include "desk.h"
#include "nade/draw/renderer.h"
#include "panels.h"
#include "script.h"
#include "study_desk.h"
#include "ui_kit.h"

namespace nade::viewer {

/// What the viewer starts with.
struct ViewerSetup {
  Session::Setup session;
  std::optional<std::string> object;   ///< without it the recording's, or the dog
  std::optional<Placement> placement;  ///< of the object; without it as `Session::show_object`
  std::optional<std::string> recording;
  std::optional<double> press_m;  ///< of a recording; without one, of the mouse's hand
  draw::Overlays overlays;
  draw::Shown shown = draw::Shown::corrected;
  float scale = 1.0F;  ///< of controls, for screens with small pixels
  /// A study in place of everything else: it says what is shown.
  std::shared_ptr<StudyDesk> study;
};

/// Whether a frame's scene is drawn; what happens in it is the same.
enum class Drawing : std::uint8_t { all, controls };

/// The viewer's program, apart from where its pictures go: a window, or nowhere. Lives in the
/// OpenGL context that was current when it was made.
class Viewer {
 public:
  /// The error says what is missing or could not be read.
  [[nodiscard]] static Result<std::unique_ptr<Viewer>> create(ViewerSetup setup);
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  /// One frame: takes what was done, goes on, draws into a framebuffer of the size of `input`
  /// (0: the window).
  void frame(const Input& input, unsigned framebuffer, Drawing drawing = Drawing::all);

  /// Whether there is nothing more to show.
  [[nodiscard]] bool wants_to_close() const { return study_ && study_->closed(); }

  [[nodiscard]] Session& session() { return session_; }
  [[nodiscard]] Desk& desk() { return desk_; }
  [[nodiscard]] const UiKit& ui() const { return *ui_; }

  /// The last frame's, for measuring pictures.
  [[nodiscard]] draw::Renderer& renderer() { return renderer_; }
  [[nodiscard]] draw::Stage& stage() { return *stage_; }
  [[nodiscard]] const draw::Camera& camera() const { return camera_; }
  [[nodiscard]] const Viewport& viewport() const { return viewport_; }

 private:
  Viewer(ViewerSetup setup, draw::Renderer renderer);
  void frame_of_study(const Input& input, unsigned framebuffer, Drawing drawing);
  void take_pointer(const Input& input);
  [[nodiscard]] Aim aim(const Input& input) const;
  void dress_object();
  void draw_scene(int window_height, unsigned framebuffer);
  void draw_coarsely(const draw::Scene& scene, const draw::Target& target);

  Session session_;
  Desk desk_;
  draw::Renderer renderer_;
  std::optional<draw::Stage> stage_;
  std::unique_ptr<UiKit> ui_;
  std::unique_ptr<Canvas> coarse_;               ///< at half the size, where it is drawn so
  std::shared_ptr<const LoadedObject> dressed_;  ///< what the stage shows
  std::optional<double> press_at_first_m_;
  draw::Camera camera_;
  Viewport viewport_;
  std::shared_ptr<StudyDesk> study_;
  std::optional<Button> dragging_;  ///< a button that went down over the scene
};

/// Does what the keys of a frame ask for.
void take_keys(Desk& desk, const Input& input);

}  // namespace nade::viewer
