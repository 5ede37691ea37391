#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "nade/draw/scene.h"
#include "nade/hand.h"

namespace nade::xr {

/// What a headset knows of one frame, located at the moment the frame will be shown, in one space
/// with +Y up.
struct TrackedFrame {
  std::int64_t time_ns = 0;
  std::optional<Pose> head;
  std::array<std::optional<HandPose>, 2> hands{};  ///< by index_of(Handedness)
  std::array<draw::Camera, 2> eyes{};              ///< left and right
  bool draw = false;                               ///< the person will see it
  bool focused = false;   ///< input is ours: no menu of the system is before us
  bool own_hands = true;  ///< not made up from controllers, as far as the runtime tells
  double floor_y = 0.0;
};

}  // namespace nade::xr
