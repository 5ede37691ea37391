#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "json_text.h"
#include "nade/hand.h"
#include "warnings.h"

namespace nade::io {

/// The points of a hand in MediaPipe's order: wrist, then of thumb, index, middle, ring and little
/// finger the four that bend or end it.
inline constexpr std::size_t kLandmarkCount = 21;
using Landmarks = std::array<Vec3, kLandmarkCount>;

/// A hand as MediaPipe gives it.
struct LandmarkHand {
  Handedness side = Handedness::right;
  double score = 1.0;
  /// x and y over the picture's width and height, from its upper left corner; z as x, from the
  /// wrist, away from the camera.
  std::optional<Landmarks> picture{};
  /// Metres: x to the right, y down, z away from the camera.
  std::optional<Landmarks> world{};
};
using LandmarkHands = std::array<std::optional<LandmarkHand>, 2>;  ///< by index_of(Handedness)

/// The hands of one result, in the spellings of JavaScript, Python and the older Hands solution.
/// One whose points are not finite is left out, and so is the less certain of two of one side, each
/// with a warning. `place` is of the frame.
[[nodiscard]] Result<LandmarkHands> hands_of_result(const Json& frame, const std::string& place,
                                                    Warnings& warnings);

/// A picture's width over its height, where an object has both.
[[nodiscard]] std::optional<double> aspect_of_picture(const Json& object);

}  // namespace nade::io
