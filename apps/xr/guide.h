#pragma once

#include "nade/study/motion_recorder.h"
#include "room.h"

namespace nade::xr {

/// One frame as it was shown, in the frame of the spot before the person, so that the object stands
/// still in it. Times are strictly increasing.
struct Moment {
  study::MotionFrame motion;
  Placement object;  ///< where it stands, if there is one
  /// For how long the object has been moving, where it moves by itself.
  std::optional<std::int64_t> animated_ns;
  double correction_us = 0.0;  ///< what correcting the hands took
};

/// Who decides what is shown: the person who tries things out, or the study.
class Guide {
 public:
  Guide() = default;
  Guide(const Guide&) = delete;
  Guide& operator=(const Guide&) = delete;
  virtual ~Guide() = default;

  /// What to show now; asked before every frame. The same object until something changes.
  [[nodiscard]] virtual const Show& show() = 0;
  /// Whether `show` is another than at the last call.
  [[nodiscard]] virtual bool changed() = 0;
  /// A button of the panel was pressed.
  virtual void press(int button) = 0;
  /// A frame was shown.
  virtual void seen(const Moment& moment) = 0;

  /// What the room is asked to do, once.
  struct Wishes {
    bool recentre = false;
    double raise_m = 0.0;
    bool leave = false;
  };
  [[nodiscard]] virtual Wishes take_wishes() = 0;
};

}  // namespace nade::xr
