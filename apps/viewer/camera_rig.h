#pragma once

#include <optional>

#include "input.h"
#include "nade/draw/camera.h"
#include "nade/surface.h"

namespace nade::viewer {

/// Where in the window the scene is drawn, pixels from the window's top left.
struct Viewport {
  int x = 0;
  int y = 0;
  int width = 1;
  int height = 1;

  [[nodiscard]] double aspect() const { return static_cast<double>(width) / height; }
  [[nodiscard]] bool contains(double px, double py) const {
    return px >= x && py >= y && px < x + width && py < y + height;
  }
};

/// The eye that a person moves: a ball about a point, or the hand owner's own.
class CameraRig {
 public:
  /// A named view of a ball.
  void look(draw::View view, const Vec3& center, double radius_m);
  [[nodiscard]] draw::View view() const { return view_; }

  /// Turns, pans and zooms as far as the pointer asks for it.
  void orbit(double moved_x, double moved_y);
  void pan(double moved_x, double moved_y, int viewport_height);
  void zoom(double notches);

  /// The camera of this frame. `hand` is what a first-person view follows, softly.
  [[nodiscard]] draw::Camera camera(const Viewport& viewport, const std::optional<HandPose>& hand,
                                    double step_s);

 private:
  draw::View view_ = draw::View::three_quarter;
  draw::Orbit orbit_;
  std::optional<Pose> follows_;  ///< the first-person eye, smoothed
};

/// The ray through a pixel of the window.
[[nodiscard]] Ray ray_through(const draw::Camera& camera, const Viewport& viewport, double x,
                              double y);

}  // namespace nade::viewer
