#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "nade/geometry.h"
#include "nade/io/object_file.h"
#include "nade/io/recording.h"
#include "nade/status.h"

namespace nade {

/// Where the tracked palms' skin was in one frame, world; by index_of(Handedness).
using PalmSkin = std::array<std::optional<Vec3>, 2>;

/// The palm of a hand's skin: the palm joint moved out of the flesh by the generic hand's depth,
/// scaled to this hand. No value where the hand is not usable or has no length.
[[nodiscard]] std::optional<Vec3> palm_skin(const HandPose& hand) noexcept;

/// The palms of a recording, evenly thinned so that it stays small however long the recording.
class PalmTrack {
 public:
  static constexpr std::size_t kCapacity = 20'000;

  /// Frames in the order of the recording. Frames without a usable hand do not count.
  void add(const RecordedFrame& frame);

  [[nodiscard]] std::span<const PalmSkin> frames() const { return frames_; }

 private:
  std::vector<PalmSkin> frames_;
  std::size_t stride_ = 1;
  std::size_t seen_ = 0;
};

/// How deep the deeper of a frame's palms lies in the object, metres: the median over the frames.
/// Negative outside; minus infinity without frames or where no palm is within reach (0.5 m).
[[nodiscard]] double median_depth(const Object& object, std::span<const PalmSkin> frames);

/// What `--press D` asks for: `placement` moved, with its rotation and scale kept, so that the
/// median depth is `depth_m` (0 to 0.2 m, not 0). The object's stroking place is brought under the
/// palms and raised along its normal until that depth is first reached, which in a wall of up to 50
/// mm counts from the place's side and may be beyond the other; where that is not to be had under
/// the palms' median, a place for it is searched nearby. The error says how deep it can go.
[[nodiscard]] Result<Placement> press(const LoadedObject& object, const Placement& placement,
                                      const PalmTrack& track, double depth_m);

}  // namespace nade
