#pragma once

#include <string>
#include <vector>

#include "camera_rig.h"
#include "nade/draw/stage.h"
#include "session.h"

namespace nade::viewer {

/// A sentence for the person, shown until it has been read.
struct Notice {
  std::string text;
  double left_s = 0.0;
};

/// Everything that controls and keys change.
struct Desk {
  Session& session;
  CameraRig camera;
  draw::Shown shown = draw::Shown::corrected;
  draw::Overlays overlays;
  bool help = false;
  bool panels = true;
  bool coarse = false;  ///< the scene at half the size, for slow machines
  std::vector<Notice> notices;

  /// Tells a sentence, or why something could not be done.
  void tell(const std::string& sentence);
  void tell(const Status& status);

  /// Another object, looked at from where the last one was.
  void show_object(const std::string& spec);
  void choose_method(Method method);
  /// A named view that shows what is stroked: the object, or of a large one what is about the
  /// hand.
  void look(draw::View view);
  /// A recording or a mesh that was dropped.
  void open(const std::string& path);
  void hold_as_at_first();
};

}  // namespace nade::viewer
