#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "json_text.h"

namespace nade::io {

/// The keys of the first frames of a JSON text and of the hands in them: what the frames are.
struct FrameSketch {
  Sketch frame;
  Sketch hand;  ///< of what stands under "left", "right" and "hands"

  /// Results of MediaPipe, by their landmarks.
  [[nodiscard]] bool has_landmarks() const;
  /// Hands by joints of WebXR, by what is under "left", "right" or "hands".
  [[nodiscard]] bool has_webxr_joints() const;
};

/// `text` may end anywhere: an array of frames, an object with an array "frames", or objects, each
/// a frame, one after another.
[[nodiscard]] FrameSketch frame_sketch_of(std::string_view text);

}  // namespace nade::io
