#pragma once

#include <array>
#include <optional>

#include "nade/hand.h"
#include "panel_picture.h"

namespace nade::xr {

/// What a hand does at the panel in a frame.
struct Touch {
  std::optional<int> pressed;    ///< the button it has just pressed
  std::optional<Vec3> cursor;    ///< where it points at on the panel, world
  std::optional<Vec3> ray_from;  ///< from where, world, if it points from afar
};

/// Finds out when a hand presses a button of a panel: the index finger's tracked tip goes through
/// the panel from front to back, or the hand points from afar and pinches. To press again, the
/// finger has to come out or the pinch to open, by more than tracking wavers.
class PanelTouch {
 public:
  /// `panel` is the panel's pose: its front is +Z. `hand` is a tracked hand; none where it is not
  /// tracked. `may_point`: whether the hand is free to point from afar.
  [[nodiscard]] Touch update(const std::optional<HandPose>& hand, const std::optional<Pose>& head,
                             const Pose& panel, const PanelPicture& picture, bool may_point);

 private:
  void poke(const HandPose& hand, const Pose& panel, const PanelPicture& picture, Touch& touch);
  void point(const HandPose& hand, const Pose& head, const Pose& panel, const PanelPicture& picture,
             Touch& touch);

  std::optional<Vec3> last_tip_;  ///< in the panel's frame, while tracked
  bool out_ = false;              ///< the finger has been in front since it last pressed
  bool open_ = false;             ///< so has the pinch been open
};

}  // namespace nade::xr
