#pragma once

#include <cstdint>
#include <optional>

#include "nade/eval/posing.h"
#include "nade/hand.h"
#include "nade/surface.h"

namespace nade::viewer {

/// Where the fingers of a hand without a tracker point.
enum class Heading : std::uint8_t {
  away,         ///< from the viewer, as one's own hand does
  with_motion,  ///< where the hand goes
};

/// How a hand without a tracker is held. May change from frame to frame; the hand follows softly.
struct MouseHandSettings {
  double depth_m = 0.02;  ///< of the palm's skin below the surface; below 0 above it
  double turn_rad = 0.0;  ///< about the back of the hand, counter-clockwise as seen from above
  double tilt_rad = 0.0;  ///< above 0 raises the fingertips
  double roll_rad = 0.0;  ///< above 0 raises the hand's right edge
  HandShape shape;
  Handedness side = Handedness::right;
  Heading heading = Heading::away;
};

/// What a pointer asks of the hand in one frame.
struct Aim {
  std::optional<Ray> ray;           ///< through the cursor; without it the hand stays
  Vec3 nudge_world = Vec3::Zero();  ///< moves the hand along the surface instead
  Vec3 viewer_ahead = -Vec3::UnitZ();
  Vec3 viewer_up = Vec3::UnitY();
};

/// A tracked hand made from a mouse: the palm's skin follows the point of the surface under the
/// cursor, at the depth set, its back along the surface's normal (over a palm's breadth).
class MouseHand {
 public:
  /// `relaxed` is of either side.
  explicit MouseHand(const HandPose& relaxed);

  MouseHandSettings& settings() { return settings_; }
  [[nodiscard]] const MouseHandSettings& settings() const { return settings_; }

  /// Puts the hand onto a place of an object, at rest: +Y out of the surface, -Z ahead, world.
  void place(const Object& object, const Pose& place);

  /// The hand after `step_s` seconds (> 0) of following.
  [[nodiscard]] HandPose update(const Object& object, const Aim& aim, double step_s);

  /// The point of the surface that the palm is over or in, world.
  [[nodiscard]] const Vec3& anchor() const { return surface_point_; }

 private:
  /// Where the cursor is: on the surface, or so far off it.
  struct Goal {
    Vec3 point = Vec3::Zero();
    double off_m = 0.0;
  };
  void find_goal(const Object& object, const Aim& aim);
  void follow(double step_s);
  void lie_on(const Object& object, double step_s);
  void take_heading(const Aim& aim, double step_s);
  void hold(double step_s);

  HandPose relaxed_;
  MouseHandSettings settings_;
  PosableHand hand_;
  MouseHandSettings held_;  ///< the settings as far as the hand has followed them
  Goal goal_;
  Vec3 point_ = Vec3::Zero();     ///< follows the goal
  Vec3 velocity_ = Vec3::Zero();  ///< of `point_`, smoothed
  double off_m_ = 0.0;
  Vec3 surface_point_ = Vec3::Zero();
  Vec3 normal_ = Vec3::UnitY();
  Vec3 ahead_ = -Vec3::UnitZ();
  bool settled_ = false;  ///< has once turned to where it points
  SurfaceHint hint_;
};

}  // namespace nade::viewer
